// SPDX-License-Identifier: MIT
// Bands of the forces of a run: against the factors themselves, and against 100,000 independent draws.
#include "session/uncertain/force_bands.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

#include "milling/force/force.hpp"
#include "session/block_setup.hpp"
#include "session/kept_rows.hpp"

namespace tribo::session {
namespace {

const ParallelFor kOneByOne = [](std::size_t count, const std::function<void(std::size_t)>& body) {
    for (std::size_t n = 0; n < count; ++n) body(n);
};

// A shoulder, and a slot beyond it: thick chips and thin ones.
MillSetup shoulder_and_slot() {
    MillSetup setup =
        block_setup({{0, 0, -8}, {40, 40, 0}}, {.diameter_mm = 8, .flutes = 3, .length_mm = 20}, 2);
    add_cut(setup, straight_cut({-5, -3, -2}, {45, -3, -2}, 900));
    add_cut(setup, straight_cut({45, 20, -1}, {-5, 20, -1}, 300));
    setup.force_low_factor = 0.6;
    setup.force_high_factor = 2.5;
    return setup;
}

struct BandedRun {
    ForceBands::Totals bands;
    std::vector<sweep::Band> of_rows;
    std::vector<KeptRow> rows;
    MillTotals totals;
};
BandedRun run(MillSetup setup, std::size_t count) {
    BandedRun result;
    MillSession session(std::move(setup), kOneByOne);
    ForceBands bands(session.setup(), count, kOneByOne);
    MillSinks sinks;
    sinks.row = [&](const milling::CutRow& row, const milling::RowForce& force) {
        result.of_rows.push_back(bands.add(row, force.peaks));
        result.rows.push_back({row, force});
    };
    session.run(sinks);
    result.bands = bands.totals();
    result.totals = session.totals();
    return result;
}

void expect_band(const sweep::Band& band, double value, double low, double high, double off) {
    EXPECT_NEAR(band.low / (value * low), 1, off);
    EXPECT_NEAR(band.high / (value * high), 1, off);
    EXPECT_NEAR(band.median / (value * std::sqrt(low * high)), 1, off);
}

TEST(ForceBands, of_coefficients_alone_are_their_factors) {
    const BandedRun r = run(shoulder_and_slot(), 1000);
    ASSERT_FALSE(r.rows.empty());
    // 1,000 quantiles are 0.1 % of the cases apart.
    constexpr double off = 0.01;
    expect_band(r.bands.mean_force_n, r.totals.mean_force_n, 0.6, 2.5, off);
    expect_band(r.bands.peak_force_n, r.totals.peak_force_n, 0.6, 2.5, off);
    expect_band(r.bands.peak_torque_nmm, r.totals.peak_torque_nmm, 0.6, 2.5, off);
    expect_band(r.bands.peak_power_w, r.totals.peak_power_w, 0.6, 2.5, off);
    for (std::size_t n = 0; n < r.rows.size(); ++n)
        expect_band(r.of_rows[n], r.rows[n].force.peaks.peak_force_n, 0.6, 2.5, off);
}

TEST(ForceBands, are_no_wider_than_their_value_without_a_spread) {
    MillSetup setup = shoulder_and_slot();
    setup.force_low_factor = setup.force_high_factor = 1;
    EXPECT_FALSE(has_spread(setup));
    const BandedRun r = run(std::move(setup), 20);
    EXPECT_DOUBLE_EQ(r.bands.peak_force_n.low, r.totals.peak_force_n);
    EXPECT_DOUBLE_EQ(r.bands.peak_force_n.high, r.totals.peak_force_n);
    EXPECT_DOUBLE_EQ(r.bands.mean_force_n.median, r.totals.mean_force_n);
}

TEST(ForceBands, know_what_has_a_spread) {
    MillSetup setup = shoulder_and_slot();
    EXPECT_TRUE(has_spread(setup));
    setup.force_low_factor = setup.force_high_factor = 1;
    setup.cutters[0].runout_spread = 0.5;
    EXPECT_FALSE(has_spread(setup)) << "no run-out, whatever its spread";
    setup.cutters[0].runout_mm = 0.01;
    EXPECT_TRUE(has_spread(setup));
    setup.cutters[0].runout_spread = 0;
    setup.modes_of_cutter = {{{{1, 0, 0}, 900, 0.01, 1000}}};
    EXPECT_FALSE(has_spread(setup));
    setup.modes_of_cutter[0][0].spread.damping = 0.2;
    EXPECT_TRUE(has_spread(setup));
}

void expect_bands_of_draws(double low_factor, double high_factor) {
    SCOPED_TRACE(high_factor);
    MillSetup setup = shoulder_and_slot();
    setup.force_low_factor = low_factor;
    setup.force_high_factor = high_factor;
    setup.cutters[0].runout_mm = 0.03;
    setup.cutters[0].runout_spread = 1;
    const milling::Cutter cutter = setup.cutters[0];
    const milling::CuttingCoefficients coefficients = setup.coefficients;
    MillSession session(std::move(setup), kOneByOne);
    std::vector<KeptRow> all;
    session.run(keep_rows(all));
    // One in the middle of the shoulder, one of the slot.
    const std::vector<KeptRow> rows{all[all.size() / 4], all[3 * all.size() / 4]};
    ForceBands bands(session.setup(), 4000, kOneByOne);

    // The model is asked at many run-outs, and the draws are put between them.
    const double step_mm = 0.0005;
    std::vector<std::vector<double>> peak_n(rows.size());
    for (std::size_t n = 0; n < rows.size(); ++n) {
        for (int k = 0; k <= 800; ++k) {
            milling::Cutter off = cutter;
            off.runout_mm = k * step_mm;
            milling::ForceModel model(off, coefficients);
            model.engage(rows[n].row.engagement, rows[n].row.feed);
            peak_n[n].push_back(model.peaks().peak_force_n);
        }
    }
    std::mt19937_64 random(7);
    std::normal_distribution<double> normal;
    const double nine_of_ten = 1.6448536269514722;
    const double middle = 0.5 * (std::log(low_factor) + std::log(high_factor)),
                 force_sigma = 0.5 * (std::log(high_factor) - std::log(low_factor)) / nine_of_ten,
                 runout_sigma = std::log(2.0) / nine_of_ten;
    std::vector<std::vector<double>> draws(rows.size());
    for (int draw = 0; draw < 100'000; ++draw) {
        const double factor = std::exp(middle + force_sigma * normal(random));
        const double at = std::min(799.0, 0.03 * std::exp(runout_sigma * normal(random)) / step_mm);
        const auto k = static_cast<std::size_t>(at);
        const double share = at - static_cast<double>(k);
        for (std::size_t n = 0; n < rows.size(); ++n)
            draws[n].push_back(factor * ((1 - share) * peak_n[n][k] + share * peak_n[n][k + 1]));
    }
    for (std::size_t n = 0; n < rows.size(); ++n) {
        std::ranges::sort(draws[n]);
        const sweep::Band band = bands.add(rows[n].row, rows[n].force.peaks);
        EXPECT_NEAR(band.low / draws[n][5'000], 1, 0.02) << n;
        EXPECT_NEAR(band.median / draws[n][50'000], 1, 0.02) << n;
        EXPECT_NEAR(band.high / draws[n][95'000], 1, 0.02) << n;
        EXPECT_GT(band.high / band.low, 1.1) << n;
    }
}

TEST(ForceBands, of_coefficients_and_runout_are_those_of_100000_independent_draws) {
    expect_bands_of_draws(1, 1);
    expect_bands_of_draws(0.6, 2.5);
}

TEST(ForceBands, have_the_force_of_each_case_in_every_row) {
    MillSetup setup = shoulder_and_slot();
    setup.cutters[0].runout_mm = 0.02;
    setup.cutters[0].runout_spread = 0.5;
    setup.coefficients.kte = 0;
    MillSession session(std::move(setup), kOneByOne);
    ForceCases cases(session.setup(), 25, kOneByOne);
    std::vector<double> factor;
    std::vector<KeptRow> rows;
    session.run(keep_rows(rows));
    for (const KeptRow& kept : rows) {
        const std::vector<milling::ForcePeaks>& peaks = cases.peaks(kept.row, kept.force.peaks);
        ASSERT_EQ(peaks.size(), 25u);
        for (const milling::ForcePeaks& p : peaks) {
            // Whatever the run-out, the teeth together remove the same chip: without edge forces the mean
            // torque tells the factor of the case.
            factor.push_back(p.mean_torque_nmm / kept.force.peaks.mean_torque_nmm);
        }
    }
    for (std::size_t n = 25; n < factor.size(); ++n) EXPECT_NEAR(factor[n] / factor[n - 25], 1, 0.01);
}

}  // namespace
}  // namespace tribo::session
