// SPDX-License-Identifier: MIT
// Whether a cut chatters: one point of the benchmark of the literature, and a chart of it.
#include "dynamics/stability.hpp"

#include <string>

#include "base/math.hpp"
#include "dynamics/chebyshev_collocation.hpp"
#include "dynamics/stability_chart.hpp"
#include "dynamics/surface_by_angle.hpp"
#include "dynamics/vibration.hpp"
#include "harness.hpp"
#include "tribo/threads.hpp"

namespace tribo::bench {
namespace {

void measure_vibration(Report& report, int repeats) {
    const milling::Cutter cutter{.diameter_mm = 10, .flutes = 4, .helix_deg = 0};
    const milling::CuttingCoefficients aluminium{600, 200, 0, 0, 0, 0};
    const std::vector<dynamics::Mode> modes{{{1, 0, 0}, 922, 0.011, 13'400},
                                            {{1, 0, 0}, 1400, 0.011, 50'000},
                                            {{0, 1, 0}, 950, 0.011, 13'400},
                                            {{0, 1, 0}, 1500, 0.011, 50'000}};
    constexpr double kRateHz = 48'000, kDepthMm = 0.3, kFeedMm = 0.1, kRpm = 9000;
    constexpr int kTeeth = 1600, kPerTooth = 80;
    const milling::EngagementBand slot{0, kDepthMm, 0, math::kPi};
    const double ns = median_of(5 * repeats, [&] {
        dynamics::Vibration vibration(modes, cutter, aluminium, kRateHz);
        vibration.engage({&slot, 1}, {.across_mm = kFeedMm}, kRpm);
        const double start = thread_s();
        for (int n = 0; n < kTeeth * kPerTooth; ++n) keep(vibration.step());
        return 1e9 * (thread_s() - start) / (kTeeth * kPerTooth);
    });
    const double by_angle_ns = median_of(5 * repeats, [&] {
        const double start = thread_s();
        keep(dynamics::test::swings_by_angle(modes, cutter, aluminium, kDepthMm, kFeedMm, kRpm, kTeeth,
                                             kPerTooth));
        return 1e9 * (thread_s() - start) / (kTeeth * kPerTooth);
    });
    report.add({"sample of a vibration, 4 teeth, helix 0, 2 axes x 2 modes", ns, "ns", 20, Better::lower,
                "the surface kept by angle", by_angle_ns});
}

}  // namespace

void measure_stability(Report& report, int repeats) {
    report.section("Stability");
    const milling::Cutter cutter{.diameter_mm = 10, .flutes = 2, .helix_deg = 0};
    const milling::CuttingCoefficients aluminium{600, 200, 0, 0, 0, 0};
    const milling::EngagementBand slot{0, 0.3, 0, math::kPi};
    const dynamics::Mode first{{1, 0, 0}, 922, 0.011, 1340.05}, second{{1, 0, 0}, 1400, 0.011, 5000};
    const auto point = [&](const char* name, const std::vector<dynamics::Mode>& modes, double goal_us) {
        constexpr int kCalls = 200;
        const double us = median_of(10 * repeats, [&] {
            const double start = thread_s();
            for (int n = 0; n < kCalls; ++n) {
                const dynamics::CutFeedback cut(cutter, aluminium, {&slot, 1}, 10'000);
                keep(dynamics::stability(modes, cut));
            }
            return 1e6 * (thread_s() - start) / kCalls;
        });
        const double matrix_us = median_of(3 * repeats, [&] {
            const double start = thread_s();
            const dynamics::CutFeedback cut(cutter, aluminium, {&slot, 1}, 10'000);
            // As many points as seven digits need.
            keep(dynamics::test::multiplier_by_chebyshev(modes, cut, 14));
            return 1e6 * (thread_s() - start);
        });
        report.add({name, us, "us", goal_us, Better::lower, "all eigenvalues of one matrix", matrix_us});
    };
    point("multiplier of a slot, 10,000 rpm, one mode", {first}, 20);
    point("multiplier of a slot, 10,000 rpm, two modes", {first, second}, 80);

    const auto at = [&](double rpm, double depth_mm) {
        const milling::EngagementBand band{0, depth_mm, 0, math::kPi};
        return dynamics::stability({&first, 1}, dynamics::CutFeedback(cutter, aluminium, {&band, 1}, rpm));
    };
    const ParallelFor parallel = parallel_for_over(available_threads());
    const double chart_s = median_of(repeats, [&] {
        const double start = wall_s();
        keep(dynamics::stability_chart({5000, 19'925, 75, 5, 0.05}, at, parallel));
        return wall_s() - start;
    });
    report.add({"chart of 200 x 100 points with limits, one mode, " + std::to_string(available_threads()) +
                    " threads",
                chart_s, "s", 0.5});
    measure_vibration(report, repeats);
}

}  // namespace tribo::bench
