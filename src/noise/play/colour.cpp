// SPDX-License-Identifier: MIT
#include "noise/play/colour.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "base/math.hpp"
#include "noise/model/levinson.hpp"

namespace tribo::noise {
namespace {

constexpr double kNepersPerDb = 0.11512925464970229;  // of amplitude, ln 10 / 20
constexpr double kDeepestDb = 200;
constexpr double kWhite = 1e-9;  // share of the power, so that empty bands stay well conditioned

}  // namespace

ArModel model_of(std::span<const ColourPoint> colour, double sample_rate_hz, int order) {
    assert(colour.size() >= 2 && order >= 1 && order <= kLargestOrder);
    constexpr int kSteps = 4096;
    double highest = colour[0].db;
    for (const ColourPoint& p : colour) highest = std::max(highest, p.db);
    std::vector<double> autocorrelation(static_cast<std::size_t>(order) + 1);
    std::size_t line = 0;
    for (int n = 0; n < kSteps; ++n) {
        const double share = (n + 0.5) / kSteps, hz = 0.5 * sample_rate_hz * share;
        while (line + 2 < colour.size() && hz > colour[line + 1].hz) ++line;
        const ColourPoint &a = colour[line], &b = colour[line + 1];
        const double db = a.db + (b.db - a.db) * math::log(hz / a.hz) / math::log(b.hz / a.hz) - highest;
        // The width of a third octave is proportional to its centre, so the density is level / hz.
        const double density = math::exp(2 * kNepersPerDb * std::max(db, -kDeepestDb)) / hz;
        for (std::size_t k = 0; k < autocorrelation.size(); ++k) {
            autocorrelation[k] += density * math::cos(math::kPi * share * static_cast<double>(k));
        }
    }
    return {sample_rate_hz, levinson(autocorrelation, kWhite)};
}

}  // namespace tribo::noise
