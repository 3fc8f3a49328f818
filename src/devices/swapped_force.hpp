// SPDX-License-Identifier: MIT
// The cutting force from a table that another thread may replace while the servo plays it: when feed, spindle
// speed, material or helix change, the table is rebuilt aside and swapped in without a lock. The old one is
// freed by the thread that brings the next but one, never by the servo's.
#pragma once

#include "contact/force_table.hpp"
#include "devices/snapshot.hpp"
#include "haptics/force_field.hpp"
#include "haptics/force_scaling.hpp"

namespace tribo::devices {

class SwappedForce final : public haptics::CuttingForce {
  public:
    explicit SwappedForce(double rate_hz) : rate_hz_(rate_hz) {}

    // From one thread, at any time.
    void replace(contact::ForceTable table, const haptics::ForceScaling& scaling) {
        tables_.back() = {std::move(table), scaling, ++sequence_};
        tables_.publish();
    }
    // The servo's. Real-time safe.
    Vec3 force_n(double at_s) noexcept override {
        const Entry& now = tables_.read();
        if (now.sequence != playing_) {
            cursor_ = {};
            playing_ = now.sequence;
        }
        Vec3 force;
        return now.table.force_at(at_s, rate_hz_, cursor_, force) ? now.scaling.apply(force) : Vec3{};
    }

  private:
    struct Entry {
        contact::ForceTable table;
        haptics::ForceScaling scaling;
        std::uint64_t sequence = 0;
    };
    Snapshot<Entry> tables_;
    std::uint64_t sequence_ = 0;  // the writer's
    double rate_hz_;
    std::uint64_t playing_ = 0;
    contact::ForceTable::Cursor cursor_;
};

}  // namespace tribo::devices
