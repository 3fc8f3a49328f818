// SPDX-License-Identifier: MIT
// Milling with engagement and forces as sessions do it: many short moves, turning axes, threads, WebAssembly.
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>

#include "base/math.hpp"
#include "cuts.hpp"
#include "golden/golden.hpp"
#include "harness.hpp"
#include "tribo/threads.hpp"

namespace tribo::bench {
namespace {

// Ball finishing of a wavy floor: D6, 0.4 mm aside, moves of 0.1 mm, at 0.2 mm.
std::vector<motion::Move> ball_finishing(std::size_t moves, double length_mm) {
    std::vector<Vec3> tips;
    for (int pass = 0; tips.size() <= moves; ++pass) {
        const double y = 0.2 + 0.4 * pass;
        const int count = static_cast<int>(length_mm / 0.1);
        for (int n = 0; n <= count && tips.size() <= moves; ++n) {
            const double along = 0.1 * n, x = pass % 2 == 0 ? along : length_mm - along;
            tips.push_back({x, y, -1 - 0.5 * std::sin(0.15 * x) * std::cos(0.12 * y)});
        }
    }
    return moves_through(tips);
}

struct Cost {
    double processor_s = 0;
    double stock_mb = 0;  // in the end
};

Cost cost_of(session::MillSetup setup) {
    session::MillSession session(std::move(setup), serial_for);
    const double start = thread_s();
    session.run({});
    return {thread_s() - start, 1e-6 * static_cast<double>(session.stock().bytes())};
}

double processor_s(session::MillSetup setup) {
    return cost_of(std::move(setup)).processor_s;
}

// What memory allows at best: the stock as it is in the end, written once.
void add_over_limit(Report& report, const std::string& name, const Cost& cost) {
    report.add({name + ", over the bandwidth limit", cost.processor_s / (cost.stock_mb * memory_s_per_mb()),
                "times"});
}

// Passes over a block with the axis upright, or turning on through some degrees over each move.
std::vector<motion::Move> passes(double move_mm, double turn_deg) {
    std::vector<motion::Move> moves;
    const auto axis = [&](double share) {
        const double a = turn_deg * math::kTwoPi / 360 * (share - 0.5);
        return Vec3{std::sin(a), 0.1, std::cos(a)};
    };
    for (int n = 0; n < 6; ++n) {
        auto one = pass({0, 3.0 + 3 * n, -1.5}, {60, 3.0 + 3 * n, -1.5}, move_mm);
        if (turn_deg != 0) {
            for (std::size_t k = 0; k < one.size(); ++k) {
                const auto count = static_cast<double>(one.size());
                one[k].start.axis = normalized(axis(static_cast<double>(k) / count));
                one[k].end.axis = normalized(axis(static_cast<double>(k + 1) / count));
            }
        }
        moves.insert(moves.end(), one.begin(), one.end());
    }
    return moves;
}

void measure_five_axes(Report& report, int repeats) {
    const Box3 block_mm{{0, 0, -10}, {60, 21, 0}};
    for (const auto& [name, kind] :
         {std::pair{"ball", milling::CutterKind::ball}, {"flat", milling::CutterKind::flat}}) {
        const milling::Cutter cutter = end_mill(kind, 6, 2, 20);
        for (const double move_mm : {0.1, 0.5, 5.0}) {
            Cost five;
            const double ratio = median_of(repeats, [&] {
                five = cost_of(session_setup(block_mm, cutter, passes(move_mm, 20), 0.2));
                return five.processor_s /
                       processor_s(session_setup(block_mm, cutter, passes(move_mm, 0), 0.2));
            });
            char text[100];
            std::snprintf(text, sizeof text, "D6 %s, moves of %g mm", name, move_mm);
            report.add({std::string("five axes over three, ") + text, ratio, "", 3});
            add_over_limit(report, std::string("five axes, ") + text, five);
        }
    }
}

void measure_threads(Report& report, int repeats) {
    const FinishingJob job;
    auto moves = moves_through(job.tips);
    const auto wall = [&](int threads) {
        return median_of(repeats, [&] {
            session::MillSession session(session_setup(job.block_mm, job.cutter, moves),
                                         parallel_for_over(threads));
            const double start = wall_s();
            session.run({});
            return wall_s() - start;
        });
    };
    const double one = wall(1);
    report.add({"finishing job, 1 thread over 2", one / wall(2), "", 1.9, Better::higher});
    if (available_threads() >= 4)
        report.add({"finishing job, 1 thread over 4", one / wall(4), "", 3.5, Better::higher});
}

void measure_webassembly(Report& report) {
    const std::string folder = TRIBO_SOURCE_DIR "/build/wasm";
    if (!std::ifstream(folder + "/golden.wasm")) {
        report.note("no build/wasm/golden.wasm (make test makes it): WebAssembly is left out");
        return;
    }
    const std::string command =
        "node '" TRIBO_SOURCE_DIR "/bench/golden_speed.mjs' '" + folder + "' mill_three_axes mill_five_axes";
    FILE* pipe = popen(command.c_str(), "r");
    char name[64];
    double ms = 0;
    bool any = false;
    while (pipe && std::fscanf(pipe, "%63s %lf", name, &ms) == 2) {
        for (const golden::Golden& line : golden::goldens()) {
            if (std::strcmp(line.name, name) != 0) continue;
            any = true;
            const double native = median_of(9, [&] {
                const double start = thread_s();
                keep(line.hash());
                return 1e3 * (thread_s() - start);
            });
            report.add({std::string("WebAssembly over native, ") + name, ms / native, "", 1.6});
        }
    }
    if (pipe) pclose(pipe);
    if (!any) report.note("node did not run bench/golden_speed.mjs: WebAssembly is left out");
}

}  // namespace

void measure_milling(Report& report, int repeats) {
    report.section("Milling with engagement and forces, processor time of one core");
    constexpr std::size_t kMoves = 10'000;
    Cost ball;
    ball.processor_s = median_of(repeats, [&] {
        const Cost once =
            cost_of(session_setup({{0, 0, -10}, {50, 50, 0}}, end_mill(milling::CutterKind::ball, 6, 2, 12),
                                  ball_finishing(kMoves, 50), 0.2));
        ball.stock_mb = once.stock_mb;
        return once.processor_s;
    });
    report.add({"a million ball finishing moves, from 10,000", ball.processor_s * 1e6 / kMoves, "s", 60});
    add_over_limit(report, "ball finishing moves", ball);
    measure_five_axes(report, repeats);
    measure_threads(report, repeats);
    measure_webassembly(report);
}

}  // namespace tribo::bench
