// SPDX-License-Identifier: MIT
// Cache of live frames for viewers that connect late. It keeps the job, the newest frame of each chunk, all
// rows and collisions, the designed surface, the last sound frames, and the newest frame of each other kind.
// The frames are shared with those who send them: a replay copies no bytes.
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <vector>

#include "protocol/live_frame.hpp"

namespace tribo::session {

class FrameCache {
  public:
    using Frame = std::shared_ptr<const std::vector<std::uint8_t>>;

    // A job frame clears the cache. Invalid frames are ignored.
    void take(const Frame& frame);
    // Returns all frames in a valid order.
    std::vector<Frame> replay() const;

  private:
    Frame job_, path_;
    std::map<protocol::LiveChunkPlace, Frame> chunks_;
    std::vector<Frame> rows_, collisions_, designed_;
    std::deque<Frame> sounds_;
    std::map<protocol::LiveFrame, Frame> newest_;
};

}  // namespace tribo::session
