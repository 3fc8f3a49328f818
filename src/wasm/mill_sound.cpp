// SPDX-License-Identifier: MIT
// The C ABI of mill_sound.wasm for the AudioWorklet of the mill page: frames in (docs/live-protocol.md),
// sound out. One listener per module.
#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "session/live/live_sound.hpp"

#define TRIBO_EXPORT(name) extern "C" __attribute__((export_name(#name)))

namespace {

using tribo::session::LiveSound;

constexpr std::uint32_t kMostFrames = 1024;

struct Ear {
    std::unique_ptr<LiveSound> sound;
    tribo::protocol::LiveSoundPieces pieces;
    std::vector<float> out;
};

Ear& ear() {
    static Ear the_ear;
    return the_ear;
}

}  // namespace

// Returns 1 if ready, 0 for a sample rate out of range. Takes about 50 ms.
TRIBO_EXPORT(sound_open) std::uint32_t sound_open(double sample_rate_hz) {
    tribo::sound::SoundtrackOptions options;
    if (!(sample_rate_hz >= tribo::sound::kLowestSampleRateHz &&
          sample_rate_hz <= tribo::sound::kHighestSampleRateHz)) {
        return 0;
    }
    options.sample_rate_hz = static_cast<int>(sample_rate_hz);
    options.head = tribo::sound::Head::sphere(options.sample_rate_hz);
    ear().sound = std::make_unique<LiveSound>(options);
    ear().out.resize(std::size_t{2} * kMostFrames);
    return 1;
}

// Takes frames of the kinds job, listening, bending and sound. Other and damaged frames are ignored.
TRIBO_EXPORT(sound_take) void sound_take(const std::uint8_t* bytes, std::uint32_t length) {
    using tribo::protocol::LiveFrame;
    if (!ear().sound) return;
    const std::span<const std::uint8_t> frame(bytes, length);
    const auto kind = tribo::protocol::frame_kind(frame);
    tribo::job::Listening listening;
    tribo::protocol::LiveBending bending;
    if (kind == LiveFrame::job) {
        ear().sound->begin_job();
    } else if (kind == LiveFrame::listening && tribo::protocol::read_frame(frame, listening)) {
        ear().sound->take(listening);
    } else if (kind == LiveFrame::bending && tribo::protocol::read_frame(frame, bending)) {
        ear().sound->take(bending);
    } else if (kind == LiveFrame::sound && tribo::protocol::read_frame(frame, ear().pieces)) {
        ear().sound->take(ear().pieces);
    }
}
TRIBO_EXPORT(sound_follow)
void sound_follow(double t_s, double speed, std::uint32_t playing, double lead_s) {
    if (ear().sound) ear().sound->follow(t_s, speed, playing != 0, lead_s);
}
// Renders at most 1024 frames, left and right interleaved.
TRIBO_EXPORT(sound_render) const float* sound_render(std::uint32_t frames) {
    if (ear().sound) ear().sound->render({ear().out.data(), std::size_t{2} * std::min(frames, kMostFrames)});
    return ear().out.data();
}
TRIBO_EXPORT(sound_program_s) double sound_program_s() {
    return ear().sound ? ear().sound->program_s() : 0;
}
