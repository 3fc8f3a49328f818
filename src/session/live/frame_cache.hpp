// SPDX-License-Identifier: MIT
// Cache of live frames for viewers that connect late. It keeps the job, the newest frame of each chunk, all
// rows and collisions, the designed surface, the last sound frames, and the newest frame of each other kind.
#pragma once

#include <deque>
#include <map>
#include <vector>

#include "protocol/live_frame.hpp"

namespace tribo::session {

class FrameCache {
  public:
    // A job frame clears the cache. Invalid frames are ignored.
    void take(std::span<const std::uint8_t> frame);
    // Sends all frames in a valid order.
    void replay(const protocol::FrameSink& frames) const;

  private:
    using Frame = std::vector<std::uint8_t>;
    Frame job_, path_;
    std::map<protocol::LiveChunkPlace, Frame> chunks_;
    std::vector<Frame> rows_, collisions_, designed_;
    std::deque<Frame> sounds_;
    std::map<protocol::LiveFrame, Frame> newest_;
};

}  // namespace tribo::session
