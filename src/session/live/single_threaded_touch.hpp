// SPDX-License-Identifier: MIT
// The finger of a live mill on a single thread. The picture calls the servo ticks. Cutting force and texture
// come from the most recent rows of the cut.
#pragma once

#include "session/live/live_controller.hpp"

namespace tribo::session {

class SingleThreadedTouch {
  public:
    // `controller` must outlive this object.
    explicit SingleThreadedTouch(LiveController& controller) : controller_(controller) {}

    // Call after LiveMill::tick(). Advances the servo by dt_s and sends frames for changes of the finger.
    void tick(double dt_s, const protocol::FrameSink& frames);

  private:
    void renew();

    LiveController& controller_;
    double now_s_ = 0, owed_s_ = 0;  // servo time
    double renewed_s_ = -1;
    std::size_t stretches_ = 0;  // in the current force table
    int force_changes_ = 0;
};

}  // namespace tribo::session
