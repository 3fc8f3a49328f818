// SPDX-License-Identifier: MIT
#include "noise/play/noise_kernels.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "noise/model/ar_model.hpp"

namespace tribo::noise {
namespace {

// A stable model whose reflection coefficients fall off, as those of sounds do.
std::vector<double> reflection_of_order(int order) {
    std::vector<double> k(static_cast<std::size_t>(order));
    for (std::size_t n = 0; n < k.size(); ++n) {
        const auto m = static_cast<double>(n);
        k[n] = (n % 2 == 0 ? -0.8 : 0.6) / (1 + 0.3 * m) * std::cos(0.7 * m);
    }
    return k;
}

struct Filter {
    std::vector<float> predictor, response;
    std::vector<double> exact;
    explicit Filter(int order) : response(31) {
        exact = predictor_of(reflection_of_order(order));
        predictor.assign(exact.begin(), exact.end());
        std::vector<double> h{1};
        for (std::size_t n = 1; n < 16; ++n) {
            double sum = 0;
            for (std::size_t k = 1; k <= n && k <= exact.size(); ++k) sum -= exact[k - 1] * h[n - k];
            h.push_back(sum);
        }
        for (std::size_t n = 0; n < 16; ++n) response[15 + n] = static_cast<float>(h[n]);
    }
};

TEST(NoiseKernels, white_noise_has_the_moments_of_a_gaussian_and_no_memory) {
    constexpr int kCount = 1 << 20;
    std::vector<float> x(kCount);
    noise_kernels().gaussian(12345, 0, x.data(), kCount);
    double m1 = 0, m2 = 0, m3 = 0, m4 = 0, lag1 = 0, lag8 = 0;
    float largest = 0;
    for (int n = 0; n < kCount; ++n) {
        const double v = x[static_cast<std::size_t>(n)];
        m1 += v / kCount;
        m2 += v * v / kCount;
        m3 += v * v * v / kCount;
        m4 += v * v * v * v / kCount;
        if (n >= 1) lag1 += v * x[static_cast<std::size_t>(n - 1)] / kCount;
        if (n >= 8) lag8 += v * x[static_cast<std::size_t>(n - 8)] / kCount;
        largest = std::max(largest, std::abs(x[static_cast<std::size_t>(n)]));
    }
    // Four standard errors of 2^20 independent samples.
    EXPECT_NEAR(m1, 0, 0.004);
    EXPECT_NEAR(m2, 1, 0.006);
    EXPECT_NEAR(m3, 0, 0.016);
    EXPECT_NEAR(m4, 3, 0.04);
    EXPECT_NEAR(lag1, 0, 0.004);
    EXPECT_NEAR(lag8, 0, 0.004);
    EXPECT_LT(largest, 4.1F);
}

TEST(NoiseKernels, white_noise_depends_on_key_and_number_alone) {
    std::vector<float> whole(256), part(64), other(256);
    noise_kernels().gaussian(7, 100, whole.data(), 256);
    noise_kernels().gaussian(7, 164, part.data(), 64);
    noise_kernels().gaussian(8, 100, other.data(), 256);
    EXPECT_TRUE(std::equal(part.begin(), part.end(), whole.begin() + 64));
    double product = 0;
    for (std::size_t n = 0; n < 256; ++n) product += whole[n] * other[n];
    EXPECT_LT(std::abs(product), 4 * 16);
}

TEST(NoiseKernels, all_pole_filter_follows_the_recursion_at_every_order) {
    constexpr int kCount = 4096;
    std::vector<float> x(kCount);
    noise_kernels().gaussian(3, 0, x.data(), kCount);
    for (int order = 0; order <= kLargestPlayedOrder; order = order < 20 ? order + 1 : order + 9) {
        const Filter filter(order);
        std::vector<float> y(static_cast<std::size_t>(order) + kCount + 16, 0.0F);
        noise_kernels().all_pole(filter.predictor.data(), order, filter.response.data(), 0.5F, x.data(),
                                 y.data() + order, kCount);
        std::vector<double> exact(kCount);
        double error = 0, energy = 0;
        for (int n = 0; n < kCount; ++n) {
            double v = 0.5 * x[static_cast<std::size_t>(n)];
            for (int k = 1; k <= std::min(order, n); ++k)
                v -= filter.exact[static_cast<std::size_t>(k - 1)] * exact[static_cast<std::size_t>(n - k)];
            exact[static_cast<std::size_t>(n)] = v;
            const double d = y[static_cast<std::size_t>(order + n)] - v;
            error += d * d;
            energy += v * v;
        }
        EXPECT_LT(error, 1e-10 * energy) << order;  // -100 dB
    }
}

TEST(NoiseKernels, both_builds_give_the_same_bits) {
    const NoiseKernels* v3 = noise_kernels_v3();
    if (v3 == nullptr) GTEST_SKIP() << "no x86-64-v3 here";
    const NoiseKernels* base = noise_kernels_sse2();
    std::vector<float> a(512), b(512);
    base->gaussian(99, 4294967200U, a.data(), 512);
    v3->gaussian(99, 4294967200U, b.data(), 512);
    EXPECT_EQ(a, b);
    for (const int order : {1, 2, 7, 50, 101}) {
        const Filter filter(order);
        const auto past = static_cast<std::size_t>(order);
        std::vector<float> ya(past + 528, 0.25F), yb(past + 528, 0.25F);
        base->all_pole(filter.predictor.data(), order, filter.response.data(), 0.3F, a.data(),
                       ya.data() + order, 512);
        v3->all_pole(filter.predictor.data(), order, filter.response.data(), 0.3F, a.data(),
                     yb.data() + order, 512);
        EXPECT_EQ(ya, yb) << order;
        base->mix(ya.data() + order, 0.1F, 0.9F, a.data(), 512);
        v3->mix(yb.data() + order, 0.1F, 0.9F, b.data(), 512);
        EXPECT_EQ(a, b);
    }
}

}  // namespace
}  // namespace tribo::noise
