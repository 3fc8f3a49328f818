// SPDX-License-Identifier: MIT
// base/hash.hpp against published FNV-1a values; the moments and correlations of base/noise_hash.hpp.
#include "base/hash.hpp"

#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "base/noise_hash.hpp"

namespace tribo {
namespace {

template <class... Values>
std::uint64_t hash_of(const Values&... values) {
    Hash hash;
    (hash.add(values), ...);
    return hash.value();
}

TEST(Hash, matches_published_values_of_fnv_1a) {
    EXPECT_EQ(Hash{}.value(), 0xcbf29ce484222325u);
    // The characters of "foobar" as the eight bytes of an integer would be; Noll's test vector is "foobar"
    // alone, which the string's length of eight more bytes continues.
    Hash hash;
    hash.add(std::string_view("foobar"));
    std::uint64_t expected = 0x85944171f73967e8;  // FNV-1a of "foobar" (Noll's test suite)
    for (int i = 0; i < 8; ++i) expected = (expected ^ (i == 0 ? 6u : 0u)) * 0x100000001b3u;
    EXPECT_EQ(hash.value(), expected);
}

TEST(Hash, tells_apart_what_differs_in_bits_order_or_grouping) {
    EXPECT_NE(hash_of(0.0), hash_of(-0.0));
    EXPECT_NE(hash_of(1.0, 2.0), hash_of(2.0, 1.0));
    EXPECT_NE(hash_of(std::string("ab"), std::string("c")), hash_of(std::string("a"), std::string("bc")));
    EXPECT_NE(hash_of(std::vector<int>{1}, std::vector<int>{}),
              hash_of(std::vector<int>{}, std::vector<int>{1}));
    EXPECT_NE(hash_of(1.0f), hash_of(1.0));
}

TEST(Hash, does_not_depend_on_the_width_of_an_integer_or_the_kind_of_nan) {
    EXPECT_EQ(hash_of(std::int32_t{-5}), hash_of(std::int64_t{-5}));
    EXPECT_EQ(hash_of(std::uint32_t{7}), hash_of(std::uint64_t{7}));
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(hash_of(nan), hash_of(-nan));
}

constexpr std::uint64_t kSamples = 1'000'000;

TEST(CounterNoise, can_be_sought_and_repeats_itself) {
    const CounterNoise noise(42), again(42), other(43);
    EXPECT_EQ(noise.bits(1'000'000'007), again.bits(1'000'000'007));
    std::set<std::uint64_t> seen;
    for (std::uint64_t i = 0; i < 100'000; ++i) {
        seen.insert(noise.bits(i));
        seen.insert(other.bits(i));
    }
    EXPECT_EQ(seen.size(), 200'000u);
}

TEST(CounterNoise, uniform_samples_have_the_moments_and_the_even_spread_of_the_unit_interval) {
    const CounterNoise noise(7);
    double sum = 0, squares = 0;
    std::vector<int> bins(100);
    for (std::uint64_t i = 0; i < kSamples; ++i) {
        const double u = noise.uniform(i);
        ASSERT_GE(u, 0);
        ASSERT_LT(u, 1);
        sum += u;
        squares += u * u;
        ++bins[static_cast<std::size_t>(100 * u)];
    }
    // Five standard deviations of each estimate.
    EXPECT_NEAR(sum / kSamples, 0.5, 5 * std::sqrt(1.0 / 12 / kSamples));
    EXPECT_NEAR(squares / kSamples, 1.0 / 3, 5 * std::sqrt(4.0 / 45 / kSamples));
    double chi_squared = 0;
    for (const int count : bins) chi_squared += (count - 1e4) * (count - 1e4) / 1e4;
    EXPECT_NEAR(chi_squared, 99, 5 * std::sqrt(2 * 99.0));
}

TEST(CounterNoise, gaussian_samples_have_mean_0_variance_1_and_the_kurtosis_3) {
    const CounterNoise noise(7);
    double sums[5] = {};
    for (std::uint64_t i = 0; i < kSamples; ++i) {
        const double g = noise.gaussian(i);
        ASSERT_LT(std::abs(g), 4.07);
        for (int p = 1; p <= 4; ++p) sums[p] += std::pow(g, p);
    }
    EXPECT_NEAR(sums[1] / kSamples, 0, 5 / std::sqrt(kSamples));
    EXPECT_NEAR(sums[2] / kSamples, 1, 5 * std::sqrt(2.0 / kSamples));
    EXPECT_NEAR(sums[3] / kSamples, 0, 5 * std::sqrt(15.0 / kSamples));
    EXPECT_NEAR(sums[4] / kSamples, 3, 5 * std::sqrt(96.0 / kSamples));
}

TEST(CounterNoise, no_sample_is_correlated_with_a_later_one_or_with_another_stream) {
    const CounterNoise noise(7), other(8);
    for (const std::uint64_t lag : {1u, 2u, 3u, 4u, 5u, 8u, 16u, 64u, 128u, 1024u, 48'000u}) {
        double sum = 0, across = 0;
        for (std::uint64_t i = 0; i < kSamples / 4; ++i) {
            sum += noise.gaussian(i) * noise.gaussian(i + lag);
            across += noise.gaussian(i) * other.gaussian(i + lag);
        }
        EXPECT_LT(std::abs(sum), 5 * std::sqrt(kSamples / 4)) << lag;
        EXPECT_LT(std::abs(across), 5 * std::sqrt(kSamples / 4)) << lag;
    }
}

}  // namespace
}  // namespace tribo
