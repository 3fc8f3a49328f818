// SPDX-License-Identifier: MIT
// Haptic texture of a machined surface: the force of the nearest record of eight triangles. Grooves that the
// servo rate cannot reproduce at the speed of the hand are faded out.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/cell_index.hpp"
#include "contact/texture_record.hpp"

namespace tribo::haptics {

// Gain of grooves of this wavelength at this speed of the hand, against aliasing. The gain is 1 up to a
// quarter of the servo rate, 0 from 0.4 of it on, and a raised cosine between.
double groove_gain(double speed_mm_per_s, double wavelength_mm, double rate_hz);

// Spatial index of the texture records of a path. Built once. Queries are real-time safe, from any thread.
class TextureMap {
  public:
    TextureMap() = default;
    // `reach_mm` > 0: largest distance from a query to its record.
    TextureMap(std::vector<contact::TextureRecord> records, double reach_mm);

    std::span<const contact::TextureRecord> records() const { return records_; }
    // The nearest record; null if none is within reach. Examines 27 cells of size `reach_mm`, at most
    // kMostLooked records of each.
    const contact::TextureRecord* nearest(Vec3 place_mm) const;
    static constexpr int kMostLooked = 32;

  private:
    std::vector<contact::TextureRecord> records_;
    CellIndex cells_;
    double reach_ = 1;
};

struct TextureTouch {
    Vec3 place_mm;           // of the probe, or of its proxy
    Vec3 velocity_mm_per_s;  // along the surface
    double press_mm = 0;     // penetration, >= 0
};

// F_tex = k N_tex. Real-time safe.
Vec3 texture_force(const contact::TextureRecord& record, const TextureTouch& touch, double stiffness_n_per_mm,
                   double rate_hz);

}  // namespace tribo::haptics
