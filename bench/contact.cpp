// SPDX-License-Identifier: MIT
// What a tick of the contact costs and how well it does, on a field of grooves: scallops of 25 um every
// millimetre, feed marks of 8 um every half, on a gently curved base of 100 x 100 mm; a stroke of 60 s at 1
// kHz, 88 mm/s at most, 0.5 mm deep give or take 30 %, stiffness 1 N/mm. The peer's figures are CHAI3D's
// finger proxy on a mesh of that surface (its best median, its best p99.9).
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#if defined(__x86_64__)
#include <x86intrin.h>
#endif

#include "cuts.hpp"
#include "haptics/contact/field_contact.hpp"
#include "harness.hpp"
#include "milling/sweep/sweep.hpp"

namespace tribo::bench {
namespace {

constexpr double kCell = 0.15, kSidestep = 1, kMark = 0.5;
constexpr double kTickS = 1e-3, kStrokeS = 60;
// A ball of this radius leaves marks of 8 um every 0.5 mm; drawn across by kAcross, scallops of 25 um every 1
// mm.
constexpr double kBall = 3.9;
const double kAcross = kSidestep - 2 * std::sqrt(2 * kBall * 0.025 - 0.025 * 0.025);

double base_mm(double x, double y) {
    return -0.6 + 0.3 * std::sin(0.05 * x) * std::cos(0.04 * y);
}

std::uint64_t clock_ticks() {
#if defined(__x86_64__)
    unsigned processor = 0;
    return __rdtscp(&processor);
#else
    return static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count());
#endif
}

double us_per_tick() {
    const double start = wall_s();
    const std::uint64_t first = clock_ticks();
    while (wall_s() - start < 0.05) {
    }
    return 1e6 * (wall_s() - start) / static_cast<double>(clock_ticks() - first);
}

struct Times {
    double p50 = 0, p99 = 0, p999 = 0, max = 0;
};
Times quantiles(std::vector<double>& us) {
    std::sort(us.begin(), us.end());
    const auto at = [&](double share) {
        return us[static_cast<std::size_t>(share * static_cast<double>(us.size() - 1))];
    };
    return {at(0.5), at(0.99), at(0.999), us.back()};
}

std::unique_ptr<field::CarvedField> stock(double edge_mm) {
    return block({{0, 0, -8}, {edge_mm, edge_mm, 0}}, kCell);
}

void carve(field::CarvedField& field, std::vector<std::unique_ptr<const field::Shape>>& sweeps) {
    std::vector<double> removed(sweeps.size());
    field.carve(sweeps, removed);
    sweeps.clear();
}

// One straight sweep for each tooth's mark.
std::unique_ptr<field::CarvedField> straight_grooves(double edge_mm) {
    auto field = stock(edge_mm);
    const auto ball = end_mill(milling::CutterKind::ball, 2 * kBall, 2, 30);
    std::vector<std::unique_ptr<const field::Shape>> sweeps;
    for (double x = 0; x <= edge_mm; x += kSidestep) {
        for (double y = 0; y <= edge_mm; y += kMark) {
            const Vec3 tip{x, y, base_mm(x, y)};
            sweeps.push_back(milling::make_sweep(
                ball, straight(tip - Vec3{0.5 * kAcross, 0, 0}, tip + Vec3{0.5 * kAcross, 0, 0})));
            if (sweeps.size() == 512) carve(*field, sweeps);
        }
    }
    carve(*field, sweeps);
    return field;
}

// A ball of radius 5 along y with a swaying axis, in quadratic pieces of 5 mm; its centre is what counts.
std::unique_ptr<field::CarvedField> five_axis_grooves(double edge_mm) {
    auto field = stock(edge_mm);
    const auto ball = end_mill(milling::CutterKind::ball, 10, 2, 30);
    const auto pose = [](double x, double y) {
        const Vec3 axis =
            normalized(Vec3{0.15 * std::cos(0.08 * x + 0.1 * y), 0.2 + 0.15 * std::sin(0.1 * y), 1});
        return motion::ToolPose{Vec3{x, y, base_mm(x, y) + 5} - 5 * axis, axis};
    };
    std::vector<std::unique_ptr<const field::Shape>> sweeps;
    for (double x = 0; x <= edge_mm; x += kSidestep) {
        for (double y = -5; y < edge_mm + 5; y += 5) {
            const motion::ToolPose a = pose(x, y), m = pose(x, y + 2.5), b = pose(x, y + 5);
            motion::Move move = straight(a.tip_mm, b.tip_mm);
            move.start = a;
            move.end = b;
            move.quadratic = motion::Quadratic{2 * m.tip_mm - 0.5 * (a.tip_mm + b.tip_mm),
                                               2 * m.axis - 0.5 * (a.axis + b.axis)};
            sweeps.push_back(milling::make_sweep(ball, move));
        }
        carve(*field, sweeps);
    }
    return field;
}

// The hand: a slow figure over all of the field.
Vec3 probe_at(double t, double edge_mm, double radius_mm) {
    const double half = 0.45 * edge_mm, middle = 0.5 * edge_mm, turn = 2 * std::numbers::pi;
    // 88 mm/s at most, whatever the field's size.
    const double rate = 88 / (half * std::hypot(1.0, 0.6180339887));
    const double x = middle + half * std::sin(rate * t),
                 y = middle + half * std::sin(0.6180339887 * rate * t + 0.4);
    const double depth = 0.5 * (1 + 0.3 * std::sin(turn * 0.7 * t));
    return {x, y, base_mm(x, y) + radius_mm - depth};
}

// The nearest air: exact, for air is a union of the marks' capsules.
double depth_in_marks(Vec3 p) {
    double least = 1e9;
    const double i = std::round(p.x / kSidestep), j = std::round(p.y / kMark);
    for (double x = i - 2; x <= i + 2; ++x) {
        for (double y = j - 4; y <= j + 4; ++y) {
            const Vec3 centre{x * kSidestep, y * kMark, base_mm(x * kSidestep, y * kMark) + kBall};
            const Vec3 off{std::max(0.0, std::abs(p.x - centre.x) - 0.5 * kAcross), p.y - centre.y,
                           p.z - centre.z};
            least = std::min(least, length(off) - kBall);
        }
    }
    return least;
}

struct Stroke {
    Times tick, empty;
    double mean_ratio = 0, worst_off = 0;
    long off_ticks = 0, contact_ticks = 0, unsettled = 0, inward = 0;
    double queries = 0;
};

// `exact`: compare with the closed form (of a point on straight marks). `least_us`: of each tick, over all
// calls with this stroke.
Stroke one_stroke(const field::CarvedField& field, double edge_mm, double radius_mm, double friction,
                  bool exact, std::vector<double>& least_us) {
    haptics::ContactOptions options;
    options.stiffness_n_per_mm = 1;
    options.probe_radius_mm = radius_mm;
    options.friction_static = friction;
    options.friction_kinetic = 0.7 * friction;
    haptics::FieldContact contact(field, options);
    Stroke s;
    const double scale = us_per_tick();
    std::vector<double> empty;
    const auto ticks = static_cast<long>(kStrokeS / kTickS);
    least_us.resize(static_cast<std::size_t>(ticks), 1e30);
    empty.reserve(static_cast<std::size_t>(ticks));
    Vec3 start = probe_at(0, edge_mm, radius_mm);
    start.z += 3;
    contact.update(start);
    double sum = 0, wanted = 0, queries = 0;
    for (long n = 0; n < ticks; ++n) {
        const Vec3 probe = probe_at(kTickS * static_cast<double>(n), edge_mm, radius_mm);
        const std::uint64_t before = clock_ticks();
        const std::uint64_t between = clock_ticks();
        const haptics::ProbeContact c = contact.update(probe);
        const std::uint64_t after = clock_ticks();
        keep(c);
        empty.push_back(scale * static_cast<double>(between - before));
        double& us = least_us[static_cast<std::size_t>(n)];
        us = std::min(us, scale * static_cast<double>(after - between));
        queries += contact.queries();
        if (c.in_contact) ++s.contact_ticks;
        if (!c.settled) ++s.unsettled;
        if (c.in_contact && dot(c.force_n, c.normal) < 0) ++s.inward;
        if (!exact) continue;
        const double right = depth_in_marks(probe), force = length(c.force_n);
        sum += force;
        wanted += right;
        const double off = std::abs(force - right);
        s.worst_off = std::max(s.worst_off, off / (0.2 * right + 0.02));
        if (off > 0.2 * right + 0.02) ++s.off_ticks;
    }
    s.empty = quantiles(empty);
    s.mean_ratio = exact ? sum / wanted : 0;
    s.queries = queries / static_cast<double>(ticks);
    return s;
}

// Each tick's least of so many: the stroke is the same, what else the machine does is not.
Stroke stroke(const field::CarvedField& field, double edge_mm, double radius_mm, double friction, bool exact,
              int times = 3) {
    std::vector<double> us;
    Stroke s;
    for (int n = 0; n < times; ++n) s = one_stroke(field, edge_mm, radius_mm, friction, exact, us);
    s.tick = quantiles(us);
    s.tick.p50 -= s.empty.p50;
    s.tick.p99 -= s.empty.p50;
    s.tick.p999 -= s.empty.p50;
    s.tick.max -= s.empty.p50;
    return s;
}

void add_times(Report& report, const std::string& name, const Stroke& s, double p50_goal, double p999_goal,
               double peer_p50, double peer_p999) {
    Entry p50{name + ", p50", s.tick.p50, "us", p50_goal};
    Entry p999{name + ", p99.9", s.tick.p999, "us", p999_goal};
    if (peer_p50 > 0) {
        p50.peer = p999.peer = "CHAI3D 3.3.0";
        p50.peer_value = peer_p50;
        p999.peer_value = peer_p999;
    }
    report.add(p50);
    report.add({name + ", p99", s.tick.p99, "us"});
    report.add(p999);
    report.add({name + ", max", s.tick.max, "us", 100});
    report.add({name + ", max of an empty section", s.empty.max, "us"});
    char text[160];
    std::snprintf(text, sizeof text,
                  "  %.1f queries a tick, %ld of 60000 ticks in contact, %ld unsettled, %ld inward",
                  s.queries, s.contact_ticks, s.unsettled, s.inward);
    report.note(text);
}

}  // namespace

void measure_contact(Report& report) {
    report.section("A tick of contact, 60 s at 1 kHz over grooves, 0.15 mm grid, each tick's least of three");
    const auto small = straight_grooves(100);
    const Stroke point = stroke(*small, 100, 0, 0, true);
    add_times(report, "contact tick, straight sweeps, point", point, 1, 5, 1.8, 33);
    report.add({"contact force over the analytic one, mean", point.mean_ratio, "1", 1.05});
    report.add({"contact force off the analytic one, worst over what is allowed", point.worst_off, "1", 1});
    report.add({"contact ticks with a force off by more", static_cast<double>(point.off_ticks), "1", 0});
    const Stroke rubbed = stroke(*small, 100, 0, 0.5, false);
    add_times(report, "contact tick, straight sweeps, point, friction 0.5", rubbed, 1, 5, 1.8, 33);
    const Stroke ball = stroke(*small, 100, 0.5, 0, false);
    add_times(report, "contact tick, straight sweeps, 0.5 mm ball", ball, 2, 10, 6.0, 66);
    add_times(report, "contact tick, straight sweeps, 2 mm ball", stroke(*small, 100, 2, 0, false), 2, 10, 0,
              0);
    add_times(report, "contact tick, straight sweeps, ball as wide as the cutter",
              stroke(*small, 100, kBall, 0, false, 1), 2, 10, 0, 0);
    const auto large = straight_grooves(200);
    const Stroke wide = stroke(*large, 200, 0, 0, true);
    report.add(
        {"contact tick at four times the area, p50 over p50", wide.tick.p50 / point.tick.p50, "1", 1.2});
    report.add({"contact tick at four times the area, p99.9 over p99.9", wide.tick.p999 / point.tick.p999,
                "1", 1.2});
    const auto tilted = five_axis_grooves(100);
    const Stroke five = stroke(*tilted, 100, 0, 0, false);
    add_times(report, "contact tick, five-axis sweeps, point", five, 5, 40, 0, 0);
    add_times(report, "contact tick, five-axis sweeps, 0.5 mm ball", stroke(*tilted, 100, 0.5, 0, false), 5,
              40, 0, 0);
    add_times(report, "contact tick, five-axis sweeps, 2 mm ball", stroke(*tilted, 100, 2, 0, false), 5, 40,
              0, 0);
}

}  // namespace tribo::bench
