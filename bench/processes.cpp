// SPDX-License-Identifier: MIT
// The finishing job as a user runs it: tribo render, from start to exit.
#include <filesystem>
#include <fstream>

#include "child.hpp"
#include "cuts.hpp"
#include "harness.hpp"

namespace tribo::bench {
namespace {

namespace fs = std::filesystem;

// examples/bowl with a mode along x and one along y, and without: what chatter costs along a program. In
// turn, so that both meet the same load.
void measure_modes(Report& report, int repeats, const fs::path& folder) {
    const fs::path bowl = folder / "bowl";
    std::error_code failed;
    fs::copy(TRIBO_SOURCE_DIR "/examples/bowl", bowl, failed);
    if (failed) return report.note("examples/bowl is not there: left out");
    const std::string rigid = bowl / "bowl.toml", bends = bowl / "bends.toml";
    fs::copy_file(rigid, bends, failed);
    for (const char* mode : {"[1, 0, 0]\nfrequency_hz = 922", "[0, 1, 0]\nfrequency_hz = 950"})
        std::ofstream(bends, std::ios::app)
            << "\n[[mode]]\ndirection = " << mode << "\ndamping_ratio = 0.011\nstiffness_n_per_mm = 13400\n";
    std::vector<double> seconds, ratios, processor;
    for (int n = 0; n < repeats; ++n) {
        const auto cost = [&](const std::string& job) {
            return run(TRIBO_PROGRAM, {"render", job, "--out", folder / "out", "--only", "summary"},
                       folder / "log.txt");
        };
        const auto without = cost(rigid), with = cost(bends);
        if (!without || !with) return report.note("tribo render failed: left out");
        seconds.push_back(with->seconds);
        ratios.push_back(with->seconds / without->seconds);
        processor.push_back(with->processor_s / without->processor_s);
    }
    report.add({"examples/bowl with two modes, --only summary", median(seconds), "s"});
    report.add({"the same over that without modes", median(ratios), "times", 1.3});
    report.add({"the same, processor time", median(processor), "times"});
}

}  // namespace

// Comes first: a child's peak memory starts from what this process holds at the fork.
void measure_processes(Report& report, int repeats) {
    report.section("Finishing job as a process on 2 processors: 16,121 moves, 8.5 m, D1 flat, 0.1 mm grid");
    const TemporaryFolder folder;
    if (folder.path().empty()) {
        report.note("no temporary folder: left out");
        return;
    }
    const std::string job = folder.path() / "job.toml", out = folder.path() / "out",
                      log = folder.path() / "log.txt";
    {
        const FinishingJob finishing;
        std::ofstream(folder.path() / "path.nc") << finishing.gcode();
        std::ofstream(job) << finishing.toml("path.nc");
    }
    struct Goal {
        const char* name;
        std::string job, resolution, only;
        double seconds, megabytes;
    };
    const std::string rose = TRIBO_SOURCE_DIR "/examples/rose/rose.toml";
    for (const Goal& goal :
         {Goal{"tribo render --only summary", job, "0.1", "summary", 0.4, 100},
          {"tribo render --only mesh", job, "0.1", "mesh", 2.5, 250},
          {"examples/rose at 0.02 mm, --only summary", rose, "0.02", "summary", 10, 500}}) {
        std::vector<double> wall, processor, peak;
        for (int n = 0; n < repeats; ++n) {
            const auto cost =
                run(TRIBO_PROGRAM,
                    {"render", goal.job, "--out", out, "--resolution", goal.resolution, "--only", goal.only},
                    log);
            if (!cost) {
                report.note("tribo render failed: left out; it said:");
                std::ifstream said(log);
                for (std::string line; std::getline(said, line);) report.note(line);
                return;
            }
            wall.push_back(cost->seconds);
            processor.push_back(cost->processor_s);
            peak.push_back(cost->peak_mb);
        }
        const std::string name = goal.name;
        Entry seconds{name, median(wall), "s", goal.seconds};
        Entry memory{name + ", peak memory", median(peak), "MB", goal.megabytes};
        if (goal.only == "mesh") {
            // Measured once on a part of this kind, mesh written; it is not run here.
            seconds.peer = memory.peer = "CAMotics";
            seconds.peer_value = 35;
            memory.peer_value = 4500;
        }
        report.add(seconds);
        report.add({name + ", processor time", median(processor), "s"});
        report.add(memory);
        report.add({name + ", processor time over the bandwidth limit",
                    median(processor) / (median(peak) * memory_s_per_mb()), "times"});
    }
    measure_modes(report, repeats, folder.path());
}

}  // namespace tribo::bench
