// SPDX-License-Identifier: MIT
// Cutters as job files describe them: uneven pitch, run-out, several tools, holder; and engagement that the
// job prescribes. Forces are held against quadrature of their definition.
#include <cmath>
#include <complex>
#include <gtest/gtest.h>

#include "app/run/job_run.hpp"
#include "milling/force_reference.hpp"

namespace tribo::test {
namespace {

constexpr const char* kBlank = "[stock]\nbox_mm = [[0, 0, -10], [40, 30, 0]]\n";
constexpr const char* kOwnMaterial =
    "[material]\nktc_n_per_mm2 = 800\nkrc_n_per_mm2 = 200\nkac_n_per_mm2 = 150\n";
constexpr const char* kEdges = "kte_n_per_mm = 20\nkre_n_per_mm = 25\nkae_n_per_mm = 3\n";
constexpr const char* kNoEdges = "kte_n_per_mm = 0\nkre_n_per_mm = 0\nkae_n_per_mm = 0\n";
constexpr const char* kPath = "[path]\ngcode = \"p.nc\"\n";
// A slot 2 mm deep along +x.
constexpr const char* kSlot = "G21 G90 S6000 M3 F1200\nG0 X-8 Y15 Z-2\nG1 X48\nM30\n";

std::string slot_job(const std::string& cutter, const char* edges, const std::string& more = {}) {
    return std::string(kBlank) + "[cutter]\nkind = \"flat\"\ndiameter_mm = 10\nflutes = 2\nlength_mm = 20\n" +
           cutter + kOwnMaterial + edges + kPath + more;
}

// The row nearest the middle of the block, where all of the tool is in it.
const session::KeptRow& middle(const JobRun& run) {
    const session::KeptRow* best = &run.rows.at(0);
    for (const session::KeptRow& kept : run.rows) {
        if (std::abs(kept.row.pose.tip_mm.x - 20) < std::abs(best->row.pose.tip_mm.x - 20)) best = &kept;
    }
    return *best;
}

reference::Cut definition(const JobRun& run, const session::KeptRow& kept) {
    return {run.job.cutters.at(kept.row.cutter), run.coefficients, kept.row.engagement, kept.row.feed};
}

double size(const contact::ForceHarmonic& h) {
    return std::sqrt(std::norm(h.x) + std::norm(h.y));
}

TEST(JobCutter, of_equal_pitch_has_no_line_at_the_spindles_frequency) {
    const JobRun run = run_job({{"job.toml", slot_job("helix_deg = 30\n", kEdges)}, {"p.nc", kSlot}});
    ASSERT_EQ(run.error, "");
    EXPECT_EQ(middle(run).force.spectrum.order_step, 2);  // only multiples of the tooth passing
}

TEST(JobCutter, of_unequal_pitch_has_lines_at_the_spindles_frequency) {
    const JobRun run = run_job(
        {{"job.toml", slot_job("helix_deg = 30\npitch_deg = [150, 210]\n", kEdges)}, {"p.nc", kSlot}});
    ASSERT_EQ(run.error, "");
    const session::KeptRow& kept = middle(run);
    EXPECT_NEAR(kept.row.feed.across_mm, 0.1, 1e-6);
    ASSERT_EQ(kept.force.spectrum.order_step, 1);
    const reference::Cut cut = definition(run, kept);
    const double mean = size(kept.force.spectrum.harmonics.at(0));
    EXPECT_GT(size(kept.force.spectrum.harmonics.at(1)), 0.05 * mean);
    for (int order = 0; order <= 8; ++order) {
        const auto expected = reference::harmonic(cut, order, 8, 100, reference::worn_chip);
        EXPECT_LT(reference::difference(kept.force.spectrum.harmonics.at(static_cast<std::size_t>(order)),
                                        expected, 5),
                  1e-3 * mean)
            << order;
    }
}

// Pitch in closed form: without edge forces each tooth's force is that of a tooth of an even cutter times its
// share of the feed, turned by its angle, so that harmonic m is G_m sum_j share_j e^{i m angle_j}.
TEST(JobCutter, spindle_line_of_straight_unequal_teeth_is_the_sum_of_their_turned_shares) {
    const auto harmonic = [](const std::string& cutter, std::size_t order) {
        const JobRun run =
            run_job({{"job.toml", slot_job("helix_deg = 0\n" + cutter, kNoEdges)}, {"p.nc", kSlot}});
        EXPECT_EQ(run.error, "");
        const session::KeptRow& kept = middle(run);
        return kept.force.spectrum.harmonics.at(order /
                                                static_cast<std::size_t>(kept.force.spectrum.order_step));
    };
    const auto uneven = harmonic("pitch_deg = [150, 210]\n", 2);
    const auto even = harmonic("", 2);
    // Flute 1 runs 150 degrees ahead of flute 0, which takes what came forward in those.
    const std::complex<double> share =
        0.5 * (150.0 / 180 + 210.0 / 180 * std::polar(1.0, 2 * reference::rad(150)));
    const double left = std::abs(uneven.x - share * even.x) + std::abs(uneven.y - share * even.y);
    EXPECT_LT(left, 1e-6 * std::abs(even.y));
}

TEST(JobCutter, run_out_leaves_the_sum_of_the_chips_and_makes_the_teeth_differ) {
    const auto run = [](const std::string& runout, const char* edges) {
        JobRun done = run_job({{"job.toml", slot_job("helix_deg = 30\n" + runout, edges)}, {"p.nc", kSlot}});
        EXPECT_EQ(done.error, "");
        return done;
    };
    const JobRun true_run = run("", kNoEdges), off = run("runout_mm = 0.02\nrunout_deg = 30\n", kNoEdges);
    const session::KeptRow &a = middle(true_run), &b = middle(off);
    EXPECT_EQ(a.row.chip_mm3_per_s(), b.row.chip_mm3_per_s());
    EXPECT_EQ(true_run.totals.removed_mm3, off.totals.removed_mm3);
    // What one tooth misses the next one takes: without edge forces the mean cannot tell.
    EXPECT_LT(reference::difference(b.force.spectrum.harmonics[0], a.force.spectrum.harmonics[0], 5),
              1e-6 * size(a.force.spectrum.harmonics[0]));
    // The teeth differ: a line at the spindle's frequency and a higher peak.
    ASSERT_EQ(b.force.spectrum.order_step, 1);
    EXPECT_GT(size(b.force.spectrum.harmonics[1]), 0.1 * size(b.force.spectrum.harmonics[0]));
    EXPECT_GT(b.force.peaks.peak_xy_n, 1.1 * a.force.peaks.peak_xy_n);
    // With edges the definition, tooth by tooth in the history of the cut, decides.
    const JobRun edged = run("runout_mm = 0.02\nrunout_deg = 30\n", kEdges);
    const reference::Cut cut = definition(edged, middle(edged));
    for (int order = 0; order <= 6; ++order) {
        const auto& h = middle(edged).force.spectrum.harmonics.at(static_cast<std::size_t>(order));
        EXPECT_LT(reference::difference(h, reference::harmonic(cut, order, 16, 200, reference::worn_chip), 5),
                  0.01 * size(middle(edged).force.spectrum.harmonics[0]))
            << order;
    }
}

TEST(JobCutter, run_out_the_other_way_lets_the_other_tooth_take_more) {
    const auto first_line = [](const char* direction) {
        const JobRun run =
            run_job({{"job.toml", slot_job(std::string("helix_deg = 30\nrunout_mm = 0.01\nrunout_deg = ") +
                                               direction + "\n",
                                           kNoEdges)},
                     {"p.nc", kSlot}});
        EXPECT_EQ(run.error, "");
        return middle(run).force.spectrum.harmonics.at(1);
    };
    const auto there = first_line("30"), back = first_line("210");
    EXPECT_GT(size(there), 1);
    EXPECT_LT(std::abs(there.x + back.x) + std::abs(there.y + back.y), 1e-6 * size(there));
}

TEST(JobCutter, engagement_that_the_job_prescribes_is_what_the_forces_are_of) {
    const JobRun run =
        run_job({{"job.toml", slot_job("helix_deg = 30\n", kEdges,
                                       "[engagement]\nentry_deg = 60\nexit_deg = 135\naxial_depth_mm = 3\n")},
                 {"p.nc", kSlot}});
    ASSERT_EQ(run.error, "");
    // The slot is cut as before...
    EXPECT_NEAR(run.totals.removed_mm3, 10 * 2 * 40, 0.003 * 800);
    for (const session::KeptRow& kept : run.rows) {
        const milling::EngagementHull hull = milling::hull(kept.row.engagement);
        EXPECT_NEAR(hull.entry_rad, reference::rad(60), 1e-11);
        EXPECT_NEAR(hull.exit_rad, reference::rad(135), 1e-11);
        EXPECT_EQ(hull.axial_depth_mm, 3);
    }
    // ...and the force is that of the prescribed one.
    const session::KeptRow& kept = middle(run);
    reference::Cut cut{run.job.cutters[0], run.coefficients, {}, {0.1, 0}};
    cut.engagement.bands.push_back({0, 3, reference::rad(60), reference::rad(135)});
    const auto mean = reference::harmonic(cut, 0, 4, 40);
    EXPECT_NEAR(kept.force.peaks.mean_n.x, mean.x.real(), 1e-3);
    EXPECT_NEAR(kept.force.peaks.mean_n.y, mean.y.real(), 1e-3);
    EXPECT_NEAR(kept.force.peaks.mean_n.z, mean.z.real(), 1e-3);
    EXPECT_NEAR(1e-3 * kept.force.peaks.mean_torque_nmm, 1e-3 * mean.torque.real(), 1e-6);
}

constexpr const char* kTwoTools = R"(
[[cutter]]
number = 1
kind = "flat"
diameter_mm = 10
flutes = 2
length_mm = 20
[[cutter]]
number = 7
kind = "flat"
diameter_mm = 4
flutes = 3
length_mm = 20
)";

TEST(JobCutter, is_the_one_whose_number_the_program_calls) {
    const std::string job = std::string(kBlank) + kTwoTools + kOwnMaterial + kEdges + kPath;
    const JobRun run = run_job({{"job.toml", job},
                                {"p.nc",
                                 "G21 G90 F600\nT1 M6\nS6000 M3\nG0 X-8 Y8 Z-2\nG1 X48\nG0 Z5\nM5\n"
                                 "T7 M6\nS12000 M3\nG0 X-8 Y22\nZ-3\nG1 X48\nG0 Z5\nM30\n"}});
    ASSERT_EQ(run.error, "");
    EXPECT_NEAR(run.totals.removed_mm3, 40 * (10 * 2 + 4 * 3), 0.003 * 1280);
    EXPECT_TRUE(run.totals.collisions.empty());
    int rows_of[2] = {0, 0};
    for (const session::KeptRow& kept : run.rows) {
        ++rows_of[kept.row.cutter];
        EXPECT_EQ(kept.row.cutter, kept.row.pose.tip_mm.y < 15 ? 0u : 1u);
        EXPECT_EQ(kept.row.spindle_rpm, kept.row.cutter == 0 ? 6000 : 12000);
        // mm per minute over teeth per minute
        EXPECT_NEAR(kept.row.feed.across_mm, kept.row.cutter == 0 ? 0.05 : 600.0 / 36000, 1e-6);
    }
    EXPECT_GT(rows_of[0], 70);
    EXPECT_GT(rows_of[1], 70);
}

TEST(JobCutter, that_the_program_calls_in_vain_is_named_with_its_line) {
    const std::string job = std::string(kBlank) + kTwoTools + kOwnMaterial + kEdges + kPath;
    const JobRun run =
        run_job({{"job.toml", job}, {"p.nc", "G21 G90 F600 S6000 M3\nT2 M6\nG0 X-8 Y8 Z-2\nG1 X48\n"}});
    EXPECT_NE(run.error.find("p.nc:4"), std::string::npos) << run.error;
    EXPECT_NE(run.error.find("T2 is not described by the job"), std::string::npos) << run.error;
    EXPECT_NE(run.error.find("number = 2"), std::string::npos) << run.error;
    // One cutter without a number answers to any, with a warning.
    const JobRun any = run_job({{"job.toml", slot_job("", kEdges)},
                                {"p.nc", "G21 G90 F600 S6000 M3\nT2 M6\nG0 X-8 Y8 Z-2\nG1 X48\n"}});
    EXPECT_EQ(any.error, "");
    bool told = false;
    for (const Warning& w : any.warnings) told = told || w.message().find("T2") != std::string::npos;
    EXPECT_TRUE(told);
}

TEST(JobCutter, whose_holder_reaches_the_stock_collides_where_it_does) {
    const auto collisions = [](const char* length) {
        const std::string job =
            std::string(kBlank) +
            "[cutter]\nkind = \"flat\"\ndiameter_mm = 10\nflutes = 2\nlength_mm = " + length +
            "\n[holder]\ndiameter_mm = [30, 40]\nlength_mm = [25, 20]\n" + kOwnMaterial + kEdges + kPath;
        const JobRun run = run_job(
            {{"job.toml", job}, {"p.nc", "G21 G90 S6000 M3 F1200\nG0 X-30 Y15 Z-2\nG1 X20\nZ-6\nX70\n"}});
        EXPECT_EQ(run.error, "");
        return run.totals.collisions;
    };
    // 8 mm of cutting length keep the holder's lower end above the stock; 5 mm let it dive in on line 4.
    EXPECT_TRUE(collisions("8").empty());
    const auto found = collisions("5");
    ASSERT_FALSE(found.empty());
    EXPECT_EQ(found[0].kind, milling::CollisionKind::holder);
    EXPECT_EQ(found[0].line, 4);
    EXPECT_NEAR(found[0].tip_mm.x, 20, 1e-9);
    // 50 mm at 20 mm/s to there, and 4 mm down.
    EXPECT_GE(found[0].t_s, 2.5);
    EXPECT_LE(found[0].t_s, 2.7);
}

TEST(JobCutter, that_meets_a_fixture_says_which_line_took_it_there) {
    const std::string job = slot_job("", kEdges,
                                     "[[fixture]]\nbox_mm = [[42, 0, -10], [60, 30, 5]]\n"
                                     "[[fixture]]\nbox_mm = [[0, -20, -10], [40, -2, 5]]\n");
    const JobRun hits = run_job(
        {{"job.toml", job}, {"p.nc", "G21 G90 S6000 M3 F1200\nG0 X-8 Y15 Z-2\nG1 X30\nX45\nG0 Z20\n"}});
    ASSERT_EQ(hits.error, "");
    ASSERT_EQ(hits.totals.collisions.size(), 2u);  // in, and out again
    EXPECT_EQ(hits.totals.collisions[0].kind, milling::CollisionKind::tool_in_fixture);
    EXPECT_EQ(hits.totals.collisions[0].line, 4);
    EXPECT_EQ(hits.totals.collisions[1].line, 5);
    // The cutter's edge reaches x = 42 with the tip at 37.
    EXPECT_GT(hits.totals.collisions[0].tip_mm.x, 37);
    const JobRun clear = run_job(
        {{"job.toml", job}, {"p.nc", "G21 G90 S6000 M3 F1200\nG0 X-8 Y15 Z-2\nG1 X30\nX36.5\nG0 Z20\n"}});
    ASSERT_EQ(clear.error, "");
    EXPECT_TRUE(clear.totals.collisions.empty());
}

}  // namespace
}  // namespace tribo::test
