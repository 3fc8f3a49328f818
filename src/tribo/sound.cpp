// SPDX-License-Identifier: MIT
#include "tribo/sound.hpp"

#include <utility>

#include "job/job_files.hpp"
#include "job/listening.hpp"
#include "sound/play/soundtrack.hpp"
#include "tribo/job_hearing.hpp"
#include "tribo/mill_state.hpp"

namespace tribo {
namespace {

job::JobSound with_ears(job::JobSound sound, Ears ears) {
    switch (ears) {
        case Ears::as_the_job_says:
            break;
        case Ears::measured_head:
            sound.mode = job::SoundMode::hrtf;
            break;
        case Ears::sphere:
            sound.mode = job::SoundMode::sphere;
            break;
        case Ears::panning:
            sound.mode = job::SoundMode::pan;
            break;
    }
    return sound;
}

}  // namespace

struct CutSound::State {
    sound::Soundtrack track;
    Warnings warnings;
};

CutSound::CutSound(std::unique_ptr<State> state) : state_(std::move(state)) {}
CutSound::CutSound(CutSound&&) noexcept = default;
CutSound& CutSound::operator=(CutSound&&) noexcept = default;
CutSound::~CutSound() = default;

FileResult<CutSound> CutSound::of(const Mill& mill, const SoundOptions& options) {
    const Mill::State& cut = *mill.state_;
    const job::JobSound said = with_ears(cut.job.sound, options.ears);
    sound::SoundtrackOptions track;
    track.sample_rate_hz = options.sample_rate_hz;
    job::apply(job::listening_to(cut.job, cut.blank_mm), track);
    if (options.listener_mm) track.listener_mm = *options.listener_mm;
    if (auto good = sound::check(track); !good) return std::unexpected(FileFailure(good.error()));
    Warnings warnings;
    auto head = head_of(said, options.sample_rate_hz, cut.file, {}, warnings);
    if (!head) return std::unexpected(job::at_key(cut.job, head.error()));
    track.head = std::move(*head);
    if (auto read = read_voices(said, track); !read)
        return std::unexpected(job::at_key(cut.job, read.error()));
    if (auto good = sound::check(track); !good) return std::unexpected(FileFailure(good.error()));
    return CutSound(std::make_unique<State>(State{sound::Soundtrack(track), std::move(warnings)}));
}

const Warnings& CutSound::warnings() const {
    return state_->warnings;
}

bool CutSound::excite(const contact::ContactSample& next) {
    return state_->track.excite(next);
}

std::int64_t CutSound::frames_left() const {
    return state_->track.frames_left();
}

void CutSound::release() {
    state_->track.release();
}

double CutSound::tail_seconds() const {
    return state_->track.tail_seconds();
}

void CutSound::render(std::span<float> interleaved) {
    state_->track.render(interleaved);
}

}  // namespace tribo
