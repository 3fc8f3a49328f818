// SPDX-License-Identifier: MIT
// Obeys the commands of a page (docs/live-protocol.md), in the program and in the page's own mill: the mill,
// the finger, and what is set. No threads and no clocks of its own.
#pragma once

#include "contact/force_table.hpp"
#include "protocol/live_command.hpp"
#include "session/live/live_finger.hpp"
#include "session/live/live_mill.hpp"

namespace tribo::session {

class LiveController {
  public:
    // `mill` must outlive it. `arm`: null for a hand that commands lead. `settings`: with material and helix
    // of the job.
    LiveController(LiveMill& mill, const LiveFeelOptions& options, std::unique_ptr<haptics::Device> arm,
                   protocol::LiveSettings settings);
    ~LiveController();  // the finger's servo has ended
    LiveController(const LiveController&) = delete;
    LiveController& operator=(const LiveController&) = delete;

    // Refused, it changes nothing. To send frames again (resync) is the task of whoever keeps them.
    Result<void> obey(const protocol::LiveCommand& command);

    LiveMill& mill() { return mill_; }
    LiveFinger& finger() { return finger_; }
    const protocol::LiveSettings& settings() const { return settings_; }
    // The world of the finger as it is now.
    LiveScene scene() const;

    // Counts the changes that the force on the finger depends on.
    int force_changes() const { return force_changes_; }
    contact::ForceTableOptions table_options() const;
    // The force of the cut, built with table_options(); scaled as set, also when that changes later.
    void set_force(contact::ForceTable table);

  private:
    Result<void> set(const protocol::LiveSettings& wanted);
    void use_force();

    LiveMill& mill_;
    const protocol::LiveSettings job_settings_;
    protocol::LiveSettings settings_;
    LiveFinger finger_;
    contact::ForceTable table_;
    int force_changes_ = 0;
};

}  // namespace tribo::session
