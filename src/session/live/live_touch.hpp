// SPDX-License-Identifier: MIT
// A finger beside a live mill where there is one thread: the servo's ticks are made by the picture, and the
// cutting force and the grooves' texture are those of what was cut in the last moments.
#pragma once

#include "session/live/live_controller.hpp"

namespace tribo::session {

class SingleThreadedTouch {
  public:
    // `controller` must outlive it.
    explicit SingleThreadedTouch(LiveController& controller) : controller_(controller) {}

    // After the mill's own tick: so much of the servo's time has passed. Tells what is new of the finger.
    void tick(double dt_s, const protocol::FrameSink& frames);

  private:
    void renew();

    LiveController& controller_;
    double now_s_ = 0, owed_s_ = 0;  // of the servo's clock
    double renewed_s_ = -1;
    std::size_t stretches_ = 0;  // in the force that is felt
    int force_changes_ = 0;
};

}  // namespace tribo::session
