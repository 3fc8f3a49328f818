// SPDX-License-Identifier: MIT
#include "session/live_memory.hpp"

#include <algorithm>

namespace tribo::session {
namespace {

constexpr std::size_t kHeaderBytes = 16, kCoordBytes = 12;

}  // namespace

void LiveMemory::take(std::span<const std::uint8_t> frame) {
    if (frame.size() < kHeaderBytes) return;
    Frame copy(frame.begin(), frame.end());
    switch (static_cast<LiveFrame>(frame[0])) {
        case LiveFrame::job:
            *this = {};
            job_ = std::move(copy);
            break;
        case LiveFrame::chunk: {
            if (frame.size() < kHeaderBytes + kCoordBytes) return;
            std::array<std::uint8_t, kCoordBytes> coord;
            std::copy_n(frame.begin() + kHeaderBytes, kCoordBytes, coord.begin());
            chunks_[coord] = std::move(copy);
            break;
        }
        case LiveFrame::state:
            state_ = std::move(copy);
            break;
        case LiveFrame::rows:
        case LiveFrame::collision:
            others_.push_back(std::move(copy));
            break;
    }
}

void LiveMemory::replay(const FrameSink& frames) const {
    if (job_.empty()) return;
    frames(job_);
    for (const auto& [coord, frame] : chunks_) frames(frame);
    for (const Frame& frame : others_) frames(frame);
    if (!state_.empty()) frames(state_);
}

}  // namespace tribo::session
