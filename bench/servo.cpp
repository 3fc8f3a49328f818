// SPDX-License-Identifier: MIT
// The servo: the table of forces against even spacing and against the paper's other table, the whole tick,
// the loop under load.
#include "haptics/servo/servo.hpp"

#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>
#include <thread>
#include <unistd.h>

#include "contact/jnd_profile.hpp"
#include "cuts.hpp"
#include "devices/servo/servo_thread.hpp"
#include "force_grid.hpp"
#include "haptics/servo/simulated_hand.hpp"
#include "harness.hpp"
#include "milling/force/force.hpp"
#include "session/feel/feel_session.hpp"

namespace tribo::bench {
namespace {

namespace fs = std::filesystem;
using std::numbers::pi;

constexpr const char* kExamples[] = {"bowl", "blade", "bracket", "dome", "plate", "rose"};

// What `tribo feel` says of itself over a stroke that stands at one place for five seconds.
nlohmann::json felt(const std::string& job, const std::string& flags, const fs::path& folder) {
    const fs::path stroke = folder / "stroke.csv", stats = folder / "stats.json";
    std::ofstream(stroke) << "t_s,x_mm,y_mm,z_mm\n0,0,0,-10\n5,20,10,-12\n";
    fs::remove(stats);
    const std::string command = std::string(TRIBO_PROGRAM) + " feel " + job + " --stroke " + stroke.string() +
                                " --out " + (folder / "trace.csv").string() + " --stats " + stats.string() +
                                " --device playback " + flags + " >/dev/null 2>&1";
    if (std::system(command.c_str()) != 0) return {};
    std::ifstream file(stats);
    return nlohmann::json::parse(file, nullptr, false);
}

void measure_tables(Report& report, const fs::path& folder) {
    report.section("Force along the path: knots by perception against even spacing of the same worst error");
    for (const char* name : kExamples) {
        const std::string job = std::string(TRIBO_SOURCE_DIR) + "/examples/" + name + "/" + name + ".toml";
        const auto stats = felt(job, "--mode cut --texture off", folder);
        if (!stats.is_object() || !stats.contains("force_table")) continue;
        const auto& table = stats["force_table"];
        const bool bowl = std::string(name) == "bowl";
        report.add({std::string("force table, ") + name, table["bytes"].get<double>() / 1e3, "kB"});
        report.add({std::string("worst error, ") + name, table["worst_jnd"].get<double>(), "JND", 0.5});
        report.add({std::string("times smaller than even spacing, ") + name,
                    table["times_smaller_than_uniform"].get<double>(), "",
                    bowl ? std::optional(3.0) : std::nullopt, Better::higher});
        report.add(
            {std::string("whole tick of the cut, ") + name, stats["cpu_us"]["p50"].get<double>(), "us", 2});
        if (!bowl) continue;
        const auto inspect = felt(job, "", folder);
        if (inspect.is_object())
            report.add({"whole tick on the bowl's surface", inspect["cpu_us"]["p50"].get<double>(), "us", 2});
    }
}

void measure_grid(Report& report) {
    report.section("The paper's other table: rotation, entry, exit, helix, feed, against the closed form");
    const milling::Cutter cutter = end_mill(milling::CutterKind::flat, 12, 2, 40);
    const ForceGridOptions options;
    const double built = wall_s();
    const ForceGrid grid(cutter, kAluminium, options);
    report.add({"table, to build", wall_s() - built, "s"});
    report.add({"table", static_cast<double>(grid.bytes()) / 1e6, "MB"});
    struct Case {
        double rotation, entry, exit, helix, feed;
    };
    std::mt19937 random(1);
    const auto any = [&](double from, double to) {
        return std::uniform_real_distribution<double>(from, to)(random);
    };
    std::vector<Case> cases;
    for (int n = 0; n < 20'000; ++n) {
        const double a = any(0, pi), b = any(0, pi);
        cases.push_back({any(0, 2 * pi), std::min(a, b), std::max(a, b), any(10, 50), any(0.02, 0.2)});
    }
    double squares = 0, worst = 0, sizes = 0, table_s = 0, closed_s = 0;
    milling::Cutter turned = cutter;
    milling::Engagement engagement;
    for (const Case& c : cases) {
        turned.helix_deg = c.helix;
        milling::ForceModel model(turned, kAluminium);
        engagement.clear();
        engagement.bands.push_back({0, options.axial_depth_mm, c.entry, c.exit});
        model.engage(engagement, {c.feed, 0});
        model.engage(engagement, {c.feed, 0});
        const double start = wall_s();
        model.engage(engagement, {c.feed, 0});
        const Vec3 exact = model.at(c.rotation).force_n;
        const double middle = wall_s();
        const Vec3 shown = grid.force_n(c.rotation, c.entry, c.exit, c.helix, c.feed);
        const double end = wall_s();
        keep(exact);
        keep(shown);
        closed_s += middle - start;
        table_s += end - middle;
        const double off = distance(exact, shown);
        squares += off * off;
        sizes += squared_length(exact);
        worst = std::max(worst, off);
    }
    const auto count = static_cast<double>(cases.size());
    report.add({"table, RMS error", 100 * std::sqrt(squares / sizes), "% of the RMS force"});
    report.add({"table, worst error", worst, "N"});
    report.add({"closed form, a look (engage and evaluate)", 1e9 * closed_s / count, "ns", std::nullopt,
                Better::lower, "the table", 1e9 * table_s / count});
}

// Five seconds at 1 kHz on the milled part while every core is busy; how often safety was violated is counted
// on the way.
void measure_load(Report& report, bool real_time) {
    std::atomic<bool> over{false};
    std::vector<std::thread> burners;
    for (unsigned n = 0; n < std::max(1U, std::thread::hardware_concurrency()); ++n) {
        burners.emplace_back([&] {
            double x = 1;
            while (!over) {
                for (int k = 0; k < 1000; ++k) x = std::sqrt(x + 1);
                keep(x);
            }
        });
    }
    haptics::SimulatedHand hand(haptics::Stroke({{0, {0, 0, 2}}, {0.2, {0, 0, -2}}, {5, {50, 0, -2}}}), 1e-3);
    session::MillSession milled(
        session_setup({{-5, -10, -8}, {55, 10, 0}}, end_mill(milling::CutterKind::ball, 8, 2, 20),
                      {straight({-10, 0, -1}, {60, 0, -1})}),
        serial_for);
    (void)milled.run({});
    session::InspectSource part(milled.stock(), {});
    const haptics::SafetyLimits limits = session::safety_limits(hand, 1000);
    haptics::Servo servo(hand, part, limits);
    Vec3 last;
    int violations = 0, ticks = 0;
    devices::ServoThread loop({1000, real_time, false}, [&](double now_s) {
        const haptics::ServoTick tick = servo.tick(now_s);
        const double rise = length(tick.force_n) - length(last);
        if (!is_finite(tick.force_n) || length(tick.force_n) > limits.max_force_n ||
            rise > limits.slew_n_per_ms * limits.tick_s * 1e3 + 1e-9)
            ++violations;
        last = tick.force_n;
        return ++ticks < 5000;
    });
    loop.join();
    over = true;
    for (std::thread& t : burners) t.join();
    const std::string how = real_time ? ", real-time class" : ", ordinary class";
    if (real_time && !loop.problems().real_time.empty()) report.note(loop.problems().real_time);
    const auto us = [](std::uint64_t ns) { return 1e-3 * static_cast<double>(ns); };
    report.add({"lateness p50" + how, us(loop.lateness().quantile_ns(0.5)), "us"});
    report.add({"lateness p99" + how, us(loop.lateness().quantile_ns(0.99)), "us"});
    report.add({"lateness p99.9" + how, us(loop.lateness().quantile_ns(0.999)), "us"});
    report.add({"lateness max" + how, us(loop.lateness().max_ns()), "us"});
    report.add({"tick, processor time, p99.9" + how, us(loop.clock().cpu().quantile_ns(0.999)), "us"});
    report.add({"ticks skipped" + how, static_cast<double>(loop.skipped()), ""});
    report.add({"safety violated" + how, static_cast<double>(violations), "times", 0});
}

}  // namespace

void measure_servo(Report& report) {
    const fs::path folder = fs::temp_directory_path() / ("tribo-bench-servo-" + std::to_string(::getpid()));
    fs::create_directories(folder);
    measure_tables(report, folder);
    fs::remove_all(folder);
    measure_grid(report);
    report.section("The loop at 1 kHz with every core busy");
    measure_load(report, false);
    measure_load(report, true);
}

}  // namespace tribo::bench
