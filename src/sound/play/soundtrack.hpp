// SPDX-License-Identifier: MIT
// Renders contact samples as stereo sound: voices, distance, level, limiter.
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
#include "sound/play/position_smoother.hpp"

namespace tribo::sound {

inline constexpr int kChannels = 2;
inline constexpr double kTailSeconds = 0.02;  // upper limit of the decay at the source
// With a head: until all sound has arrived.
inline constexpr double kLongestTailSeconds =
    kTailSeconds + kLongestRingSeconds + kLongestTravelSeconds + 0.5;
inline constexpr int kLowestSampleRateHz = 32000;  // enough for machines and chips; no sound above 14 kHz
inline constexpr int kHighestSampleRateHz = 192000;

struct SoundtrackOptions {
    int sample_rate_hz = 48000;  // kLowestSampleRateHz ... kHighestSampleRateHz
    double gain_db = 0;          // -120 ... 60
    Vec3 listener_mm;            // stock frame; looks along +y, up is +z
    double reference_distance_m =
        kReferenceDistance;      // a nearer source gets no louder; kLeastReferenceDistance ... 100
    double distance_factor = 1;  // > 0; factor on distances (from the paper; > 1 enlarges a small part)
    // Head with the same sample rate. Null: both channels are equal, and distance only changes the level.
    std::shared_ptr<const Head> head{};
    bool as_published = false;  // eq. 23 as printed in place of all voices, without a room
    std::uint64_t seed = 1;     // of the noise
    Body tool{};                // its modes are used, its `direct` is not
    Machine machine{};          // none
    ChipOptions chips{};        // none
    Room room{};                // none; heard with a head only
    // Recorded cut that follows the spindle, with its share of the power, 0 ... 1 (the synthesis has the
    // rest). Recorded idle spindle in place of the spindle of the machine, with its RMS pressure at 1 m.
    std::shared_ptr<const Recording> recording{}, idle{};
    double recording_share = 0.5, idle_pa = 0.02;
};

// Refuses values out of range. The error names the key of the job file.
Result<void> check(const SoundtrackOptions& options);

// Pressure of a source at `distance_mm` relative to the pressure at 1 m: 1 / r, limited to its value at the
// reference distance.
double rolloff(double distance_mm, double distance_factor, double reference_m = kReferenceDistance);

// Renders frames 0, 1, 2, ... of an interleaved stereo track: sample = soft_limit(gain * pressure at the ear
// / kFullScalePascal), within -1 ... 1, never normalised. Frame n is at time n / sample_rate of the contact
// samples and contains the sound that has arrived by then. The bits do not depend on block sizes. A minute
// with 32 partials and a head takes 0.33 s, with machine, chips and room 0.54 s.
//
// excite(), release() and render() are real-time safe; one thread at a time.
class Soundtrack {
  public:
    // Makes the voices of a cut from the options.
    explicit Soundtrack(const SoundtrackOptions& options);
    // Uses the given voices.
    Soundtrack(const SoundtrackOptions& options, std::vector<std::unique_ptr<Voice>> voices);

    int sample_rate_hz() const { return options_.sample_rate_hz; }
    std::int64_t frames_rendered() const { return frame_; }

    // Moves the contact to `next`. Render frames_left() frames before the next call. A sample in the past
    // takes effect at once. A sample that is not finite returns false and changes nothing. Without a new
    // sample for 0.1 s the excitation fades, so that a lost source does not drone.
    bool excite(const contact::ContactSample& next);
    // Frames until the time of the last sample.
    std::int64_t frames_left() const { return std::max<std::int64_t>(arrival_ * kQuantumFrames - frame_, 0); }
    // Ends the contact.
    void release();
    // Longest sound after release().
    double tail_seconds() const;
    // interleaved.size() / 2 frames.
    void render(std::span<float> interleaved);

    // Calls excite() and renders up to the sample, in blocks to sink(std::span<const float> interleaved).
    template <class Sink>
    bool play_to(const contact::ContactSample& next, Sink&& sink) {
        const bool taken = excite(next);
        play(frames_left(), sink);
        return taken;
    }
    // Continues the current sound until `t_s`, for any duration.
    template <class Sink>
    void play_on(double t_s, Sink&& sink) {
        alive_until_ = std::max(alive_until_, frame_at(t_s) / kQuantumFrames);
        play(frame_at(t_s) - frame_, sink);
    }
    // Renders the rest of a track of `duration_s`, then release() and tail_seconds() more.
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
    double ring_s_ = 0;             // decay time of the bodies
    std::int64_t quantum_ = 0;      // next quantum to render
    std::int64_t frame_ = 0;        // next frame to return
    std::int64_t arrival_ = 0;      // quantum of the last sample
    std::int64_t alive_until_ = 0;  // the excitation fades from this quantum on
    bool excited_ = false, released_ = true;
    double rolloff_from_ = 1, rolloff_to_ = 1;
    std::int64_t departure_ = 0;                // quantum at which rolloff_from_ held
    double slow_ = 1;                           // half way through the smoothing
    double before_ = 1, here_ = 1, after_ = 1;  // smoothed rolloff, one quantum apart
    std::unique_ptr<SpatialSource> source_;     // null: both channels are equal
    std::unique_ptr<RoomReflections> room_;     // null: no room
    PositionSmoother source_m_;
    Listener listener_;
    Ears made_;  // the last quantum; frame_ says how much of it was returned
};

// `seconds` of a constant cut after its start transient, one channel, as in figure 8 of the paper. Options
// and sample as for a Soundtrack.
std::vector<float> steady_wave(const contact::ContactSample& cut, const SoundtrackOptions& options,
                               double seconds);

}  // namespace tribo::sound
