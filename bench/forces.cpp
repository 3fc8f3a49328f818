// SPDX-License-Identifier: MIT
// The closed forms: one piece of flute, and one row of spectrum and peaks.
#include <numbers>
#include <random>

#include "cuts.hpp"
#include "harness.hpp"
#include "milling/force/edge_force.hpp"
#include "milling/force/force.hpp"

namespace tribo::bench {

void measure_forces(Report& report, int repeats) {
    report.section("Closed forms");
    std::mt19937 random(1);
    std::uniform_real_distribution<double> share(0, 1);

    struct Segment {
        double low, high, height;
    };
    std::vector<Segment> segments(1024);
    for (Segment& s : segments) {
        s.low = share(random) * std::numbers::pi;
        s.height = 5 * share(random);
        s.high = s.low + s.height * 0.0962;  // 30 degrees of helix on D12
    }
    report.add({"force of a flute segment",
                median_of(20 * repeats,
                          [&] {
                              contact::ToolForce sum;
                              const double start = wall_s();
                              for (const Segment& s : segments) {
                                  const auto f = milling::flute_segment_force(kAluminium, 6, 0.05, s.low,
                                                                              s.high, s.height);
                                  sum.force_n += f.force_n;
                                  sum.torque_nmm += f.torque_nmm;
                              }
                              const double seconds = wall_s() - start;
                              keep(sum);
                              return 1e9 * seconds / static_cast<double>(segments.size());
                          }),
                "ns"});

    std::vector<milling::Engagement> engagements(32);
    for (milling::Engagement& e : engagements) {
        const double depth = 1 + 4 * share(random), exit = 0.5 + 2.5 * share(random);
        e.bands = {{0, 0.5 * depth, 0, exit}, {0.5 * depth, depth, 0.1, exit}};
    }
    milling::ForceModel model(end_mill(milling::CutterKind::flat, 12, 4, 30), kAluminium);
    contact::ForceSpectrum spectrum;
    const auto row = [&] {
        const double start = wall_s();
        for (const milling::Engagement& e : engagements) {
            model.engage(e, {0.05, 0});
            model.spectrum(16, spectrum);
            keep(spectrum);
            keep(model.peaks());
        }
        return 1e6 * (wall_s() - start) / static_cast<double>(engagements.size());
    };
    report.add(
        {"row of spectrum and peaks, D12 flat, 4 flutes, 2 bands", median_of(20 * repeats, row), "us"});
}

}  // namespace tribo::bench
