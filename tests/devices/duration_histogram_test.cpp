// SPDX-License-Identifier: MIT
#include "devices/servo/duration_histogram.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <vector>

namespace tribo::devices {
namespace {

RC_GTEST_PROP(DurationHistogram, gives_quantiles_within_a_64th_of_sorting_them, ()) {
    DurationHistogram histogram;
    std::vector<std::uint64_t> all;
    const int count = 1 + *rc::gen::inRange(0, 300);
    for (int n = 0; n < count; ++n) {
        const int octave = *rc::gen::inRange(0, 38);
        const auto ns =
            (std::uint64_t{1} << octave) + static_cast<std::uint64_t>(*rc::gen::inRange(0, 1 << 20));
        all.push_back(ns);
        histogram.record(ns);
    }
    std::ranges::sort(all);
    RC_ASSERT(histogram.count() == all.size());
    RC_ASSERT(histogram.max_ns() == all.back());
    for (const double q : {0.5, 0.9, 0.99, 0.999, 1.0}) {
        const auto rank =
            static_cast<std::size_t>(std::max(1.0, std::ceil(q * static_cast<double>(all.size()))));
        const std::uint64_t exact = all[rank - 1], shown = histogram.quantile_ns(q);
        RC_ASSERT(shown >= exact);
        RC_ASSERT(shown <= exact + exact / 64 + 1);
    }
}

TEST(DurationHistogram, keeps_small_durations_exactly_and_huge_ones_at_all) {
    DurationHistogram histogram;
    EXPECT_EQ(histogram.quantile_ns(0.5), 0U);
    for (std::uint64_t ns = 0; ns < 60; ++ns) histogram.record(ns);
    EXPECT_EQ(histogram.quantile_ns(0.5), 29U);
    EXPECT_EQ(histogram.count_above(49), 10U);
    histogram.record(std::uint64_t{1} << 62);
    EXPECT_EQ(histogram.max_ns(), std::uint64_t{1} << 62);
    EXPECT_EQ(histogram.count(), 61U);
}

}  // namespace
}  // namespace tribo::devices
