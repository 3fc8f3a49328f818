// SPDX-License-Identifier: MIT
#include "report/picture/saw_marks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/math.hpp"
#include "base/noise_hash.hpp"

namespace tribo::report {
namespace {

constexpr double kBroadPerMm = 0.7, kFinePerMm = 3;

// Smooth noise, -0.5 to 0.5.
double noise_at(double s) {
    constexpr CounterNoise noise(1);
    const double whole = std::floor(s), f = s - whole, share = f * f * (3 - 2 * f);
    const auto n = static_cast<std::uint64_t>(static_cast<std::int64_t>(whole));
    const double from = noise.uniform(n), to = noise.uniform(n + 1);
    return from + share * (to - from) - 0.5;
}

// A grazed surface has an endless pixel.
double seen(double per_mm, double pixel_mm) {
    return pixel_mm < 1e3 ? std::clamp(1 - 1.2 * pixel_mm * per_mm, 0.0, 1.0) : 0;
}

}  // namespace

double saw_path(Vec3 p) {
    return dot(p, Vec3{0.12, 0.83, 0.55}) + 0.15 * math::sin(0.21 * p.x);
}

float saw_marks(Vec3 place, double pixel_mm) {
    const double s = saw_path(place);
    return static_cast<float>(0.65 * seen(kBroadPerMm, pixel_mm) * noise_at(kBroadPerMm * s) +
                              0.5 * seen(kFinePerMm, pixel_mm) * noise_at(kFinePerMm * s));
}

}  // namespace tribo::report
