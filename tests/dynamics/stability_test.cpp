// SPDX-License-Identifier: MIT
// Multipliers against published numbers, closed forms and a second computation.
#include "dynamics/stability.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

#include "base/math.hpp"
#include "dynamics/benchmark_slot.hpp"
#include "dynamics/chebyshev_collocation.hpp"
#include "dynamics/semi_discretisation.hpp"
#include "dynamics/vibration.hpp"

namespace tribo::dynamics {
namespace {

constexpr double kPi = math::kPi;

Stability cut(std::span<const Mode> modes, double rpm, double depth, double entry, double exit) {
    const milling::EngagementBand band{0, depth, entry, exit};
    return stability(modes, CutFeedback(kCutter, kAluminium, {&band, 1}, rpm));
}

Stability benchmark(double rpm, double depth, double entry = 0, double exit = kPi) {
    const Mode mode = benchmark_mode();
    return cut({&mode, 1}, rpm, depth, entry, exit);
}

TEST(Stability, of_the_benchmark_slot_is_known_to_seven_digits) {
    // Computed with a spectral method in another program, with two numbers of nodes.
    EXPECT_NEAR(benchmark(5000, 0.2).multiplier, 0.81974278, 1e-7);
    EXPECT_NEAR(benchmark(5000, 0.5).multiplier, 1.07397559, 1e-7);
    EXPECT_NEAR(benchmark(5000, 0.7).multiplier, 1.22155614, 1e-7);
    EXPECT_NEAR(benchmark(5000, 1.0).multiplier, 1.40647353, 1e-7);
    EXPECT_NEAR(benchmark(5000, 0.5).angle_rad, 2.060413, 1e-6);
    EXPECT_NEAR(benchmark(5000, 0.5).chatter_hz, 945.3, 0.1);
}

struct Known {
    double rpm, slot, half_down, tenth_down;
    const char* kinds;  // of the three: H quasi-periodic, F period doubling
};

TEST(Stability, has_the_known_critical_depths) {
    const double half = kPi / 2, tenth = kPi - std::acos(1 - 2 * 0.1);
    for (const Known& k :
         {Known{5000, 0.4086, 0.8472, 1.2963, "HHH"}, Known{6000, 0.3532, 1.1388, 1.7329, "HHH"},
          Known{7000, 1.1520, 2.5506, 2.9878, "HHF"}, Known{8000, 0.6764, 0.7979, 1.2204, "HHH"},
          Known{9000, 3.0090, 1.5648, 2.4411, "HHH"}, Known{10000, 0.3224, 2.1047, 2.5184, "HFF"},
          Known{12000, 2.1493, 0.6131, 0.9430, "FHH"}, Known{14000, 2.1400, 3.0905, 6.0260, "HFF"},
          Known{16000, 0.3185, 2.0724, 3.1158, "HFF"}, Known{18000, 0.6895, 1.6197, 0.8157, "HHF"},
          Known{20000, 1.4175, 0.7196, 1.2215, "FHH"}, Known{24000, 3.7425, 0.7757, 1.2226, "HHH"}}) {
        int n = 0;
        for (const auto& [depth, entry] :
             {std::pair{k.slot, 0.0}, {k.half_down, half}, {k.tenth_down, tenth}}) {
            const DepthLimit limit =
                depth_limit([&, from = entry](double mm) { return benchmark(k.rpm, mm, from); }, 20);
            ASSERT_TRUE(limit.depth_mm) << k.rpm;
            EXPECT_NEAR(*limit.depth_mm, depth, 1e-3 * depth) << k.rpm;
            EXPECT_EQ(limit.there.kind == ChatterKind::period_doubling, k.kinds[n] == 'F')
                << k.rpm << " " << n;
            ++n;
        }
    }
}

TEST(Stability, of_a_mode_in_every_direction_knows_no_up_and_down) {
    const std::array modes{benchmark_mode(), benchmark_mode({0, 1, 0})};
    for (const double rpm : {5000.0, 10'000.0}) {
        const double expected = rpm == 5000 ? 0.1271 : 0.1810;
        for (const double entry : {0.0, kPi / 2}) {
            const DepthLimit limit =
                depth_limit([&](double mm) { return cut(modes, rpm, mm, entry, entry + kPi / 2); }, 10);
            EXPECT_NEAR(*limit.depth_mm, expected, 1e-3 * expected) << rpm;
        }
        const double up = cut(modes, rpm, 0.4, 0, kPi / 2).multiplier;
        EXPECT_NEAR(cut(modes, rpm, 0.4, kPi / 2, kPi).multiplier, up, 1e-9) << rpm;
    }
}

TEST(Stability, is_the_same_for_a_mode_of_the_tool_and_of_the_part) {
    Mode mode = benchmark_mode({1, 0.3, 0});
    const double tool = cut({&mode, 1}, 8000, 1, 0, kPi).multiplier;
    mode.on = ModeOn::part;
    EXPECT_NEAR(cut({&mode, 1}, 8000, 1, 0, kPi).multiplier, tool, 1e-9);
}

TEST(Stability, without_cutting_is_the_decay_of_the_mode) {
    const Mode mode = benchmark_mode();
    // Stays in the air for the whole of its turn.
    const Stability s = stability({&mode, 1}, CutFeedback(kCutter, kAluminium, {}, 6000));
    EXPECT_NEAR(s.multiplier, std::exp(-0.011 * math::kTwoPi * 922 * 0.005), 1e-9);
    EXPECT_EQ(s.kind, ChatterKind::stable);
}

// Where the force is radial alone and the teeth cut all around, two equal modes feel one constant feedback,
// as in turning. There the border of stability is known in closed form (Tobias 1965; Altintas, Manufacturing
// Automation, 2nd ed., 4.2): b = -1 / (2 K Re G), speed from the phase.
TEST(Stability, all_around_is_that_of_turning) {
    constexpr int kTeeth = 4;
    const milling::Cutter cutter{.diameter_mm = 10, .flutes = kTeeth, .helix_deg = 0};
    const milling::CuttingCoefficients radial{1e-12, 500, 0, 0, 0, 0};
    const std::array modes{benchmark_mode(), benchmark_mode({0, 1, 0})};
    const double stiffness = kTeeth * radial.krc / 2;
    for (const double hz : {925.0, 932.0, 945.0}) {
        const std::complex<double> g = receptance(modes[0], hz);
        const double depth = -1 / (2 * stiffness * g.real());
        for (const int waves : {0, 1, 3}) {
            // 1 + K b (1 - e^(-iwT)) G = 0.
            const double phase = std::arg(1.0 + 1.0 / (stiffness * depth * g));
            const double period_s = (math::kTwoPi * (waves + 1) - phase) / (math::kTwoPi * hz);
            const milling::EngagementBand band{0, depth, 0, math::kTwoPi};
            const Stability s =
                stability(modes, CutFeedback(cutter, radial, {&band, 1}, 60 / (kTeeth * period_s)));
            EXPECT_NEAR(s.multiplier, 1, 1e-7) << hz << " " << waves;
            const double turns = hz * s.period_s, apart = turns - std::round(turns);
            EXPECT_NEAR(s.angle_rad, math::kTwoPi * std::abs(apart), 1e-6) << hz << " " << waves;
        }
    }
}

TEST(Stability, of_helix_unequal_pitch_and_three_modes_is_that_of_another_method) {
    const std::array modes{Mode{{1, 0.2, 0}, 700, 0.02, 8000}, Mode{{-0.1, 1, 0.1}, 1150, 0.03, 12'000},
                           Mode{{0.3, 0.5, 1}, 1900, 0.04, 30'000, ModeOn::part}};
    const milling::CuttingCoefficients k{900, 300, 150, 0, 0, 0};
    for (const std::vector<double>& pitch : {std::vector<double>{}, {84, 96, 84, 96}, {80, 100, 85, 95}}) {
        for (const double helix : {0.0, 30.0}) {
            for (const double depth : {0.4, 2.0}) {
                const milling::Cutter cutter{
                    .diameter_mm = 12, .flutes = 4, .helix_deg = helix, .pitch_deg = pitch};
                const milling::EngagementBand band{0, depth, 0.3, 1.7};
                const CutFeedback feedback(cutter, k, {&band, 1}, 7000);
                EXPECT_NEAR(stability(modes, feedback).multiplier / test::growth(modes, feedback), 1, 1e-3)
                    << pitch.size() << " " << helix << " " << depth;
            }
        }
    }
}

TEST(Stability, of_many_cuts_is_that_of_all_eigenvalues_of_one_large_matrix) {
    std::mt19937 random(3);
    const auto number = [&](double from, double to) {
        return from + (to - from) * static_cast<double>(random()) / 4294967296.0;
    };
    for (int draw = 0; draw < 40; ++draw) {
        std::vector<Mode> modes;
        for (int n = 0; n <= draw % 3; ++n) {
            modes.push_back({{number(-1, 1), number(-1, 1), number(-1, 1)},
                             number(300, 1500),
                             number(0.005, 0.1),
                             number(1000, 50'000),
                             n == 1 ? ModeOn::part : ModeOn::tool});
        }
        const milling::Cutter cutter{
            .kind = draw % 4 == 0 ? milling::CutterKind::ball : milling::CutterKind::flat,
            .diameter_mm = 10,
            .flutes = 2 + draw % 2,
            .helix_deg = draw % 2 == 0 ? 0 : number(-45, 45)};
        const milling::CuttingCoefficients k{number(200, 2000), number(0, 1000), number(-200, 600), 0, 0, 0};
        const double entry = number(0, 2), exit = entry + number(0.2, 3);
        const milling::EngagementBand band{0, number(0.1, 4), entry, exit};
        const CutFeedback feedback(cutter, k, {&band, 1}, number(6000, 25'000));
        const double expected = test::multiplier_by_chebyshev(modes, feedback);
        EXPECT_NEAR(stability(modes, feedback).multiplier, expected, 1e-7 * std::max(1.0, expected)) << draw;
    }
}

TEST(Stability, of_a_second_mode_is_exact_too_also_deep_and_slow) {
    const Mode first = benchmark_mode(), second{{1, 0, 0}, 1400, 0.011, 5000};
    const std::array modes{first, second};
    for (const auto& [rpm, depth] :
         {std::pair{10'000.0, 0.3}, {10'000.0, 2.0}, {5000.0, 5.0}, {1500.0, 0.3}}) {
        const milling::EngagementBand band{0, depth, 0, kPi};
        const CutFeedback feedback(kCutter, kAluminium, {&band, 1}, rpm);
        const double expected = test::multiplier_by_chebyshev(modes, feedback);
        EXPECT_NEAR(stability(modes, feedback).multiplier / expected, 1, 1e-7) << rpm << " " << depth;
    }
}

TEST(Stability, of_anything_does_not_depend_on_where_the_cutter_starts) {
    // The same cut with the flutes numbered from another one.
    std::mt19937 random(7);
    const auto number = [&](double from, double to) {
        return from + (to - from) * static_cast<double>(random()) / 4294967296.0;
    };
    for (int draw = 0; draw < 12; ++draw) {
        std::vector<double> pitch{number(70, 110), number(70, 110), number(70, 110)};
        pitch.push_back(360 - pitch[0] - pitch[1] - pitch[2]);
        const milling::CuttingCoefficients k{number(200, 3000), number(0, 1500), number(-200, 600), 0, 0, 0};
        const std::array modes{
            Mode{{1, number(-1, 1), 0}, number(200, 700), number(0.005, 0.1), number(1000, 1e5)},
            Mode{{number(-1, 1), 1, number(-1, 1)}, number(200, 700), number(0.005, 0.1), 2e4}};
        const double entry = number(0, 2), width = number(0.1, 3), depth = number(0.1, 8);
        const double rpm = number(9000, 20'000), helix = number(-45, 45);
        double first = 0;
        for (int turn = 0; turn < 4; ++turn) {
            const milling::Cutter cutter{
                .diameter_mm = 10, .flutes = 4, .helix_deg = helix, .pitch_deg = pitch};
            const milling::EngagementBand band{0, depth, entry, entry + width};
            const double found = stability(modes, CutFeedback(cutter, k, {&band, 1}, rpm)).multiplier;
            if (turn == 0) first = found;
            EXPECT_NEAR(found, first, 1e-5 * std::max(1.0, first)) << draw;
            std::rotate(pitch.begin(), pitch.begin() + 1, pitch.end());
        }
    }
}

// Of the lines that a multiplier may have, the strongest one in the second half of a vibration that was
// simulated in time.
double strongest_line(std::span<const Vec3> vibration, double rate_hz, const Stability& s) {
    const std::size_t half = vibration.size() / 2;
    double best = 0, most = 0;
    for (int n = -40; n <= 40; ++n) {
        const double hz = std::abs(s.angle_rad / math::kTwoPi + n) / s.period_s;
        std::complex<double> x, y, z;
        for (std::size_t k = half; k < vibration.size(); ++k) {
            const double turn = math::kTwoPi * static_cast<double>(k - half) / static_cast<double>(half);
            const std::complex<double> wave =
                (1 - std::cos(turn)) * std::polar(1.0, -math::kTwoPi * hz * static_cast<double>(k) / rate_hz);
            x += vibration[k].x * wave;
            y += vibration[k].y * wave;
            z += vibration[k].z * wave;
        }
        const double power = std::norm(x) + std::norm(y) + std::norm(z);
        if (power <= most) continue;
        most = power;
        best = hz;
    }
    return best;
}

TEST(Stability, names_the_strongest_line_of_a_simulated_vibration) {
    constexpr double kRateHz = 48'000;
    const std::array modes{Mode{{1, 0.3, 0}, 922, 0.02, 5000}, Mode{{-0.2, 1, 0.1}, 1100, 0.03, 4000}};
    const milling::CuttingCoefficients k{600, 200, 150, 0, 0, 0};
    struct Case {
        std::vector<double> pitch_deg;
        double rpm, depth_mm;
    };
    for (const Case& c :
         {Case{{}, 7000, 0.97}, Case{{}, 3200, 1.7}, Case{{119.999, 120, 120.001}, 7000, 0.97},
          Case{{119, 120, 121}, 7000, 0.97}, Case{{119, 120, 121}, 7000, 0.8},
          Case{{115, 120, 125}, 7000, 1.2}, Case{{115, 120, 125}, 5000, 1.2}, Case{{175, 185}, 7000, 2.5},
          Case{{170, 190}, 5000, 2.5}}) {
        const milling::Cutter cutter{.diameter_mm = 12,
                                     .flutes = c.pitch_deg.size() == 2 ? 2 : 3,
                                     .helix_deg = 30,
                                     .pitch_deg = c.pitch_deg};
        const milling::EngagementBand band{0, c.depth_mm, 20 * math::kRadPerDeg, 110 * math::kRadPerDeg};
        const Stability s = stability(modes, CutFeedback(cutter, k, {&band, 1}, c.rpm));
        // Two simulations, of which one is pushed a little: their difference has no forced vibration.
        Vibration free(modes, cutter, k, kRateHz), pushed(modes, cutter, k, kRateHz);
        std::vector<Vec3> vibration;
        for (Vibration* v : {&free, &pushed}) v->engage({&band, 1}, {.across_mm = 0.1}, c.rpm);
        const auto turns = [&](double count) { return static_cast<int>(count * 60 * kRateHz / c.rpm); };
        for (int n = 0; n < turns(1.5); ++n) {
            free.step();
            pushed.step();
        }
        pushed.scale_modes(1 + 1e-9);
        const int count = turns(60);
        for (int n = 0; n < count; ++n) {
            // Without its growth.
            const double size = std::pow(s.multiplier, -n / (kRateHz * s.period_s));
            const Vec3 from = free.step().displacement_mm;
            vibration.push_back(size * (pushed.step().displacement_mm - from));
        }
        EXPECT_NEAR(s.chatter_hz, strongest_line(vibration, kRateHz, s), 1e-6)
            << c.pitch_deg.size() << " " << c.rpm << " " << c.depth_mm << " " << s.multiplier;
    }
}

}  // namespace
}  // namespace tribo::dynamics
