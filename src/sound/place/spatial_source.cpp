// SPDX-License-Identifier: MIT
#include "sound/place/spatial_source.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "sound/play/calibration.hpp"

namespace tribo::sound {
namespace {

// What a delay may change by in a quantum: pitch between a quarter and four times.
constexpr double kLongerPerQuantum = 0.75 * kQuantumFrames, kShorterPerQuantum = 3.0 * kQuantumFrames;
// Room before the first frame that a quantum reads.
constexpr std::size_t kBack = 1024;
constexpr int kRings = (kHeadTaps + kQuantumFrames - 1) / kQuantumFrames;

std::size_t power_of_two_from(double least) {
    std::size_t size = 1;
    while (static_cast<double>(size) < least) size *= 2;
    return size;
}

Course course(double before, double here, double after, double less) {
    return {static_cast<float>(0.5 * (before + here) - less), static_cast<float>(here - before),
            static_cast<float>(0.5 * (before - 2 * here + after))};
}

}  // namespace

HeadAxes Listener::axes() const {
    const Vec3 y = normalized(forward, {0, 1, 0});
    Vec3 right = cross(y, up);
    if (!(squared_length(right) > 1e-12 * squared_length(up))) right = cross(y, Vec3{0, 0, 1});
    if (!(squared_length(right) > 1e-12)) right = any_perpendicular(y);
    const Vec3 x = normalized(right, {1, 0, 0});
    return {x, y, cross(x, y)};
}

double rolloff_at(double distance_m, double reference_m) {
    return 1 / std::max(reference_m, distance_m);
}

SpatialSource::SpatialSource(std::shared_ptr<const Head> head, const EarKernels& kernels)
    : head_(std::move(head)),
      kernels_(&kernels),
      table_(&interpolator_table()),
      frames_per_metre_(head_->sample_rate_hz() / kSoundSpeed),
      size_(power_of_two_from((kLongestTravelSeconds + 2 * kEarLeadSeconds) * head_->sample_rate_hz() +
                              2 * kBack)) {
    line_.assign(2 * size_, 0);
    places_.resize(size_ / kQuantumFrames + 2);
}

double SpatialSource::seconds_to_silence() const {
    const std::int64_t left = std::max<std::int64_t>(quanta_to_pass() - silent_quanta_, 0);
    return static_cast<double>((left + tail_) * kQuantumFrames) / head_->sample_rate_hz();
}

// What was written so long ago has been read by both ears.
std::int64_t SpatialSource::quanta_to_pass() const {
    const double longest = std::max({before_.delay[0], before_.delay[1], after_.delay[0], after_.delay[1]});
    return static_cast<std::int64_t>((longest + kInterpolatorTaps) / kQuantumFrames) + 3;
}

void SpatialSource::write(const Quantum& pressure_pa) {
    now_ = (now_ + kQuantumFrames) & (size_ - 1);
    EarQuantum sound;
    unsigned any = 0;
    for (std::size_t n = 0; n < kQuantumFrames; ++n) {
        sound[n] = static_cast<float>(pressure_pa[n]);
        any |= std::bit_cast<unsigned>(sound[n]);
    }
    std::memcpy(line_.data() + now_, sound.data(), sizeof sound);
    std::memcpy(line_.data() + size_ + now_, sound.data(), sizeof sound);
    silent_quanta_ = any << 1 != 0 ? 0 : silent_quanta_ + 1;
}

// The time t of departure solves t = |place(now - t) - listener| / c; the last answer is near, and each round
// brings it nearer by the ratio of the source's speed to c.
Vec3 SpatialSource::retarded(const Listener& listener) {
    const double most = static_cast<double>(places_.size() - 2);
    Vec3 place;
    const auto place_at = [&](double quanta) {
        const auto n = static_cast<std::size_t>(quanta);
        const std::size_t a = newest_ >= n ? newest_ - n : newest_ + places_.size() - n;
        const std::size_t b = a > 0 ? a - 1 : places_.size() - 1;
        return lerp(places_[a], places_[b], quanta - static_cast<double>(n));
    };
    // It goes on as it went: half the rounds are spared.
    const double was = travelled_;
    travelled_ = std::clamp(travelled_ + slower_, 0.0, most);
    constexpr int kRounds = 6;
    for (int round = 0; round < kRounds; ++round) {
        place = place_at(std::min(travelled_, most));
        const double next = distance(place, listener.position_m) * frames_per_metre_ / kQuantumFrames;
        const bool there = std::abs(next - travelled_) < 1e-5;  // what is left shrinks once more
        travelled_ = std::min(next, most);
        if (there) break;
    }
    slower_ = travelled_ - was;
    return place_at(travelled_);
}

SpatialSource::State SpatialSource::state(Vec3 place_m, const Listener& listener, EarResponses& heard) {
    const Vec3 towards = place_m - listener.position_m;
    const double rate = head_->sample_rate_hz(), metres = length(towards);
    head_->hear(axes_.to_head_frame(towards), metres * (1 / kHeadRadius), heard, *kernels_);
    const double travel = std::min(metres * frames_per_metre_, kLongestTravelSeconds * rate);
    State s;
    for (std::size_t ear = 0; ear < 2; ++ear) {
        const double offset = std::clamp(heard.delay_s[ear], -kEarLeadSeconds / 2, kEarLeadSeconds);
        s.delay[ear] = travel + (offset + kEarLeadSeconds) * rate;
    }
    s.gain = rolloff_at(metres, listener.reference_m);
    return s;
}

// Nothing is under way: everything is where it should be.
void SpatialSource::settle(Vec3 place_m, const Listener& listener) {
    std::fill(places_.begin(), places_.end(), place_m);
    travelled_ = slower_ = 0;
    before_ = here_ = after_ = state(retarded(listener), listener, responses_[0]);
    slower_ = 0;
    responses_[1] = responses_[0];
    placed_ = true;
}

void SpatialSource::add(const Quantum& pressure_pa, Vec3 place_m, const Listener& listener, Ears& out) {
    const bool unmoved = placed_ && place_m == places_[newest_] && listener == listener_;
    newest_ = newest_ + 1 < places_.size() ? newest_ + 1 : 0;
    places_[newest_] = place_m;
    if (!placed_ || !(listener == listener_)) axes_ = listener.axes();
    listener_ = listener;
    unmoved_ = unmoved ? unmoved_ + 1 : 0;
    if (!placed_) settle(place_m, listener);
    write(pressure_pa);
    if (!sounding()) {
        placed_ = false;  // free to leap until something sounds
        return;
    }
    before_ = here_;
    here_ = after_;
    // Nothing has moved since before the sound that arrives now set out: nothing to work out.
    constexpr double kSettled = 4;
    const bool settled = unmoved_ > travelled_ + kSettled && before_.delay == here_.delay;
    if (!settled) {
        to_ = 1 - to_;
        after_ = state(retarded(listener), listener, responses_[to_]);
        for (std::size_t ear = 0; ear < 2; ++ear) {
            after_.delay[ear] = std::clamp(after_.delay[ear], here_.delay[ear] - kShorterPerQuantum,
                                           here_.delay[ear] + kLongerPerQuantum);
        }
    }
    play(!settled, out);
}

void SpatialSource::play(bool moves, Ears& out) {
    const auto &from = responses_[1 - to_].taps, &to = responses_[to_].taps;
    moves = moves && std::memcmp(&from, &to, sizeof from) != 0;
    const Course gain = course(before_.gain, here_.gain, after_.gain, 0);
    for (std::size_t ear = 0; ear < 2; ++ear) {
        float* past = ear_[ear].data();
        std::memmove(past, past + kQuantumFrames, kHeadTaps * sizeof(float));
        float* x = past + kHeadTaps;
        const double whole = std::floor(0.5 * (before_.delay[ear] + here_.delay[ear]));
        const Course delay = course(before_.delay[ear], here_.delay[ear], after_.delay[ear], whole);
        const std::size_t base = (now_ + 2 * size_ - static_cast<std::size_t>(whole) - kBack) & (size_ - 1);
        kernels_->read(line_.data() + base + kBack, *table_, delay, gain, x);
        EarQuantum& heard = ear == 0 ? out.left : out.right;
        if (moves) {
            kernels_->convolve(x, from[ear].data(), to[ear].data(), head_->taps(), heard.data());
        } else {
            kernels_->convolve_still(x, to[ear].data(), head_->taps(), heard.data());
        }
    }
    tail_ = under_way() ? kRings : std::max(tail_ - 1, 0);
    if (tail_ == 0) {
        for (auto& past : ear_) past.fill(0);
    }
}

}  // namespace tribo::sound
