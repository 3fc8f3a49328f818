// SPDX-License-Identifier: MIT
#include "session/live/live_memory.hpp"

#include <algorithm>

namespace tribo::session {
namespace {

constexpr std::size_t kHeaderBytes = 16, kFlagsAt = 2, kCoordBytes = 12;
// Of the sound only the end matters: the clock is never far behind what is milled.
constexpr std::size_t kSoundFrames = 64;

}  // namespace

void LiveMemory::take(std::span<const std::uint8_t> frame) {
    if (frame.size() < kHeaderBytes) return;
    Frame copy(frame.begin(), frame.end());
    switch (static_cast<protocol::LiveFrame>(frame[0])) {
        case protocol::LiveFrame::job:
            *this = {};
            job_ = std::move(copy);
            break;
        case protocol::LiveFrame::chunk: {
            if (frame.size() < kHeaderBytes + kCoordBytes) return;
            std::array<std::uint8_t, kCoordBytes> coord;
            std::copy_n(frame.begin() + kHeaderBytes, kCoordBytes, coord.begin());
            chunks_[coord] = std::move(copy);
            break;
        }
        case protocol::LiveFrame::rows:
            if (frame[kFlagsAt] != 0) rows_.clear();
            rows_.push_back(std::move(copy));
            break;
        case protocol::LiveFrame::designed:
            designed_.push_back(std::move(copy));
            break;
        case protocol::LiveFrame::path:
            path_ = std::move(copy);
            break;
        case protocol::LiveFrame::sound:
            sounds_.push_back(std::move(copy));
            if (sounds_.size() > kSoundFrames) sounds_.pop_front();
            break;
        case protocol::LiveFrame::collision:
            collisions_.push_back(std::move(copy));
            break;
        default:
            newest_[frame[0]] = std::move(copy);
    }
}

void LiveMemory::replay(const protocol::FrameSink& frames) const {
    if (job_.empty()) return;
    frames(job_);
    for (const auto& [coord, frame] : chunks_) frames(frame);
    for (const Frame& frame : designed_) frames(frame);
    if (!path_.empty()) frames(path_);
    for (const Frame& frame : rows_) frames(frame);
    for (const Frame& frame : collisions_) frames(frame);
    for (const Frame& frame : sounds_) frames(frame);
    for (const auto& [kind, frame] : newest_) frames(frame);
}

}  // namespace tribo::session
