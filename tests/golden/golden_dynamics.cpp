// SPDX-License-Identifier: MIT
#include "base/hash.hpp"
#include "base/math.hpp"
#include "dynamics/stability.hpp"
#include "dynamics/vibration.hpp"
#include "golden/golden.hpp"

namespace tribo::golden {
namespace {

const milling::CuttingCoefficients kMaterial{700, 250, 60, 12, 14, 2};
const dynamics::Mode kModes[] = {{{1, 0, 0}, 922, 0.011, 1340},
                                 {{0.2, 1, 0.1}, 1400, 0.03, 2500},
                                 {{0, 1, 0.3}, 410, 0.02, 3000, dynamics::ModeOn::part}};
const milling::EngagementBand kBands[] = {{0, 0.8, 0.3, 2.6}, {0.8, 2, 0, 1.4}};

void add_stability(Hash& hash, const milling::Cutter& cutter) {
    const auto at = [&](double rpm, double depth_mm) {
        milling::EngagementBand bands[] = {kBands[0], kBands[1]};
        for (milling::EngagementBand& band : bands) {
            band.z0_mm *= depth_mm / 2;
            band.z1_mm *= depth_mm / 2;
        }
        return dynamics::stability(kModes, dynamics::CutFeedback(cutter, kMaterial, bands, rpm));
    };
    for (const double rpm : {4000.0, 7300.0, 12000.0}) {
        const dynamics::Stability s = at(rpm, 2);
        for (const double v : {s.multiplier, s.angle_rad, s.chatter_hz, s.period_s}) hash.add(v);
        hash.add(static_cast<int>(s.kind));
        const auto limit =
            dynamics::depth_limit([&](double depth_mm) { return at(rpm, depth_mm); }, cutter.length_mm);
        hash.add(limit.depth_mm.value_or(-1));
        hash.add(limit.there.multiplier);
    }
}

// Enters the cut, turns its feed and changes its speed; far enough to jump out of the cut.
void add_vibration(Hash& hash, const milling::Cutter& cutter) {
    dynamics::Vibration vibration(kModes, cutter, kMaterial, 48000, 0.4);
    vibration.engage(kBands, {0.08, 0.01, 0, 0}, 7300);
    for (int n = 0; n < 6000; ++n) {
        if (n == 2000) vibration.engage(kBands, {0.08, 0, 0.001, -0.002}, 7300, 0.7);
        if (n == 4000) vibration.engage({kBands, 1}, {0.05, 0, 0, 0}, 9000, 0.7);
        const dynamics::VibrationSample sample = vibration.step();
        hash.add(sample.displacement_mm);
        hash.add(sample.force_n);
    }
}

}  // namespace

// Multipliers, limits and vibrations of a ball and of a bull cutter with run-out and unequal pitch.
std::uint64_t dynamics() {
    Hash hash;
    milling::Cutter ball, uneven;
    ball.kind = milling::CutterKind::ball;
    uneven.kind = milling::CutterKind::bull;
    uneven.corner_mm = 1;
    uneven.flutes = 4;
    uneven.pitch_deg = {85, 92, 88, 95};
    uneven.runout_mm = 0.01;
    uneven.runout_deg = 30;
    for (const milling::Cutter& cutter : {ball, uneven}) {
        add_stability(hash, cutter);
        add_vibration(hash, cutter);
    }
    return hash.value();
}

}  // namespace tribo::golden
