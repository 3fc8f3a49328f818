// SPDX-License-Identifier: MIT
#include "session/chatter/steady_cut.hpp"

#include <gtest/gtest.h>

#include "session/chatter/critical_row.hpp"
#include "session/chatter/row_stability.hpp"

namespace tribo::session {
namespace {

using milling::EngagementBand;

double area(const std::vector<EngagementBand>& bands) {
    double sum = 0;
    for (const EngagementBand& b : bands) sum += (b.z1_mm - b.z0_mm) * (b.exit_rad - b.entry_rad);
    return sum;
}

TEST(SteadyCut, at_another_depth_is_cut_off_or_goes_on_at_its_top) {
    SteadyCut cut;
    // A step: engaged twice in its lower half.
    cut.bands = {{1, 2, 0, 1}, {1, 2, 2, 3}, {2, 3, 0, 3}};
    EXPECT_EQ(cut.bands_at(0.5).size(), 2u);
    EXPECT_DOUBLE_EQ(cut.bands_at(0.5)[1].z1_mm, 1.5);
    EXPECT_DOUBLE_EQ(area(cut.bands_at(0.5)), 0.5 * 2);
    EXPECT_DOUBLE_EQ(area(cut.bands_at(1.5)), 1 * 2 + 0.5 * 3);
    EXPECT_DOUBLE_EQ(area(cut.bands_at(4)), 1 * 2 + 3 * 3);
    EXPECT_EQ(cut.entry_rad(), 0);
    EXPECT_EQ(cut.exit_rad(), 3);
}

TEST(FewerBands, join_the_most_alike_and_keep_the_area) {
    std::vector<EngagementBand> bands;
    for (int n = 0; n < 40; ++n) {
        const double z = 0.1 * n;
        bands.push_back({z, 0.1 * (n + 1), z < 2 ? 0.1 : 1.0, 2 + 0.01 * n});
    }
    const std::vector<EngagementBand> few = with_fewer_bands(bands, 6);
    ASSERT_EQ(few.size(), 6u);
    EXPECT_NEAR(area(few), area(bands), 1e-12);
    // The step stays a step.
    for (const EngagementBand& b : few) {
        EXPECT_TRUE(std::abs(b.entry_rad - 0.1) < 1e-12 || std::abs(b.entry_rad - 1) < 1e-12);
        EXPECT_TRUE(b.z1_mm < 2 + 1e-9 || b.z0_mm > 2 - 1e-9);
    }
    // Bands apart from each other stay.
    EXPECT_EQ(with_fewer_bands({{0, 1, 0, 1}, {2, 3, 0, 1}, {4, 5, 0, 1}}, 1).size(), 3u);
}

}  // namespace
}  // namespace tribo::session
