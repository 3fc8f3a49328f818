// SPDX-License-Identifier: MIT
// The light on the bench: a small studio of bright panels that metal reflects, and one sun. The panels are
// those of the pages (web/ui/src/studio.ts). Their ground is darker and their sun is farther back, for
// the view of the pages turns; a still picture shows its walls from one side only. z is up.
#pragma once

#include <array>
#include <vector>

#include "base/vec3.hpp"

namespace tribo::report {

// Linear light, 1 is white.
struct Rgb {
    float r = 0, g = 0, b = 0;
};

// Bright machined metal, dull sawn metal, or paint that shows a colour of data.
enum class Finish { machined, sawn, paint };

class Studio {
  public:
    Studio();  // takes about 70 ms

    // Direction to the sun, unit.
    static Vec3 to_sun();

    // Light that a surface of a colour sends to the viewer. `normal`, `to_viewer`: unit. `sun`: share of the
    // sun that reaches it, 0..1. The studio is reflected after Karis 2014, the sun by GGX (Walter et al.
    // 2007).
    Rgb on(Finish finish, Rgb colour, Vec3 normal, Vec3 to_viewer, float sun) const;

  private:
    // Brightness of the room by direction, blurred: an octahedron unfolded into a square.
    class Sky {
      public:
        // `exponent` of the lobe cos^exponent that blurs.
        explicit Sky(double exponent);
        float at(Vec3 direction) const;

      private:
        std::vector<float> table_;
    };
    // Share of a mirrored even sky, by the cosine to the viewer: of the colour head-on, and of white.
    struct Mirrored {
        float scale = 0, offset = 0;
    };
    static constexpr int kCosines = 256;
    struct Gloss {
        Gloss(float roughness, float metalness);
        float roughness, metalness;
        Sky sky;
        std::array<Mirrored, kCosines + 1> mirrored;
    };
    std::array<Gloss, 3> glosses_;  // of each Finish
    Sky matte_;
};

// Compresses bright light and keeps the hue (Khronos PBR Neutral, 2024), as the pages do.
Rgb toned(Rgb light);

}  // namespace tribo::report
