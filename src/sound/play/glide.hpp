// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "base/vec3.hpp"

namespace tribo::sound {

// A point that is told where to be, and when. It goes there in a straight line; where it is told too late,
// the leap is made up for along a smooth S of about 20 ms, so that nothing that follows it clicks. Real-time
// safe.
class Glide {
  public:
    // Reaches `to` after `quanta` >= 0 quanta; `at_once`: without the S (nobody listens).
    void lead(Vec3 to, std::int64_t quanta, bool at_once) {
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
    // The place at the end of the next quantum.
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
    Vec3 late_, late_slow_;  // what is still to be made up for
};

}  // namespace tribo::sound
