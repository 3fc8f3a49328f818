// SPDX-License-Identifier: MIT
#include "force_grid.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/math.hpp"
#include "milling/force/force.hpp"

namespace tribo::bench {
namespace {

double at(double from, double to, int n, int count) {
    return from + (to - from) * n / (count - 1);
}

}  // namespace

ForceGrid::ForceGrid(milling::Cutter cutter, const milling::CuttingCoefficients& coefficients,
                     const ForceGridOptions& o, const ParallelFor& parallel)
    : options_(o), period_rad_(math::kTwoPi / cutter.flutes) {
    assert(o.rotations >= 2 && o.entries >= 2 && o.exits >= 2 && o.helices >= 2 && o.feeds >= 2);
    const std::array counts{o.rotations, o.entries, o.exits, o.helices, o.feeds};
    std::size_t size = 3;
    for (std::size_t axis = 0; axis < counts.size(); ++axis) {
        stride_[axis] = size;
        size *= static_cast<std::size_t>(counts[axis]);
    }
    values_.assign(size, 0.0F);
    parallel(static_cast<std::size_t>(o.helices), [&](std::size_t helix) {
        milling::Cutter turned = cutter;
        turned.helix_deg = at(o.helix_from_deg, o.helix_to_deg, static_cast<int>(helix), o.helices);
        milling::ForceModel model(turned, coefficients);
        for (int feed = 0; feed < o.feeds; ++feed) {
            for (int exit = 0; exit < o.exits; ++exit) {
                for (int entry = 0; entry < o.entries; ++entry) {
                    const double from = at(0, math::kPi, entry, o.entries),
                                 to = at(0, math::kPi, exit, o.exits);
                    if (from >= to) continue;  // nothing cuts
                    milling::Engagement engagement;
                    engagement.bands.push_back({0, o.axial_depth_mm, from, to});
                    model.engage(engagement, {at(o.feed_from_mm, o.feed_to_mm, feed, o.feeds), 0});
                    float* out = values_.data() + stride_[1] * static_cast<std::size_t>(entry) +
                                 stride_[2] * static_cast<std::size_t>(exit) + stride_[3] * helix +
                                 stride_[4] * static_cast<std::size_t>(feed);
                    for (int n = 0; n < o.rotations; ++n) {
                        const Vec3 force = model.at(at(0, period_rad_, n, o.rotations)).force_n;
                        for (int c = 0; c < 3; ++c) *out++ = static_cast<float>(force[c]);
                    }
                }
            }
        }
    });
}

ForceGrid::Place ForceGrid::place(double value, double from, double to, int count) {
    const double cells = (value - from) / (to - from) * (count - 1);
    const double inside = std::clamp(cells, 0.0, static_cast<double>(count - 1));
    const double low = std::min(std::floor(inside), static_cast<double>(count - 2));
    return {static_cast<std::size_t>(low), inside - low};
}

Vec3 ForceGrid::force_n(double rotation_rad, double entry_rad, double exit_rad, double helix_deg,
                        double feed_per_tooth_mm) const noexcept {
    const ForceGridOptions& o = options_;
    const double turn = rotation_rad - period_rad_ * std::floor(rotation_rad / period_rad_);
    const std::array places{place(turn, 0, period_rad_, o.rotations),
                            place(entry_rad, 0, math::kPi, o.entries), place(exit_rad, 0, math::kPi, o.exits),
                            place(helix_deg, o.helix_from_deg, o.helix_to_deg, o.helices),
                            place(feed_per_tooth_mm, o.feed_from_mm, o.feed_to_mm, o.feeds)};
    Vec3 sum;
    for (std::size_t corner = 0; corner < 32; ++corner) {
        double weight = 1;
        std::size_t index = 0;
        for (std::size_t axis = 0; axis < places.size(); ++axis) {
            const bool high = (corner >> axis) & 1;
            weight *= high ? places[axis].share : 1 - places[axis].share;
            index += stride_[axis] * (places[axis].low + (high ? 1 : 0));
        }
        const float* v = values_.data() + index;
        sum += weight * Vec3{static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
    }
    return sum;
}

}  // namespace tribo::bench
