// SPDX-License-Identifier: MIT
// Plays the cutting force from a table. Another thread may replace the table without a lock, for example
// after a change of feed, spindle speed, material or helix. The replacing thread frees old tables, never the
// servo.
#pragma once

#include "base/hand_over.hpp"
#include "contact/force_table.hpp"
#include "haptics/contact/force_field.hpp"
#include "haptics/servo/force_scaling.hpp"

namespace tribo::haptics {

class ForceTablePlayer final : public CuttingForce {
  public:
    explicit ForceTablePlayer(double rate_hz) : rate_hz_(rate_hz) {}

    // Called from one other thread, at any time.
    void replace(contact::ForceTable table, const ForceScaling& scaling) {
        tables_.back() = {std::move(table), scaling, ++sequence_};
        tables_.publish();
    }
    // Servo thread. `pace` > 0: table seconds per second. Real-time safe.
    void set_pace(double pace) noexcept { pace_ = pace; }
    // Servo thread. Real-time safe.
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
    std::uint64_t sequence_ = 0;  // of the replacing thread
    double rate_hz_, pace_ = 1;
    std::uint64_t playing_ = 0;
    contact::ForceTable::Cursor cursor_;
};

}  // namespace tribo::haptics
