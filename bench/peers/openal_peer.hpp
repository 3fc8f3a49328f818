// SPDX-License-Identifier: MIT
// OpenAL Soft on its loopback device: 48 kHz, float stereo, HRTF or panning, 256-frame renders; every source
// loops a mono sound, and gets a new place and velocity before each render.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/vec3.hpp"

namespace tribo::bench {

class OpenAlScene {
  public:
    // None where OpenAL Soft is not installed or has no loopback device.
    static std::unique_ptr<OpenAlScene> open(int sources, bool head, std::span<const float> sound);
    ~OpenAlScene();

    static constexpr int kFrames = 256;
    // x to the right, y ahead, z up; m and m/s.
    void place(int source, Vec3 metres, Vec3 metres_per_s);
    // Applies the places at once and renders the next frames, interleaved.
    void render(std::span<float> stereo);
    std::string version() const;

  private:
    struct Handles;
    OpenAlScene();
    std::unique_ptr<Handles> handles_;
};

}  // namespace tribo::bench
