// SPDX-License-Identifier: MIT
// What a vibrating tool leaves on walls: against the harmonics of the force in closed form, the multipliers
// of theory, and the simulation itself.
#include "session/chatter/surface_recorder.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <map>

#include "base/math.hpp"
#include "session/chatter/row_simulation.hpp"
#include "session/chatter/row_stability.hpp"
#include "wall_cut.hpp"

namespace tribo::session {
namespace {

using Complex = std::complex<double>;

surface::ToothTraces recorded(const Wall& w) {
    const MillSetup setup = setup_of(w);
    SurfaceRecorder recorder(setup);
    RowSimulation simulation(setup, false, &recorder);
    const double length_s = 0.5 / feed_speed(w);
    const int rows = static_cast<int>(std::ceil(w.seconds / length_s));
    for (int n = 0; n < rows; ++n)
        (void)simulation.run(row_of(w, setup, n * length_s, std::min(w.seconds, (n + 1) * length_s)));
    return recorder.take();
}

// The displacements in the order of time, of the lowest traces on one side.
std::vector<double> displaced(const surface::ToothTraces& all, const Vec3& normal) {
    std::vector<double> values;
    for (const surface::ToothTrace& t : all.traces) {
        if (dot(t.normal, normal) < 0.9 || t.from_mm.z > all.traces.front().from_mm.z + 0.01) continue;
        for (std::size_t n = t.first; n < t.first + t.count; ++n)
            values.push_back(static_cast<double>(all.marks[n].displaced_mm));
    }
    return values;
}

// Displacement across the feed by the force of a stiff cut, as an edge at this height is at `at_rad`: Re sum
// G(i m w) F_m e^(i m w t). The harmonics of an edge by the midpoint rule, those of the helix in closed form.
double wall_error_mm(const Wall& w, double at_rad, double height_mm) {
    const dynamics::Mode& mode = w.modes[0];
    const int teeth = w.cutter.flutes;
    const double lag = w.cutter.lag_rad(1);
    const auto harmonic = [&](int m) {
        constexpr int kSteps = 2000;
        Complex sum{};
        for (int n = 0; n < kSteps; ++n) {
            const double step = (w.exit_rad - w.entry_rad) / kSteps, phi = w.entry_rad + (n + 0.5) * step;
            const double chip = w.feed_mm * std::sin(phi);
            const double fy =
                chip * (w.coefficients.ktc * std::sin(phi) - w.coefficients.krc * std::cos(phi));
            sum += step * fy * std::exp(Complex(0, -m * phi * teeth));
        }
        const double turn = m * teeth * lag * w.depth_mm;
        const Complex over_height =
            std::abs(turn) < 1e-9 ? 1 : (1.0 - std::exp(Complex(0, -turn))) / Complex(0, turn);
        return w.depth_mm * over_height * sum / (2 * math::kPi / teeth);
    };
    double error = 0;
    for (int m = -60; m <= 60; ++m) {
        const double ratio = m * w.rpm / 60 * teeth / mode.frequency_hz;
        const Complex receptance =
            1 / mode.stiffness_n_per_mm / Complex(1 - ratio * ratio, 2 * mode.damping_ratio * ratio);
        const double tip_rad = at_rad + lag * height_mm;
        error += (receptance * harmonic(m) * std::exp(Complex(0, m * tip_rad * teeth))).real();
    }
    return error;
}

dynamics::Stability theory(const Wall& w) {
    const MillSetup setup = setup_of(w);
    return *stability_of(row_of(w, setup, 0, 0.01), setup);
}

TEST(SurfaceRecorder, finds_the_steady_wall_error_of_the_harmonics) {
    struct Case {
        double entry_rad, exit_rad, helix_deg;
    };
    for (const Case& c : {Case{0, 1.2, 0}, Case{2, math::kPi, 0}, Case{0, 1.2, 30}, Case{2, math::kPi, 30},
                          Case{0, 2.5, -40}, Case{0, math::kPi, 0}}) {
        for (const double rpm : {4000.0, 7300.0, 9500.0}) {
            Wall w;
            w.modes = {{{0, 1, 0}, 922, 0.03, 6000}};
            w.cutter.helix_deg = c.helix_deg;
            w.depth_mm = 2;
            w.rpm = rpm;
            w.entry_rad = c.entry_rad;
            w.exit_rad = c.exit_rad;
            ASSERT_LT(theory(w).multiplier, 0.95);
            const surface::ToothTraces all = recorded(w);
            std::map<std::pair<bool, double>, double> errors;
            double largest = 0, farthest = 0;
            std::size_t compared = 0;
            for (const surface::ToothTrace& t : all.traces) {
                if (t.start_s < 0.4) continue;
                // A tool to the left cuts too deep on the left, and leaves material on the right.
                const bool left = t.normal.y < 0;
                const double height = t.from_mm.z - 3;
                const auto [known, is_new] = errors.try_emplace({left, height});
                if (is_new) known->second = wall_error_mm(w, left ? 0 : math::kPi, height);
                const double r = known->second;
                for (std::size_t n = t.first; n < t.first + t.count; ++n) {
                    const double mark = static_cast<double>(all.marks[n].displaced_mm);
                    farthest = std::max(farthest, std::abs(mark - (left ? -r : r)));
                    ++compared;
                }
                largest = std::max(largest, std::abs(r));
            }
            EXPECT_GT(compared, 10u);
            EXPECT_GT(largest, 1e-4);
            EXPECT_LT(farthest, 0.02 * largest) << rpm << " " << c.entry_rad << " " << c.exit_rad;
        }
    }
}

// A part that bends is the same as a tool that does, and a cut seen from elsewhere is the same cut.
TEST(SurfaceRecorder, knows_no_direction_of_the_stock) {
    Wall w;
    w.modes = {{{0.3, 1, 0}, 922, 0.03, 6000}};
    w.exit_rad = 1.2;
    w.seconds = 0.2;
    const surface::ToothTraces known = recorded(w);
    Wall part = w;
    part.modes[0].on = dynamics::ModeOn::part;
    Wall turned = w;
    turned.feed = {0, 1, 0};
    turned.modes[0].direction = {-1, 0.3, 0};
    Wall tilted = w;
    const double s = std::sin(0.8), c = std::cos(0.8);
    tilted.feed = {c, 0, -s};
    tilted.axis = {s, 0, c};
    for (const Wall& other : {part, turned, tilted}) {
        const surface::ToothTraces found = recorded(other);
        ASSERT_EQ(found.marks.size(), known.marks.size());
        for (std::size_t n = 0; n < found.marks.size(); ++n) {
            EXPECT_NEAR(found.marks[n].displaced_mm, known.marks[n].displaced_mm, 1e-8);
            EXPECT_NEAR(found.marks[n].at, known.marks[n].at, 1e-6);
        }
        for (const surface::ToothTrace& t : found.traces) {
            const Vec3 left = cross(other.axis, other.feed);
            EXPECT_NEAR(dot(t.normal, left), -1, 1e-12);
            EXPECT_NEAR(dot(t.from_mm - Vec3{1, 2, 3}, left), 5, 1e-9);
        }
    }
}

// The ratio of three values in a row of a growing wave: x(n+1) + a x(n) + b x(n-1) = 0 by least squares.
Complex multiplier_of(std::vector<double> x) {
    double aa = 0, ab = 0, bb = 0, ya = 0, yb = 0;
    for (std::size_t n = 2; n < x.size(); ++n) {
        aa += x[n - 1] * x[n - 1];
        ab += x[n - 1] * x[n - 2];
        bb += x[n - 2] * x[n - 2];
        ya -= x[n] * x[n - 1];
        yb -= x[n] * x[n - 2];
    }
    const double det = aa * bb - ab * ab, a = (ya * bb - yb * ab) / det, b = (yb * aa - ya * ab) / det;
    const Complex root = std::sqrt(Complex(a * a / 4 - b));
    const Complex first = -a / 2 + root, second = -a / 2 - root;
    return std::abs(first) > std::abs(second) ? first : second;
}

// The steady part of the marks drops out of the difference of neighbours.
std::vector<double> wave(const Wall& w) {
    std::vector<double> marks = displaced(recorded(w), {0, -1, 0});
    for (std::size_t n = 0; n + 1 < marks.size(); ++n) marks[n] = marks[n + 1] - marks[n];
    marks.pop_back();
    return marks;
}

TEST(SurfaceRecorder, leaves_waves_of_the_length_that_theory_names) {
    Wall w;
    w.modes = {{{1, 0.4, 0}, 922, 0.011, 1340}};
    w.depth_mm = 0.75;
    const dynamics::Stability known = theory(w);
    ASSERT_EQ(known.kind, dynamics::ChatterKind::quasi_periodic);
    ASSERT_GT(known.multiplier, 1.02);
    // After the start, and before teeth leave the cut by much.
    std::vector<double> marks = wave(w);
    marks.resize(40);
    marks.erase(marks.begin(), marks.begin() + 6);
    const Complex found = multiplier_of(marks);
    EXPECT_NEAR(std::abs(found), known.multiplier, 0.02);
    // Feed speed over the distance of the chatter line from the nearest harmonic of the teeth.
    const double tooth_hz = w.rpm / 60 * w.cutter.flutes;
    const double off_hz = std::abs(std::remainder(known.chatter_hz, tooth_hz));
    EXPECT_NEAR(2 * math::kPi * w.feed_mm / std::abs(std::arg(found)) / (feed_speed(w) / off_hz), 1, 0.01);
}

TEST(SurfaceRecorder, leaves_waves_of_two_feeds_per_tooth_where_the_period_doubles) {
    Wall w;
    w.modes = {{{1, 0, 0}, 922, 0.011, 1340}, {{0, 1, 0}, 3000, 0.03, 10000}};
    w.rpm = 10000;
    w.depth_mm = 2.6;
    w.entry_rad = math::kPi / 2;
    const dynamics::Stability known = theory(w);
    ASSERT_EQ(known.kind, dynamics::ChatterKind::period_doubling);
    ASSERT_GT(known.multiplier, 1.02);
    const std::vector<double> marks = displaced(recorded(w), {0, 1, 0});
    ASSERT_GT(marks.size(), 100u);
    for (std::size_t n = marks.size() - 60; n < marks.size(); ++n) {
        EXPECT_NEAR(marks[n], marks[n - 2], 1e-4) << n;
        EXPECT_GT(std::abs(marks[n] - marks[n - 1]), 2e-3) << n;
    }
}

// Marks are the displacements of the instants at which the teeth stand at the walls.
TEST(SurfaceRecorder, takes_the_displacement_of_the_instant) {
    Wall w;
    w.modes = {{{1, 0.4, 0}, 922, 0.011, 1340}};
    w.cutter.helix_deg = 30;
    w.depth_mm = 1;
    w.seconds = 0.2;
    const surface::ToothTraces all = recorded(w);
    dynamics::Vibration vibration(w.modes, w.cutter, w.coefficients, 48000);
    const milling::EngagementBand band{0, w.depth_mm, 0, math::kPi};
    vibration.engage({&band, 1}, {.across_mm = w.feed_mm}, w.rpm);
    std::vector<Vec3> samples;
    for (int n = 0; n < 48000 * w.seconds; ++n) samples.push_back(vibration.step().displacement_mm);
    double largest = 0;
    std::size_t compared = 0;
    for (const surface::ToothTrace& t : all.traces) {
        for (std::size_t n = t.first; n < t.first + t.count; ++n) {
            const double t_s = std::lerp(t.start_s, t.end_s, static_cast<double>(all.marks[n].at));
            const double at = t_s * 48000;
            const auto before = static_cast<std::size_t>(at);
            if (before + 1 >= samples.size()) continue;
            const Vec3 r = lerp(samples[before], samples[before + 1], at - std::floor(at));
            EXPECT_NEAR(all.marks[n].displaced_mm, dot(r, t.normal), 2e-4) << t_s;
            largest = std::max(largest, std::abs(dot(r, t.normal)));
            ++compared;
        }
    }
    EXPECT_GT(compared, 100u);
    EXPECT_GT(largest, 0.01);
}

// Each tooth leaves a mark at each height, in whatever pieces the path is cut.
TEST(SurfaceRecorder, misses_no_tooth_between_rows) {
    Wall w;
    w.modes = {{{0, 1, 0}, 922, 0.03, 6000}};
    w.cutter.flutes = 3;
    w.cutter.pitch_deg = {100, 120, 140};
    w.exit_rad = 1.2;
    const surface::ToothTraces all = recorded(w);
    const double passages = w.seconds * w.rpm / 60 * 3;
    EXPECT_NEAR(static_cast<double>(all.marks.size()), passages, 2);
    double last = -1;
    for (const surface::ToothTrace& t : all.traces) {
        for (std::size_t n = t.first; n < t.first + t.count; ++n) {
            const double t_s = std::lerp(t.start_s, t.end_s, static_cast<double>(all.marks[n].at));
            if (last >= 0) {
                const double pitch_deg = (t_s - last) * w.rpm / 60 * 360;
                EXPECT_GT(pitch_deg, 98);
                EXPECT_LT(pitch_deg, 142);
            }
            last = t_s;
        }
    }
}

// A row of three short moves about a corner of a wall on the left: by its own feed each move stands a radius
// off the wall, and near the corners the next one cuts deeper.
TEST(SurfaceRecorder, knows_a_place_of_its_wall_that_other_moves_of_the_row_do_not_cut) {
    Wall w;
    w.modes = {{{0, 1, 0}, 922, 0.03, 6000}};
    w.exit_rad = 1.2;
    MillSetup setup = setup_of(w);
    const motion::Move whole = setup.moves[0];
    setup.moves.clear();
    Vec3 at = whole.start.tip_mm;
    const double turn_rad = 0.04;
    for (const auto& [turns, length_mm] : {std::pair{0, 0.05}, {1, 0.3}, {2, 0.13}}) {
        motion::Move move = whole;
        move.start.tip_mm = at;
        at += length_mm * Vec3{std::cos(turns * turn_rad), std::sin(turns * turn_rad), 0};
        move.end.tip_mm = at;
        setup.moves.push_back(move);
    }
    setup.cutter_of_move = {0, 0, 0};
    setup.rpm_of_move = {w.rpm, w.rpm, w.rpm};
    setup.schedule = nullptr;
    setup.schedule = schedule_of(setup);
    SurfaceRecorder recorder(setup);
    RowSimulation simulation(setup, false, &recorder);
    (void)simulation.run(row_of(w, setup, 0, setup.schedule->duration_s));
    const surface::ToothTraces all = recorder.take();
    ASSERT_FALSE(all.traces.empty());
    const motion::Move& longest = setup.moves[1];
    const Vec3 middle = 0.5 * (longest.start.tip_mm + longest.end.tip_mm);
    const Vec3 left{-std::sin(turn_rad), std::cos(turn_rad), 0};
    for (const surface::ToothTrace& t : all.traces) {
        const Vec3 off = t.inner_mm - (middle + 5 * left);
        EXPECT_NEAR(std::hypot(off.x, off.y), 0, 1e-9);
    }
}

}  // namespace
}  // namespace tribo::session
