// SPDX-License-Identifier: MIT
#include "sound/place/room.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/math.hpp"
#include "sound/place/head.hpp"

namespace tribo::sound {
namespace {

// Walls stand at different distances, so that no two images come at once.
constexpr Room kRooms[] = {
    {},
    {"workshop",
     "a shop of 9 x 11 m with a ceiling of 3.8 m",
     {-3.7, -4.6, -1.1},
     {5.3, 6.4, 2.7},
     0.7,
     5000,
     1},
    {"hall", "a factory hall of 30 x 45 m, 9 m high", {-12, -19, -1.1}, {18, 26, 7.9}, 0.75, 4000, 1},
    {"cabin",
     "the closed cabin of a machine, steel and glass",
     {-0.75, -0.62, -0.45},
     {0.9, 0.7, 1.05},
     0.8,
     7000,
     0.7},
};
// Nearest that source and listener come to a wall, m.
constexpr double kClearance = 0.05;
// By how much an ear in the shadow loses against the other, as a share of the pressure: half of what a head
// does to a source at its side in the middle of the spectrum.
constexpr double kShadow = 0.3;

// The image of a point behind a wall: 0, 1, 2 across x, y, z at the low end, 3, 4, 5 at the high one.
Vec3 mirrored(Vec3 p, std::size_t wall, Vec3 low, Vec3 high) {
    const Vec3 at = wall < 3 ? low : high;
    if (wall % 3 == 0) return {2 * at.x - p.x, p.y, p.z};
    if (wall % 3 == 1) return {p.x, 2 * at.y - p.y, p.z};
    return {p.x, p.y, 2 * at.z - p.z};
}

Vec3 inside(Vec3 p, Vec3 low, Vec3 high) {
    return {std::clamp(p.x, low.x, high.x), std::clamp(p.y, low.y, high.y), std::clamp(p.z, low.z, high.z)};
}

}  // namespace

std::span<const Room> rooms() {
    return kRooms;
}

RoomReflections::RoomReflections(const Room& room, Vec3 centre_m, double sample_rate_hz, double ears_apart_m)
    : room_(room),
      low_m_(centre_m + room.low_m),
      high_m_(centre_m + room.high_m),
      sample_rate_hz_(sample_rate_hz),
      ears_apart_m_(ears_apart_m) {
    keep_ = math::exp(-math::kTwoPi * room.highest_hz / sample_rate_hz);
    // The longest way: from corner to corner of the box and its image.
    const double longest_m = 2 * distance(low_m_, high_m_) + ears_apart_m;
    const double frames = longest_m / kSoundSpeed * sample_rate_hz;
    size_ = std::bit_ceil(static_cast<std::size_t>(frames) + 4 * kQuantumFrames);
    quanta_to_pass_ = static_cast<std::int64_t>(frames) / kQuantumFrames + 2;
    line_.assign(2 * size_, 0);
}

double RoomReflections::seconds_to_silence() const {
    const std::int64_t left = std::max<std::int64_t>(quanta_to_pass_ - silent_quanta_, 0);
    return static_cast<double>(left * kQuantumFrames) / sample_rate_hz_;
}

RoomReflections::Taps RoomReflections::taps(Vec3 place_m, const Listener& listener) const {
    const Vec3 margin{kClearance, kClearance, kClearance};
    const Vec3 source = inside(place_m, low_m_ + margin, high_m_ - margin);
    const Vec3 head = inside(listener.position_m, low_m_ + margin, high_m_ - margin);
    const HeadAxes axes = listener.axes();
    Taps taps;
    for (std::size_t n = 0; n < kImages; ++n) {
        const Vec3 image = mirrored(source, n, low_m_, high_m_);
        const double side = dot(normalized(image - head, {0, 1, 0}), axes.right);
        for (std::size_t ear = 0; ear < 2; ++ear) {
            const double sign = ear == 0 ? -1 : 1;
            const double way = distance(image, head + 0.5 * sign * ears_apart_m_ * axes.right);
            const double frames = (way / kSoundSpeed + kEarLeadSeconds) * sample_rate_hz_;
            const double gain = room_.level * room_.reflection * rolloff_at(way, listener.reference_m) *
                                (1 + sign * kShadow * side);
            taps[ear][n] = {static_cast<std::size_t>(frames + 0.5), static_cast<float>(gain)};
        }
    }
    return taps;
}

void RoomReflections::add(const Quantum& pressure_pa, Vec3 place_m, const Listener& listener, Ears& out) {
    now_ = (now_ + kQuantumFrames) & (size_ - 1);
    EarQuantum sound;
    bool any = false;
    for (std::size_t n = 0; n < sound.size(); ++n) {
        sound[n] = static_cast<float>(pressure_pa[n]);
        any = any || sound[n] != 0;
    }
    std::copy(sound.begin(), sound.end(), line_.begin() + static_cast<std::ptrdiff_t>(now_));
    std::copy(sound.begin(), sound.end(), line_.begin() + static_cast<std::ptrdiff_t>(size_ + now_));
    silent_quanta_ = any ? 0 : silent_quanta_ + 1;
    if (!sounding()) {
        lowered_ = {};
        placed_ = false;
        return;
    }
    const bool moved = !placed_ || !(place_m == place_m_) || !(listener == listener_);
    const Taps before = here_;
    if (moved) here_ = taps(place_m, listener);
    const Taps& from = placed_ ? before : here_;
    placed_ = true;
    place_m_ = place_m;
    listener_ = listener;
    for (std::size_t ear = 0; ear < 2; ++ear) {
        EarQuantum sum{};
        const auto read = [&](const Tap& tap) { return line_.data() + now_ + size_ - tap.delay; };
        for (std::size_t n = 0; n < kImages; ++n) {
            const Tap &a = from[ear][n], &b = here_[ear][n];
            const float *x = read(a), *y = read(b);
            const float step = 1.0F / kQuantumFrames;
            if (a.delay == b.delay) {
                for (std::size_t j = 0; j < sum.size(); ++j) {
                    sum[j] += (a.gain + static_cast<float>(j) * step * (b.gain - a.gain)) * x[j];
                }
            } else {
                for (std::size_t j = 0; j < sum.size(); ++j) {
                    const float t = static_cast<float>(j) * step;
                    sum[j] += (1 - t) * a.gain * x[j] + t * b.gain * y[j];
                }
            }
        }
        EarQuantum& heard = ear == 0 ? out.left : out.right;
        double low = lowered_[ear];
        for (std::size_t j = 0; j < sum.size(); ++j) {
            low = static_cast<double>(sum[j]) + keep_ * (low - static_cast<double>(sum[j]));
            heard[j] += static_cast<float>(low);
        }
        lowered_[ear] = low;
    }
}

}  // namespace tribo::sound
