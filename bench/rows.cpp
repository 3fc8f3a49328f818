// SPDX-License-Identifier: MIT
// A row as a session makes it: engagement measured in the stock, spectrum, peaks. The cut itself is not
// counted.
#include <cmath>

#include "cuts.hpp"
#include "harness.hpp"
#include "milling/engagement/engagement_probe.hpp"
#include "milling/force/force.hpp"
#include "milling/sweep/sweep.hpp"

namespace tribo::bench {
namespace {

struct RowCost {
    double engagement_us = 0, whole_us = 0;
};

// Medians over the rows of moves[first...], one each, that cut at all.
RowCost row_cost(const Box3& block_mm, const milling::Cutter& cutter, const std::vector<motion::Move>& moves,
                 std::size_t first) {
    auto stock = block(block_mm);
    milling::EngagementProbe probe(cutter);
    milling::ForceModel model(cutter, kAluminium);
    milling::Engagement engagement;
    contact::ForceSpectrum spectrum;
    std::vector<double> probing, whole;
    for (std::size_t n = 0; n < moves.size(); ++n) {
        const motion::Move& move = moves[n];
        if (n >= first) {
            const Vec3 way = normalized(move.end.tip_mm - move.start.tip_mm, {1, 0, 0});
            const milling::CutPose pose{
                lerp(move.start.tip_mm, move.end.tip_mm, 0.5),
                milling::tool_frame({0, 0, 1}, way, {1, 0, 0}),
                {.across_mm = std::sqrt(std::max(0.0, 1 - way.z * way.z)), .down_mm = -way.z}};
            const double start = wall_s();
            probe.measure(*stock, pose, engagement);
            const double probed = wall_s();
            model.engage(engagement, 0.05 * pose.travel);
            model.spectrum(16, spectrum);
            keep(model.peaks());
            const double end = wall_s();
            keep(spectrum);
            if (!engagement.empty()) {
                probing.push_back(1e6 * (probed - start));
                whole.push_back(1e6 * (end - start));
            }
        }
        stock->carve(milling::make_sweep(cutter, move));
    }
    return {median(probing), median(whole)};
}

void add(Report& report, const std::string& name, const RowCost& cost) {
    report.add({"engagement, " + name, cost.engagement_us, "us"});
    report.add({"engagement, spectrum and peaks, " + name, cost.whole_us, "us", 20});
}

}  // namespace

void measure_rows(Report& report) {
    report.section("A row of forces.csv, 0.1 mm grid");
    const Cuts cuts = half_immersion(0.5, 3);
    std::vector<motion::Move> moves;
    for (const auto& one : cuts.passes) moves.insert(moves.end(), one.begin(), one.end());
    add(report, "D12 flat half immersed, 5 mm deep",
        row_cost(cuts.block_mm, cuts.cutter, moves, cuts.passes[0].size()));
    const FinishingJob job;
    moves = moves_through(job.tips);
    moves.resize(4000);
    add(report, "finishing job", row_cost(job.block_mm, job.cutter, moves, 500));
}

}  // namespace tribo::bench
