// SPDX-License-Identifier: MIT
// Executes the commands of a page (docs/live-protocol.md) on mill, finger and settings. Used by the program
// and by the mill in the page. Of several settings in one frame only the newest costs anything: obey() keeps
// what is wanted, apply() does it. No threads and no clocks of its own.
#pragma once

#include "contact/force_table.hpp"
#include "protocol/live_command.hpp"
#include "session/live/live_finger.hpp"
#include "session/live/live_mill.hpp"

namespace tribo::session {

class LiveController {
  public:
    // `mill` must outlive this object. `arm`: null for a pointer device, moved by commands. Material and
    // helix are those of the job.
    LiveController(LiveMill& mill, const LiveForceOptions& options, std::unique_ptr<haptics::Device> arm,
                   protocol::LiveSettings settings);
    ~LiveController();  // after the servo has stopped
    LiveController(const LiveController&) = delete;
    LiveController& operator=(const LiveController&) = delete;

    // A refused command changes nothing. The caller must handle resync: it keeps the frames.
    Result<void> obey(const protocol::LiveCommand& command);
    // Applies the newest settings to cut and force: once per frame, before LiveMill::tick(). Material and
    // helix follow the files of the job, unless a viewer chose others.
    void apply();

    LiveMill& mill() { return mill_; }
    LiveFinger& finger() { return finger_; }
    const protocol::LiveSettings& settings() const { return settings_; }
    // The current scene for the finger.
    LiveScene scene() const;

    // Number of applied changes so far that need a new force table.
    int force_changes() const { return force_changes_; }
    contact::ForceTableOptions table_options() const;
    // Sets the force of the cut, built with table_options(). The current force scale applies, also after
    // changes.
    void set_force(contact::ForceTable table);

  private:
    void follow_job();
    CutChange change() const;
    void use_force();

    LiveMill& mill_;
    protocol::LiveSettings job_settings_, settings_, applied_;
    int sessions_ = 0;  // of the mill, seen last
    LiveFinger finger_;
    contact::ForceTable table_;
    int force_changes_ = 0;
};

}  // namespace tribo::session
