// SPDX-License-Identifier: MIT
#include "noise/model/ar_model.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <numbers>
#include <rapidcheck/gtest.h>

#include "noise/model/levinson.hpp"
#include "noise/voices.hpp"

namespace tribo::noise {
namespace {

using test::with_poles;

// Reflection coefficients of any order up to `most` and any size up to 0.95.
rc::Gen<std::vector<double>> any_reflection(int most) {
    return rc::gen::mapcat(rc::gen::inRange(0, most + 1), [](int order) {
        return rc::gen::container<std::vector<double>>(
            static_cast<std::size_t>(order),
            rc::gen::map(rc::gen::inRange(-950, 951), [](int k) { return 0.001 * k; }));
    });
}

RC_GTEST_PROP(ArModel, reflection_survives_the_way_to_a_predictor_and_back, ()) {
    std::vector<double> k = *any_reflection(12);  // beyond, the direct form itself loses the digits
    std::vector<double> a = predictor_of(k), back(k.size());
    reflection_of(a, back);
    for (std::size_t n = 0; n < k.size(); ++n) RC_ASSERT(std::abs(back[n] - k[n]) < 1e-6);
}

// Levinson and Durbin on the autocorrelation that a model has leads to the model.
RC_GTEST_PROP(ArModel, autocorrelation_determines_the_model, ()) {
    std::vector<double> k = *any_reflection(60);
    for (double& x : k) x *= 0.4;
    const std::vector<double> found = levinson(autocorrelation_of(k, static_cast<int>(k.size())));
    RC_ASSERT(found.size() == k.size());
    for (std::size_t n = 0; n < k.size(); ++n) RC_ASSERT(std::abs(found[n] - k[n]) < 1e-6);
}

// x[n] = e[n] + 0.9 x[n-1]: r_n = 0.9^n, density (1 - 0.81) / |1 - 0.9 e^-jw|^2.
TEST(ArModel, of_first_order_is_the_textbooks) {
    const ArModel model{8000, {-0.9}};
    EXPECT_EQ(predictor_of(model.reflection), std::vector<double>{-0.9});
    EXPECT_NEAR(innovation_power(model.reflection), 0.19, 1e-15);
    const std::vector<double> r = autocorrelation_of(model.reflection, 20);
    for (int n = 0; n <= 20; ++n) EXPECT_NEAR(r[static_cast<std::size_t>(n)], std::pow(0.9, n), 1e-14);
    EXPECT_NEAR(power_at(model, 0), 19, 1e-12);
    EXPECT_NEAR(power_at(model, 4000), 0.19 / 3.61, 1e-14);
    EXPECT_NEAR(power_at(model, 2000), 0.19 / 1.81, 1e-14);
}

RC_GTEST_PROP(ArModel, mean_of_the_power_density_is_1, ()) {
    std::vector<double> k = *any_reflection(8);
    for (double& x : k) x *= 0.3;
    const ArModel model{48000, k};
    double sum = 0;
    constexpr int kSteps = 4000;
    for (int n = 0; n < kSteps; ++n) sum += power_at(model, 24000 * (n + 0.5) / kSteps);
    RC_ASSERT(std::abs(sum / kSteps - 1) < 1e-3);
}

// A(z) +- z^-(p+1) A(1/z) on the unit circle, by the definition.
std::complex<double> line_polynomial(const std::vector<double>& a, double w, double sign) {
    std::complex<double> forward = 1, backward = 0;
    const auto p = static_cast<double>(a.size());
    for (std::size_t n = 0; n < a.size(); ++n) {
        forward += a[n] * std::polar(1.0, -w * static_cast<double>(n + 1));
        backward += a[n] * std::polar(1.0, -w * (p - static_cast<double>(n)));
    }
    backward += std::polar(1.0, -w * (p + 1));
    return forward + sign * backward;
}

RC_GTEST_PROP(ArModel, line_spectrum_is_where_sum_and_difference_polynomials_vanish, ()) {
    const std::vector<double> k = *any_reflection(40);
    const std::vector<double> a = predictor_of(k), w = line_spectrum_of(k);
    RC_ASSERT(w.size() == k.size());
    double scale = 1;
    for (const double x : a) scale += std::abs(x);
    for (std::size_t n = 0; n < w.size(); ++n) {
        RC_ASSERT(w[n] > (n > 0 ? w[n - 1] : 0) && w[n] < std::numbers::pi);
        RC_ASSERT(std::abs(line_polynomial(a, w[n], n % 2 == 0 ? 1 : -1)) < 1e-10 * scale);
    }
}

RC_GTEST_PROP(ArModel, line_spectrum_leads_back_to_the_predictor, ()) {
    std::vector<double> k = *any_reflection(24);
    for (double& x : k) x *= 0.6;
    const std::vector<double> a = predictor_of(k), w = line_spectrum_of(k);
    std::vector<double> back(a.size()), work(2 * (a.size() + 2));
    predictor_from_line_spectrum(w, back, work);
    double scale = 1;
    for (const double x : a) scale = std::max(scale, std::abs(x));
    for (std::size_t n = 0; n < a.size(); ++n) RC_ASSERT(std::abs(back[n] - a[n]) < 1e-6 * scale);
}

// Ascending angles stay ascending on the way between, and ascending angles are a stable filter.
TEST(ArModel, line_spectrum_leads_back_at_every_order_that_is_played) {
    for (const std::size_t order : {50U, 91U, 128U, 255U, 512U}) {
        std::vector<double> k(order), back(order), work(2 * (order + 2));
        for (std::size_t n = 0; n < order; ++n) {
            const auto m = static_cast<double>(n);
            k[n] = (n % 2 == 0 ? -0.8 : 0.6) / (1 + 0.3 * m) * std::cos(0.7 * m);
        }
        predictor_from_line_spectrum(line_spectrum_of(k), back, work);
        const std::vector<double> a = predictor_of(k);
        for (std::size_t n = 0; n < order; ++n) EXPECT_NEAR(back[n], a[n], 1e-7) << order;
    }
}

RC_GTEST_PROP(ArModel, between_two_line_spectra_every_filter_is_stable, ()) {
    const auto order = static_cast<std::size_t>(*rc::gen::inRange(1, 31));
    const auto some = [&] {
        return line_spectrum_of(*rc::gen::container<std::vector<double>>(
            order, rc::gen::map(rc::gen::inRange(-950, 951), [](int k) { return 0.001 * k; })));
    };
    const std::vector<double> a = some(), b = some();
    RC_ASSERT(a.size() == order && b.size() == order);
    for (const double t : {0.1, 0.25, 0.5, 0.8}) {
        std::vector<double> between(order), predictor(order), reflection(order), work(2 * (order + 2));
        for (std::size_t n = 0; n < order; ++n) between[n] = (1 - t) * a[n] + t * b[n];
        predictor_from_line_spectrum(between, predictor, work);
        reflection_of(predictor, reflection);
        for (const double k : reflection) RC_ASSERT(std::abs(k) < 1);
    }
}

TEST(ArModel, pairs_of_lines_as_close_as_rounding_allows_are_found) {
    // Poles at radius 1 - 1e-6: their two lines lie a millionth of a radian apart.
    const double r = 1 - 1e-6, angle = 0.3;
    std::vector<double> a{-2 * r * std::cos(angle), r * r}, k(2);
    reflection_of(a, k);
    const std::vector<double> w = line_spectrum_of(k);
    EXPECT_NEAR(w[0], angle, 1e-5);
    EXPECT_NEAR(w[1], angle, 1e-5);
    EXPECT_LT(w[0], w[1]);
}

// Two resonances and a slope, at 44.1 kHz.
ArModel resonant() {
    ArModel model = with_poles(44100, {{1800, 0.97}, {5200, 0.94}, {9000, 0.9}, {200, 0.8}});
    model.reflection.resize(50);  // poles to spare
    return model;
}

TEST(ArModel, at_another_rate_keeps_its_spectrum_in_hertz) {
    const ArModel model = resonant();
    for (const double rate : {48000.0, 96000.0, 32000.0, 8000.0}) {
        double power = 0;
        const ArModel moved = at_rate(model, rate, &power);
        EXPECT_EQ(moved.sample_rate_hz, rate);
        double sum = 0, inside = 0;
        int count = 0;
        // Power per hertz: both densities are relative to white noise over their own band.
        for (double hz = 200; hz < std::min(0.45 * rate, 20000.0); hz += 50, ++count) {
            const double error =
                10 * std::log10(power_at(moved, hz) * power / rate / (power_at(model, hz) / 44100));
            sum += error * error;
        }
        EXPECT_LT(std::sqrt(sum / count), 0.5) << rate;
        for (int n = 0; n < 4000; ++n)
            inside += power_at(model, std::min(rate, 44100.0) / 8000 * (n + 0.5)) / 4000;
        EXPECT_NEAR(power, inside * std::min(rate / 44100, 1.0), 2e-3) << rate;
    }
}

// As many poles as the spectrum has at its own rate draw neither it nor its edge in a wider band.
TEST(ArModel, at_any_rate_a_few_poles_keep_their_third_octaves) {
    const ArModel models[] = {with_poles(8000, {{800, 0.97}, {3000, 0.9}}),
                              with_poles(22050, {{2500, 0.95}, {6000, 0.9}}),
                              with_poles(44100, {{1500, 0.97}, {4000, 0.9}}),
                              {16000, {}},
                              resonant()};
    for (const ArModel& model : models) {
        for (const double rate : {8000.0, 16000.0, 44100.0, 48000.0, 96000.0, 192000.0}) {
            double power = 0;
            const ArModel moved = at_rate(model, rate, &power);
            const double top_hz = 0.45 * std::min(rate, model.sample_rate_hz);
            for (double low = 100; 1.26 * low < top_hz; low *= 1.26) {
                double was = 0, is = 0;
                for (int n = 0; n < 100; ++n) {
                    const double hz = low * (1 + 0.26 * (n + 0.5) / 100);
                    was += power_at(model, hz) / model.sample_rate_hz;
                    is += power * power_at(moved, hz) / rate;
                }
                EXPECT_NEAR(10 * std::log10(is / was), 0, 0.3)
                    << model.sample_rate_hz << ' ' << model.reflection.size() << ' ' << rate << ' ' << low;
            }
        }
    }
}

}  // namespace
}  // namespace tribo::noise
