// SPDX-License-Identifier: MIT
// From contact samples to stereo: voices, distance, level, limiter.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/result.hpp"
#include "contact/contact_sample.hpp"
#include "sound/cut/body.hpp"
#include "sound/cut/chip_noise.hpp"
#include "sound/cut/machine.hpp"
#include "sound/cut/recorded_voice.hpp"
#include "sound/cut/voice.hpp"
#include "sound/place/room.hpp"
#include "sound/place/spatial_source.hpp"
#include "sound/play/glide.hpp"

namespace tribo::sound {

inline constexpr int kChannels = 2;
inline constexpr double kTailSeconds = 0.02;  // what a release takes, and some (at the source)
// With a head: until the air has brought it all.
inline constexpr double kLongestTailSeconds =
    kTailSeconds + kLongestRingSeconds + kLongestTravelSeconds + 0.5;
inline constexpr int kLowestSampleRateHz = 32000;  // carries machines and chips, dull above 14 kHz
inline constexpr int kHighestSampleRateHz = 192000;

struct SoundtrackOptions {
    int sample_rate_hz = 48000;                        // kLowestSampleRateHz ... kHighestSampleRateHz
    double gain_db = 0;                                // -120 ... 60
    Vec3 listener_mm;                                  // stock frame; looks along +y, up is +z
    double reference_distance_m = kReferenceDistance;  // nearer it gets no louder; kLeast... to 100
    double distance_factor = 1;  // > 0; distances count times this (the paper's; > 1 enlarges a small part)
    // How places are heard, of the same sample rate; null: both channels alike, distance is loudness.
    std::shared_ptr<const Head> head{};
    bool as_published = false;  // eq. 23 as printed in place of all voices, in the open
    std::uint64_t seed = 1;     // of the noise
    Body tool{};                // what rings with it; its `direct` does not count
    Machine machine{};          // none
    ChipOptions chips{};        // none
    Room room{};                // none; heard with a head only
    // A recorded cut that follows the spindle, and its share of the power, 0 ... 1 (equal power: the
    // synthesis has the rest); an idle spindle in place of the machine's, and its RMS pressure at 1 m.
    std::shared_ptr<const Recording> recording{}, idle{};
    double recording_share = 0.5, idle_pa = 0.02;
};

// Refuses numbers out of range, naming the job file's key.
Result<void> check(const SoundtrackOptions& options);

// Pressure of a source `distance_mm` away as a share of the pressure at 1 m: 1 / r, no more than at the
// reference distance.
double rolloff(double distance_mm, double distance_factor, double reference_m = kReferenceDistance);

// Renders frames 0, 1, 2, ... of a stereo track: interleaved, sample = limited(gain * pressure at the ear /
// kFullScalePascal), never beyond -1 ... 1, never scaled to fit. Frame n is at n / sample_rate seconds of the
// samples' time, and sounds what the air has brought by then. The same bits whatever the blocks. A minute
// with 32 partials and a head takes 0.33 s, with machine, chips and room 0.54 s.
//
// excite(), release() and render() are real-time safe; one thread at a time.
class Soundtrack {
  public:
    // The voices of a cut, by the options.
    explicit Soundtrack(const SoundtrackOptions& options);
    // Voices of the caller's.
    Soundtrack(const SoundtrackOptions& options, std::vector<std::unique_ptr<Voice>> voices);

    int sample_rate_hz() const { return options_.sample_rate_hz; }
    std::int64_t frames_rendered() const { return frame_; }

    // The contact moves on to `next`; render frames_left() frames before the one after it. A sample whose
    // time has passed is taken at once. A sample that is not finite is refused: false, nothing changes.
    // Excitation older than 0.1 s without a new one dies away: what lost its source must not drone.
    bool excite(const contact::ContactSample& next);
    // Frames until the last sample is reached.
    std::int64_t frames_left() const { return std::max<std::int64_t>(arrival_ * kQuantumFrames - frame_, 0); }
    // No contact from now on.
    void release();
    // Longest time that a release sounds on.
    double tail_seconds() const;
    // interleaved.size() / 2 frames.
    void render(std::span<float> interleaved);

    // excite() and everything up to it, in blocks handed to sink(std::span<const float> interleaved).
    template <class Sink>
    bool play_to(const contact::ContactSample& next, Sink&& sink) {
        const bool taken = excite(next);
        play(frames_left(), sink);
        return taken;
    }
    // What sounds goes on as it is until `t_s`, however long that takes.
    template <class Sink>
    void play_on(double t_s, Sink&& sink) {
        alive_until_ = std::max(alive_until_, frame_at(t_s) / kQuantumFrames);
        play(frame_at(t_s) - frame_, sink);
    }
    // The rest of a track of `duration_s`, and tail_seconds() more in which whatever sounds dies away.
    template <class Sink>
    void play_out(double duration_s, Sink&& sink) {
        play(frame_at(duration_s) - frame_, sink);
        release();
        play(frame_at(duration_s + tail_seconds()) - frame_, sink);
    }
    // The frame next to a time.
    std::int64_t frame_at(double t_s) const;

  private:
    static constexpr int kBlockFrames = 1024;
    static constexpr double kHoldSeconds = 0.1;
    template <class Sink>
    void play(std::int64_t frames, Sink&& sink) {
        std::array<float, kChannels * kBlockFrames> block;
        while (frames > 0) {
            const std::int64_t n = std::min<std::int64_t>(frames, kBlockFrames);
            const std::span<float> part(block.data(), static_cast<std::size_t>(kChannels * n));
            render(part);
            sink(std::span<const float>(part));
            frames -= n;
        }
    }
    double rolloff_now() const;
    void make_quantum();
    void place(const Quantum& pressure_pa);
    Vec3 in_metres(Vec3 mm) const { return options_.distance_factor / 1000 * mm; }

    SoundtrackOptions options_;
    std::vector<std::unique_ptr<Voice>> voices_;
    double samples_per_pascal_ = 0;
    double ring_s_ = 0;             // of the bodies
    std::int64_t quantum_ = 0;      // the next one to be made
    std::int64_t frame_ = 0;        // the next one to be given out
    std::int64_t arrival_ = 0;      // quantum at which the last sample is reached
    std::int64_t alive_until_ = 0;  // quantum from which nobody answers for the excitation
    bool excited_ = false, released_ = true;
    double rolloff_from_ = 1, rolloff_to_ = 1;
    std::int64_t departure_ = 0;                // quantum at which rolloff_from_ held
    double slow_ = 1;                           // half way through the smoothing
    double before_ = 1, here_ = 1, after_ = 1;  // smooth, a quantum apart
    std::unique_ptr<SpatialSource> source_;     // none: both channels alike
    std::unique_ptr<RoomReflections> room_;     // none: no room
    Glide source_m_;
    Listener listener_;
    Ears made_;  // the last quantum; frame_ says how much of it is out
};

// `seconds` of an unchanging cut, one channel, long enough after its start to be steady: what figure 8 of the
// paper shows. Options and sample as for a Soundtrack.
std::vector<float> steady_wave(const contact::ContactSample& cut, const SoundtrackOptions& options,
                               double seconds);

}  // namespace tribo::sound
