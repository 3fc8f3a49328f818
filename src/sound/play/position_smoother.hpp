// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "base/vec3.hpp"

namespace tribo::sound {

// Smooths a position for click-free sound. The position moves in a straight line and reaches its target in
// time. A target that comes too late is approached along a smooth S of about 20 ms. Real-time safe.
class PositionSmoother {
  public:
    // Reaches `to` after `quanta` >= 0 quanta. `at_once`: jumps without the S, for silence.
    void set_target(Vec3 to, std::int64_t quanta, bool at_once) {
        const Vec3 here = straight();
        if (at_once) late_ = late_slow_ = {};
        if (quanta == 0 && !at_once) {
            late_ += here - to;
            late_slow_ += here - to;
        }
        from_ = quanta == 0 ? to : here;
        to_ = to;
        length_ = quanta;
        elapsed_ = 0;
    }
    // Returns the position at the end of the next quantum.
    Vec3 advance() {
        if (elapsed_ < length_) ++elapsed_;
        constexpr double kFollow = 0.125;
        late_ -= kFollow * late_;
        late_slow_ += kFollow * (late_ - late_slow_);
        return straight() + late_slow_;
    }

  private:
    Vec3 straight() const {
        if (elapsed_ >= length_) return to_;
        return lerp(from_, to_, static_cast<double>(elapsed_) / static_cast<double>(length_));
    }
    Vec3 from_, to_;
    std::int64_t length_ = 0, elapsed_ = 0;
    Vec3 late_, late_slow_;  // remaining offset from the straight line
};

}  // namespace tribo::sound
