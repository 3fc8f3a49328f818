// SPDX-License-Identifier: MIT
#include "sound/play/soundtrack.hpp"

#include <cassert>
#include <cmath>
#include <string>

#include "base/math.hpp"
#include "sound/cut/cutting_voice.hpp"
#include "sound/cut/machine_voice.hpp"
#include "sound/cut/partials.hpp"
#include "sound/cut/published_voice.hpp"
#include "sound/cut/vibration_voice.hpp"
#include "sound/play/calibration.hpp"
#include "sound/play/limiter.hpp"

namespace tribo::sound {
namespace {

constexpr double kMmPerM = 1000;

// The loudness of a source that leaps follows by this share of what is left per quantum, twice over: 21 ms.
constexpr double kFollow = 0.125;

// In which a spindle that nobody tells of any more dies away by 120 dB.
constexpr double kFadeSeconds = 0.2;

std::vector<std::unique_ptr<Voice>> cutting_voices(const SoundtrackOptions& options) {
    std::vector<std::unique_ptr<Voice>> voices;
    if (options.as_published) {
        voices.push_back(std::make_unique<PublishedVoice>(options.sample_rate_hz));
    } else {
        const Machine& machine = options.machine;
        CuttingVoiceOptions cut;
        cut.sample_rate_hz = options.sample_rate_hz;
        cut.seed = options.seed;
        cut.sound = {with_modes(machine.radiation, options.tool, machine.tool_gain), machine.sound_share,
                     options.chips};
        RecordedVoiceOptions recorded;
        recorded.sample_rate_hz = options.sample_rate_hz;
        recorded.cut = cut.sound;
        if (options.recording) {
            math::sincos(math::kHalfPi * options.recording_share, recorded.share, cut.share);
            voices.push_back(std::make_unique<RecordedVoice>(*options.recording, recorded));
        }
        voices.push_back(std::make_unique<CuttingVoice>(cut));
        voices.push_back(std::make_unique<VibrationVoice>(
            VibrationVoiceOptions{cut.sample_rate_hz, cut.share, cut.sound.body}));
        if (options.idle) {
            recorded.share = 1;
            recorded.idle_pa = options.idle_pa;
            voices.push_back(std::make_unique<RecordedVoice>(*options.idle, recorded));
        } else if (machine.spindle.pa > 0) {
            MachineVoiceOptions spindle;
            spindle.sample_rate_hz = options.sample_rate_hz;
            spindle.seed = options.seed + 1;
            spindle.spindle = machine.spindle;
            // What a recorded cut was learned or looped from holds the sound of its machine.
            spindle.share_in_cut = options.chips.learned ? 0 : cut.share;
            voices.push_back(std::make_unique<MachineVoice>(spindle));
        }
    }
    return voices;
}

}  // namespace

Result<void> check(const SoundtrackOptions& options) {
    if (options.sample_rate_hz < kLowestSampleRateHz || options.sample_rate_hz > kHighestSampleRateHz) {
        return fail("a sample rate of " + std::to_string(options.sample_rate_hz) + " Hz",
                    "try 48000 or 44100 (" + std::to_string(kLowestSampleRateHz) + " to " +
                        std::to_string(kHighestSampleRateHz) + " are possible)");
    }
    if (!(options.gain_db >= -120 && options.gain_db <= 60)) {
        return fail("gain_db is outside -120 ... 60", "try 0, or a few dB up or down");
    }
    if (!is_finite(options.listener_mm)) {
        return fail("listener_mm is not three finite numbers", "try the centre of the stock's top");
    }
    if (!(options.recording_share >= 0 && options.recording_share <= 1)) {
        return fail("recording_share is outside 0 ... 1", "try 0.5");
    }
    if (!(options.idle_pa >= 0 && options.idle_pa <= 20)) {
        return fail("the idle spindle's pressure is outside 0 ... 20 Pa", "try 0.02, 60 dB SPL");
    }
    for (const auto& recording : {options.recording, options.idle}) {
        if (!recording) continue;
        if (auto ok = check_recording(*recording); !ok) return ok;
    }
    if (options.head && options.head->sample_rate_hz() != options.sample_rate_hz) {
        return fail("the head's sample rate is not the track's", "make it for the track's");
    }
    if (!(options.distance_factor > 0 && std::isfinite(options.distance_factor))) {
        return fail("distance_factor is not above 0", "try 1, or more to make a small part sound larger");
    }
    if (!(options.reference_distance_m >= kLeastReferenceDistance && options.reference_distance_m <= 100)) {
        return fail("reference_distance_m is outside 0.05 ... 100", "try 1, or 0.2 to be loud near the tool");
    }
    return {};
}

double rolloff(double distance_mm, double distance_factor, double reference_m) {
    return 1 / std::max(reference_m, distance_factor * distance_mm / kMmPerM);
}

Soundtrack::Soundtrack(const SoundtrackOptions& options) : Soundtrack(options, cutting_voices(options)) {}

Soundtrack::Soundtrack(const SoundtrackOptions& options, std::vector<std::unique_ptr<Voice>> voices)
    : options_(options),
      voices_(std::move(voices)),
      samples_per_pascal_(math::pow(10, options.gain_db / 20) / kFullScalePascal) {
    assert(check(options));
    if (options.head) source_ = std::make_unique<SpatialSource>(options.head);
    if (options.head && options.room.reflects() && !options.as_published) {
        room_ = std::make_unique<RoomReflections>(options.room, in_metres(options.listener_mm),
                                                  options.sample_rate_hz, options.head->ears_apart_m());
    }
    ring_s_ = std::max(ring_seconds(options.machine.radiation), ring_seconds(options.tool));
    listener_.reference_m = options.reference_distance_m;
    listener_.position_m = in_metres(options.listener_mm);
}

std::int64_t Soundtrack::frame_at(double t_s) const {
    constexpr double kFarthest = 0x1p52;
    return static_cast<std::int64_t>(
        std::clamp(std::floor(t_s * options_.sample_rate_hz + 0.5), 0.0, kFarthest));
}

bool Soundtrack::excite(const contact::ContactSample& next) {
    if (!contact::is_finite(next)) return false;
    const std::int64_t asked = (frame_at(next.t_s) + kQuantumFrames / 2) / kQuantumFrames;
    const std::int64_t arrival = std::max(asked, quantum_);
    // The voices reach it at the border of a quantum; the angle is brought to that moment.
    contact::ContactSample there = next;
    const double shift_s = static_cast<double>(arrival * kQuantumFrames) / options_.sample_rate_hz - next.t_s;
    there.phase_rad += shift_s * next.phase_rate_rad_per_s;
    for (const auto& voice : voices_) voice->excite(there, arrival - quantum_);

    const double loudness = rolloff(distance(next.position_mm, options_.listener_mm),
                                    options_.distance_factor, options_.reference_distance_m);
    if (!excited_) before_ = here_ = after_ = slow_ = rolloff_to_ = loudness;
    rolloff_from_ = arrival == quantum_ ? loudness : rolloff_now();
    rolloff_to_ = loudness;
    const bool unheard = !source_ || !source_->sounding();
    source_m_.set_target(in_metres(next.position_mm), arrival - quantum_,
                         !excited_ || (unheard && arrival == quantum_));
    departure_ = quantum_;
    arrival_ = alive_until_ = arrival;
    excited_ = true;
    released_ = false;
    return true;
}

void Soundtrack::release() {
    for (const auto& voice : voices_) voice->release();
    arrival_ = quantum_;
    released_ = true;
}

double Soundtrack::tail_seconds() const {
    const double air =
        std::max(source_ ? source_->seconds_to_silence() : 0, room_ ? room_->seconds_to_silence() : 0);
    return kTailSeconds + std::max(ring_s_, options_.machine.spindle.pa > 0 ? kFadeSeconds : 0) + air;
}

double Soundtrack::rolloff_now() const {
    if (quantum_ >= arrival_) return rolloff_to_;
    const double t = static_cast<double>(quantum_ - departure_) / static_cast<double>(arrival_ - departure_);
    return rolloff_from_ + t * (rolloff_to_ - rolloff_from_);
}

void Soundtrack::make_quantum() {
    if (!released_ && static_cast<double>((quantum_ - alive_until_) * kQuantumFrames) >
                          kHoldSeconds * options_.sample_rate_hz) {
        release();
    }
    Quantum pressure_pa{};
    for (const auto& voice : voices_) voice->add(pressure_pa);
    if (source_) {
        place(pressure_pa);
    } else {
        before_ = here_;
        here_ = after_;
        slow_ += kFollow * (rolloff_now() - slow_);
        after_ += kFollow * (slow_ - after_);
        const Spline loudness(before_, here_, after_);
        for (std::size_t j = 0; j < made_.left.size(); ++j) {
            const double share = loudness.at(static_cast<double>(j) * (1.0 / kQuantumFrames));
            made_.left[j] = static_cast<float>(soft_limit(samples_per_pascal_ * share * pressure_pa[j]));
        }
        made_.right = made_.left;
    }
    ++quantum_;
}

void Soundtrack::place(const Quantum& pressure_pa) {
    made_ = {};
    const Vec3 place_m = source_m_.advance();
    source_->add(pressure_pa, place_m, listener_, made_);
    if (room_) room_->add(pressure_pa, place_m, listener_, made_);
    for (EarQuantum* ear : {&made_.left, &made_.right}) {
        for (float& v : *ear)
            v = static_cast<float>(soft_limit(samples_per_pascal_ * static_cast<double>(v)));
    }
}

void Soundtrack::render(std::span<float> interleaved) {
    for (std::size_t i = 0; i + 1 < interleaved.size(); i += kChannels) {
        const auto n = static_cast<std::size_t>(frame_ % kQuantumFrames);
        if (n == 0) make_quantum();
        interleaved[i] = made_.left[n];
        interleaved[i + 1] = made_.right[n];
        ++frame_;
    }
}

std::vector<float> steady_wave(const contact::ContactSample& cut, const SoundtrackOptions& options,
                               double seconds) {
    constexpr double kStartSeconds = 0.05;
    SoundtrackOptions at_source = options;
    at_source.head = nullptr;
    Soundtrack track(at_source);
    std::vector<float> wave;
    const auto keep_left = [&](std::span<const float> block) {
        for (std::size_t i = 0; i < block.size(); i += kChannels) wave.push_back(block[i]);
    };
    contact::ContactSample moment = cut;
    moment.t_s = 0;
    track.play_to(moment, keep_left);
    moment.t_s = kStartSeconds + seconds + kTailSeconds;
    moment.phase_rad += moment.t_s * moment.phase_rate_rad_per_s;
    track.play_to(moment, keep_left);
    const auto length = static_cast<std::size_t>(track.frame_at(seconds));
    const auto start = static_cast<std::size_t>(track.frame_at(kStartSeconds));
    wave.resize(start + length);
    wave.erase(wave.begin(), wave.begin() + static_cast<std::ptrdiff_t>(start));
    return wave;
}

}  // namespace tribo::sound
