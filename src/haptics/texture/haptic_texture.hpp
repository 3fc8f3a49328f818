// SPDX-License-Identifier: MIT
// The texture of a machined surface under a hand: the record of eight triangles that lies nearest, limited to
// what a loop at its rate carries at the speed of the hand.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "contact/texture_record.hpp"

namespace tribo::haptics {

// What a loop carries of grooves of a wavelength that a hand crosses at a speed: all up to a quarter of the
// loop's rate, nothing from four tenths on, a raised cosine between.
double carried_share(double speed_mm_per_s, double wavelength_mm, double rate_hz);

// Records of a path by place and in the path's order. Built once; asking is real-time safe and for any
// thread.
class TextureMap {
  public:
    TextureMap() = default;
    // `reach_mm` > 0: no record answers for a place further than this from its own.
    TextureMap(std::vector<contact::TextureRecord> records, double reach_mm);

    std::span<const contact::TextureRecord> records() const { return records_; }
    // The record nearest to a place; null when none is within reach. Looks at the records of 27 cells of the
    // reach's size, at most kMostLooked of each.
    const contact::TextureRecord* nearest(Vec3 place_mm) const;
    static constexpr int kMostLooked = 32;

  private:
    struct Entry {
        std::uint64_t cell;
        std::uint32_t record;
    };
    std::uint64_t cell_of(Vec3 place, int dx, int dy, int dz) const;

    std::vector<contact::TextureRecord> records_;
    std::vector<Entry> entries_;  // by cell, then in the path's order
    Vec3 origin_;
    double reach_ = 1;
};

struct TextureTouch {
    Vec3 place_mm;           // of the probe, or of its proxy
    Vec3 velocity_mm_per_s;  // along the surface
    double press_mm = 0;     // how deep the hand presses, >= 0
};

// F_tex = k N_tex. Real-time safe.
Vec3 texture_force(const contact::TextureRecord& record, const TextureTouch& touch, double stiffness_n_per_mm,
                   double rate_hz);

}  // namespace tribo::haptics
