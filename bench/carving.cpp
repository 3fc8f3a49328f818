// SPDX-License-Identifier: MIT
// What it costs to take cuts out of the stock, beside what memory alone would allow and beside OpenVDB.
#include <cstdio>

#include "cuts.hpp"
#include "harness.hpp"
#include "milling/sweep/sweep.hpp"
#include "motion/path/path.hpp"
#include "peers/openvdb_peer.hpp"

namespace tribo::bench {
namespace {

struct Carving {
    double us_per_mm = 0, bytes_per_mm = 0, removed_mm3 = 0;
};

// The median over passes, the slot left out.
Carving carve(const Cuts& cuts) {
    auto stock = block(cuts.block_mm);
    std::vector<double> us;
    double length = 0;
    const auto before = static_cast<double>(stock->bytes());
    for (const auto& moves : cuts.passes) {
        double mm = 0;
        const double start = thread_s();
        for (const motion::Move& move : moves) {
            stock->carve(milling::make_sweep(cuts.cutter, move));
            mm += motion::path_length_mm(move);
        }
        us.push_back(1e6 * (thread_s() - start) / mm);
        length += mm;
    }
    us.erase(us.begin());
    const double bytes = static_cast<double>(stock->bytes()) - before;
    return {median(us), bytes / length, stock->removed_mm3()};
}

// Megabytes per mm of this cut that any model must write (a float for each new surface sample), and that a
// tri-dexel model reads and writes in steps of 0.5 mm: (D + 2a) / d^2 and (D + a + D a / step) / d^2.
constexpr double kSamplesMb = (12 + 2 * 5) / (kCellMm * kCellMm) * 4e-6;
constexpr double kTriDexelMb = (12 + 5 + 12 * 5 / 0.5) / (kCellMm * kCellMm) * 2 * 16e-6;

std::string move_text(double mm) {
    char text[80];
    std::snprintf(text, sizeof text, "D12 flat, 5 mm deep, 0.1 mm, moves of %g mm", mm);
    return text;
}

}  // namespace

void measure_carving(Report& report, int repeats) {
    report.section("Cutting, one core");
    const double us = 1e6 * memory_s_per_mb();
    report.add({"bandwidth limit: new surface samples of this cut", kSamplesMb * us, "us/mm"});
    report.add({"bandwidth limit: tri-dexels of this cut", kTriDexelMb * us, "us/mm"});
    if (!has_openvdb()) report.note("OpenVDB is not installed (libopenvdb-dev): its columns are left out");
    struct Length {
        double mm;
        std::optional<double> goal;
        int peer_passes;
    };
    for (const Length& length : {Length{90, 100, 4}, {20, {}, 3}, {5, 200, 2}, {1, {}, 2}}) {
        const Cuts cuts = half_immersion(length.mm, 9);
        Carving carving;
        const double time = median_of(repeats, [&] {
            carving = carve(cuts);
            return carving.us_per_mm;
        });
        Entry speed{move_text(length.mm), time, "us/mm", length.goal};
        speed.peer_value = openvdb_us_per_mm(half_immersion(length.mm, length.peer_passes), kCellMm);
        if (speed.peer_value) speed.peer = "OpenVDB";
        report.add(speed);
        report.add({move_text(length.mm) + ", memory", carving.bytes_per_mm, "bytes/mm"});
    }
}

void measure_many_moves(Report& report, int repeats) {
    report.section("Many short moves: D6 flat, 1 mm deep, 0.5 mm each, 0.1 mm grid, one core");
    constexpr std::size_t kFew = 10'000, kMany = 100'000;
    const Cuts cuts = layers(kFew);
    report.add({"10,000 moves, stock only",
                median_of(repeats,
                          [&] {
                              auto stock = block(cuts.block_mm);
                              const double start = thread_s();
                              for (const auto& moves : cuts.passes) {
                                  for (const motion::Move& move : moves) {
                                      stock->carve(milling::make_sweep(cuts.cutter, move));
                                  }
                              }
                              return kFew / (thread_s() - start);
                          }),
                "moves/s", 10'000, Better::higher});
    std::vector<motion::Move> path;
    for (const auto& moves : cuts.passes) path.insert(path.end(), moves.begin(), moves.end());
    report.add({"10,000 moves with engagement, spectrum and peaks",
                median_of(repeats,
                          [&] {
                              session::MillSession session(session_setup(cuts.block_mm, cuts.cutter, path),
                                                           serial_for);
                              const double start = thread_s();
                              session.run({});
                              return kFew / (thread_s() - start);
                          }),
                "moves/s",
                {},
                Better::higher});

    auto stock = block(cuts.block_mm);
    std::vector<double> done;  // thread seconds after each percent of the moves
    std::size_t count = 0;
    const double start = thread_s();
    for (const auto& moves : layers(kMany).passes) {
        for (const motion::Move& move : moves) {
            stock->carve(milling::make_sweep(cuts.cutter, move));
            if (++count % (kMany / 100) == 0) done.push_back(thread_s() - start);
        }
    }
    // Medians over percents: what else the machine does meanwhile stays out.
    std::vector<double> first, last;
    for (std::size_t n = 1; n < 20; ++n) {
        first.push_back(done[n] - done[n - 1]);
        last.push_back(done[80 + n] - done[80 + n - 1]);
    }
    report.add({"100,000 moves, time per move", 1e6 * done.back() / kMany, "us"});
    report.add({"100,000 moves, last 20 % over first 20 %", median(last) / median(first), "", 1.2});
}

}  // namespace tribo::bench
