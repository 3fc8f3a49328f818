// SPDX-License-Identifier: MIT
// A finger beside a live mill where there is one thread: the servo's ticks are made by the picture, and the
// cutting force and the grooves' texture are those of what was cut in the last moments.
#pragma once

#include "session/live/live_finger.hpp"
#include "session/live/live_mill.hpp"

namespace tribo::session {

struct LiveTouchSettings {
    double force_scale = 0.01;  // newtons at the hand per newton at the tool
    double jnd = contact::ForceTableOptions{}.most_jnd;
    bool cut_mode = true, cutting_force = true, stopped = false;
};

class SingleThreadedTouch {
  public:
    explicit SingleThreadedTouch(LiveMill& mill);
    ~SingleThreadedTouch();
    SingleThreadedTouch(const SingleThreadedTouch&) = delete;
    SingleThreadedTouch& operator=(const SingleThreadedTouch&) = delete;

    void lead(Vec3 aim_mm, bool down) { finger_.lead(aim_mm, down); }
    // Stopped: no force from now on.
    void set(const LiveTouchSettings& settings);
    const LiveTouchSettings& settings() const { return settings_; }

    // After the mill's own tick: so much of the servo's time has passed. Tells what is new of the finger.
    void tick(double dt_s, const protocol::FrameSink& frames);

  private:
    void renew();
    LiveScene scene() const;

    LiveMill& mill_;
    LiveTouchSettings settings_;
    LiveFeelOptions options_;
    LiveFinger finger_;
    double now_s_ = 0, owed_s_ = 0;  // of the servo's clock
    double renewed_s_ = -1;
    std::size_t stretches_ = 0;  // in the force that is felt
};

}  // namespace tribo::session
