// SPDX-License-Identifier: MIT
#include "io/hrir_file.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <numbers>
#include <rapidcheck/gtest.h>

namespace tribo::io {
namespace {

using Complex = std::complex<double>;
constexpr double kPi = std::numbers::pi;
constexpr double kRate = 48000;

const FileResult<sound::HrirSet>& shipped() {
    static const FileResult<sound::HrirSet> set = builtin_hrirs();
    return set;
}

const sound::Head& head() {
    static const auto made = sound::Head::measured(*shipped(), kRate);
    return **made;
}

// What both ears get of a tone, from the responses as they are measured and from the head made of them.
using Both = std::array<Complex, 2>;
Both measured(std::size_t direction, double hz) {
    const sound::HrirSet& set = *shipped();
    Both out;
    const auto taps = static_cast<std::size_t>(set.taps);
    for (std::size_t ear = 0; ear < 2; ++ear) {
        const Complex turn = std::polar(1.0, -2 * kPi * hz / set.sample_rate_hz);
        Complex phase = 1;
        for (std::size_t k = 0; k < taps; ++k) {
            out[ear] += static_cast<double>(set.responses[(2 * direction + ear) * taps + k]) * phase;
            phase *= turn;
        }
    }
    return out;
}
Both made(const sound::EarResponses& heard, double hz) {
    Both out;
    for (std::size_t ear = 0; ear < 2; ++ear) {
        for (std::size_t k = 0; k < sound::kHeadTaps; ++k) {
            out[ear] += static_cast<double>(heard.taps[ear][k]) *
                        std::polar(1.0, -2 * kPi * hz / kRate * static_cast<double>(k));
        }
        out[ear] *= std::polar(1.0, -2 * kPi * hz * heard.delay_s[ear]);
    }
    return out;
}

// The delay of the right ear behind the left: the peak of the cross-correlation from 300 to 1500 Hz.
template <class At>
double arrival_offset_s(At at) {
    std::vector<std::pair<double, Complex>> cross;
    for (double hz = 300; hz <= 1500; hz += 25) {
        const Both b = at(hz);
        cross.emplace_back(2 * kPi * hz, b[0] * std::conj(b[1]));
    }
    const auto alike = [&](double t) {
        double sum = 0;
        for (const auto& [w, c] : cross) sum += (c * std::polar(1.0, -w * t)).real();
        return sum;
    };
    double best = 0;
    for (double t = -1e-3; t < 1e-3; t += 5e-6) best = alike(t) > alike(best) ? t : best;
    for (double step = 2.5e-6; step > 1e-8; step /= 2) {
        for (const double t : {best - step, best + step}) best = alike(t) > alike(best) ? t : best;
    }
    return best;
}

double decibel(double power) {
    return 10 * std::log10(power);
}

// Whether no interpolation comes between a measurement and what is heard.
bool on_grid(Vec3 direction) {
    for (int row = 0; row < sound::Head::kRows; ++row) {
        for (int column = 0; column < sound::Head::kColumns; ++column) {
            if (distance(sound::Head::grid_direction(row, column), direction) < 1e-4) return true;
        }
    }
    return false;
}

class BuiltinHrirs : public testing::Test {
  protected:
    void SetUp() override {
        if (!shipped()) GTEST_SKIP() << shipped().error().text();
    }
};

TEST_F(BuiltinHrirs, are_the_set_that_the_notes_describe) {
    EXPECT_EQ(shipped()->directions.size(), 710u);
    EXPECT_EQ(shipped()->taps, 512);
    EXPECT_EQ(shipped()->sample_rate_hz, 44100);
    EXPECT_TRUE(std::ranges::all_of(shipped()->extra_delays_s, [](double d) { return d == 0; }));
    // A source at the left is louder at the left ear and earlier there.
    sound::EarResponses heard;
    head().hear({-5, 0, 0}, heard);
    const Both left = made(heard, 4000);
    EXPECT_GT(decibel(std::norm(left[0]) / std::norm(left[1])), 6);
    EXPECT_GT(heard.delay_s[1] - heard.delay_s[0], 400e-6);
}

TEST_F(BuiltinHrirs, keep_arrival_offset_and_level_in_128_taps) {
    // Levels are set so that the front has the mean level 1.
    const auto broadband = [](auto at) {
        std::array<double, 2> sum{0, 0};
        for (double hz = 200; hz < 18000; hz += 50) {
            const Both b = at(hz);
            for (std::size_t ear = 0; ear < 2; ++ear) sum[ear] += std::norm(b[ear]);
        }
        return sum;
    };
    std::size_t front = 0;
    for (std::size_t n = 0; n < shipped()->directions.size(); ++n) {
        if (shipped()->directions[n].y > shipped()->directions[front].y) front = n;
    }
    sound::EarResponses heard;
    head().hear(5 * shipped()->directions[front], heard);
    const auto front_made = broadband([&](double hz) { return made(heard, hz); });
    const auto front_measured = broadband([&](double hz) { return measured(front, hz); });
    const double gain = std::sqrt((front_made[0] + front_made[1]) / (front_measured[0] + front_measured[1]));
    std::vector<double> offsets, offsets_on_grid, levels, at_1_khz, at_1_khz_on_grid;
    for (std::size_t n = 0; n < shipped()->directions.size(); n += 7) {
        const Vec3 direction = shipped()->directions[n];
        head().hear(5 * direction, heard);
        offsets.push_back(1e6 * std::abs(arrival_offset_s([&](double hz) { return made(heard, hz); }) -
                                         arrival_offset_s([&](double hz) { return measured(n, hz); })));
        if (on_grid(direction)) offsets_on_grid.push_back(offsets.back());
        const auto a = broadband([&](double hz) { return made(heard, hz); });
        const auto b = broadband([&](double hz) { return measured(n, hz); });
        for (std::size_t ear = 0; ear < 2; ++ear) {
            levels.push_back(std::abs(decibel(a[ear] / b[ear] / (gain * gain))));
            at_1_khz.push_back(std::abs(
                decibel(std::norm(made(heard, 1000)[ear]) / std::norm(gain * measured(n, 1000)[ear]))));
            if (on_grid(direction)) at_1_khz_on_grid.push_back(at_1_khz.back());
        }
    }
    for (auto* v : {&offsets, &offsets_on_grid, &levels, &at_1_khz, &at_1_khz_on_grid}) {
        std::ranges::sort(*v);
    }
    ASSERT_GT(offsets_on_grid.size(), 5u);
    EXPECT_LT(at_1_khz_on_grid.back(), 0.2);
    // Elsewhere the grid's own interpolation is in it.
    EXPECT_LT(at_1_khz[at_1_khz.size() * 9 / 10], 0.2);
    EXPECT_LT(at_1_khz.back(), 0.5);
    EXPECT_LT(levels.back(), 0.3);
    EXPECT_LT(offsets[offsets.size() * 9 / 10], 10);
    EXPECT_LT(offsets.back(), 25);
}

TEST(PackedHrirs, come_back_as_they_were) {
    sound::HrirSet set;
    set.sample_rate_hz = 44100;
    set.taps = 8;
    for (const Vec3 d : {Vec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}}) {
        set.directions.push_back(d);
        for (int k = 0; k < 16; ++k) set.responses.push_back(0.1f * static_cast<float>(k));
        set.extra_delays_s.insert(set.extra_delays_s.end(), {0, 1e-3});
    }
    const std::string bytes = packed_hrirs(set);
    const auto back = unpacked_hrirs(bytes);
    ASSERT_TRUE(back);
    EXPECT_EQ(back->responses, set.responses);
    EXPECT_EQ(back->directions, set.directions);
    EXPECT_EQ(back->extra_delays_s, set.extra_delays_s);
    // Every way of cutting them off is refused.
    for (std::size_t n = 0; n < bytes.size(); ++n) EXPECT_FALSE(unpacked_hrirs(bytes.substr(0, n))) << n;
    EXPECT_FALSE(unpacked_hrirs(bytes + "x"));
}

RC_GTEST_PROP(PackedHrirs, survive_whatever_a_child_writes, ()) {
    std::string bytes = "TRIBO-HRIR-1 ok\n" + *rc::gen::arbitrary<std::string>();
    RC_ASSERT(!unpacked_hrirs(bytes));
    bytes = "TRIBO-HRIR-1 no\n" + *rc::gen::arbitrary<std::string>();
    RC_ASSERT(!unpacked_hrirs(bytes));
}

}  // namespace
}  // namespace tribo::io
