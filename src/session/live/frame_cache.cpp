// SPDX-License-Identifier: MIT
#include "session/live/frame_cache.hpp"

namespace tribo::session {
namespace {

// Only the last sound frames are needed: the clock is always close to the end of the milled part.
constexpr std::size_t kSoundFrames = 64;

}  // namespace

void FrameCache::take(const Frame& frame) {
    const auto kind = protocol::frame_kind(*frame);
    if (!kind) return;
    switch (*kind) {
        case protocol::LiveFrame::job:
            *this = {};
            job_ = frame;
            break;
        case protocol::LiveFrame::chunk: {
            protocol::LiveChunkPlace place;
            if (protocol::read_frame(*frame, place)) chunks_[place] = frame;
            break;
        }
        case protocol::LiveFrame::rows:
            if (protocol::header_flag(*frame)) rows_.clear();
            rows_.push_back(frame);
            break;
        case protocol::LiveFrame::multipliers:
            // They are of the rows before them.
            rows_.push_back(frame);
            break;
        case protocol::LiveFrame::designed:
            designed_.push_back(frame);
            break;
        case protocol::LiveFrame::path:
            path_ = frame;
            break;
        case protocol::LiveFrame::sound:
            sounds_.push_back(frame);
            if (sounds_.size() > kSoundFrames) sounds_.pop_front();
            break;
        case protocol::LiveFrame::collision:
            collisions_.push_back(frame);
            break;
        default:
            newest_[*kind] = frame;
    }
}

std::vector<FrameCache::Frame> FrameCache::replay() const {
    std::vector<Frame> all;
    if (!job_) return all;
    all.push_back(job_);
    for (const auto& [place, frame] : chunks_) all.push_back(frame);
    all.insert(all.end(), designed_.begin(), designed_.end());
    if (path_) all.push_back(path_);
    all.insert(all.end(), rows_.begin(), rows_.end());
    all.insert(all.end(), collisions_.begin(), collisions_.end());
    all.insert(all.end(), sounds_.begin(), sounds_.end());
    for (const auto& [kind, frame] : newest_) all.push_back(frame);
    return all;
}

}  // namespace tribo::session
