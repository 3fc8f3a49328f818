// SPDX-License-Identifier: MIT
// The cutting force from a table that another thread may replace while the servo plays it: when feed, spindle
// speed, material or helix change, the table is rebuilt aside and swapped in without a lock. The old one is
// freed by the thread that brings the next but one, never by the servo's.
#pragma once

#include "base/hand_over.hpp"
#include "contact/force_table.hpp"
#include "haptics/contact/force_field.hpp"
#include "haptics/servo/force_scaling.hpp"

namespace tribo::haptics {

class SwappedForce final : public CuttingForce {
  public:
    explicit SwappedForce(double rate_hz) : rate_hz_(rate_hz) {}

    // From one thread, at any time.
    void replace(contact::ForceTable table, const ForceScaling& scaling) {
        tables_.back() = {std::move(table), scaling, ++sequence_};
        tables_.publish();
    }
    // The servo's: how fast the times of the table go by, in their seconds per second; > 0. Real-time safe.
    void set_pace(double pace) noexcept { pace_ = pace; }
    // The servo's. Real-time safe.
    Vec3 force_n(double at_s) noexcept override {
        const Entry& now = tables_.read();
        if (now.sequence != playing_) {
            cursor_ = {};
            playing_ = now.sequence;
        }
        Vec3 force;
        return now.table.force_at(at_s, rate_hz_ / pace_, cursor_, force) ? now.scaling.apply(force) : Vec3{};
    }

  private:
    struct Entry {
        contact::ForceTable table;
        ForceScaling scaling;
        std::uint64_t sequence = 0;
    };
    Snapshot<Entry> tables_;
    std::uint64_t sequence_ = 0;  // the writer's
    double rate_hz_, pace_ = 1;
    std::uint64_t playing_ = 0;
    contact::ForceTable::Cursor cursor_;
};

}  // namespace tribo::haptics
