// SPDX-License-Identifier: MIT
#include "session/live/frame_cache.hpp"

namespace tribo::session {
namespace {

// Only the last sound frames are needed: the clock is always close to the end of the milled part.
constexpr std::size_t kSoundFrames = 64;

}  // namespace

void FrameCache::take(std::span<const std::uint8_t> frame) {
    const auto kind = protocol::frame_kind(frame);
    if (!kind) return;
    Frame copy(frame.begin(), frame.end());
    switch (*kind) {
        case protocol::LiveFrame::job:
            *this = {};
            job_ = std::move(copy);
            break;
        case protocol::LiveFrame::chunk: {
            protocol::LiveChunkPlace place;
            if (protocol::read_frame(frame, place)) chunks_[place] = std::move(copy);
            break;
        }
        case protocol::LiveFrame::rows:
            if (protocol::header_flag(frame)) rows_.clear();
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
            newest_[*kind] = std::move(copy);
    }
}

void FrameCache::replay(const protocol::FrameSink& frames) const {
    if (job_.empty()) return;
    frames(job_);
    for (const auto& [place, frame] : chunks_) frames(frame);
    for (const Frame& frame : designed_) frames(frame);
    if (!path_.empty()) frames(path_);
    for (const Frame& frame : rows_) frames(frame);
    for (const Frame& frame : collisions_) frames(frame);
    for (const Frame& frame : sounds_) frames(frame);
    for (const auto& [kind, frame] : newest_) frames(frame);
}

}  // namespace tribo::session
