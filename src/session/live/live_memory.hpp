// SPDX-License-Identifier: MIT
// Keeps of a stream of live frames what a viewer that comes later needs to see the same: the job, the newest
// of each chunk, all rows and collisions, the designed surface, the end of the sound, the newest of
// every other kind.
#pragma once

#include <deque>
#include <map>
#include <vector>

#include "protocol/live_frame.hpp"

namespace tribo::session {

class LiveMemory {
  public:
    // A job frame begins anew. Bytes that are no frame are left alone.
    void take(std::span<const std::uint8_t> frame);
    // Everything kept, in an order that a viewer can take in.
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
