// SPDX-License-Identifier: MIT
// The finishing job as a user runs it: tribo render, from start to exit.
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sched.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cuts.hpp"
#include "harness.hpp"

namespace tribo::bench {
namespace {

namespace fs = std::filesystem;

// The first `most` of the processors that this process may use.
void keep_to_processors(int most) {
    cpu_set_t allowed, chosen;
    CPU_ZERO(&chosen);
    if (sched_getaffinity(0, sizeof allowed, &allowed) != 0) return;
    for (int n = 0; n < CPU_SETSIZE && CPU_COUNT(&chosen) < most; ++n) {
        if (CPU_ISSET(n, &allowed)) CPU_SET(n, &chosen);
    }
    sched_setaffinity(0, sizeof chosen, &chosen);
}

struct Cost {
    double seconds = 0, processor_s = 0, peak_mb = 0;
};

// Nothing when the program failed; `log` then says why.
std::optional<Cost> run(const std::string& program, const std::vector<std::string>& arguments,
                        const std::string& log) {
    std::vector<char*> argv{const_cast<char*>(program.c_str())};
    for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
    argv.push_back(nullptr);
    const double start = wall_s();
    const pid_t child = fork();
    if (child == 0) {
        keep_to_processors(2);
        const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
        dup2(file, STDOUT_FILENO);
        dup2(file, STDERR_FILENO);
        execv(program.c_str(), argv.data());
        std::perror(program.c_str());
        _exit(127);
    }
    int status = 0;
    rusage used{};
    if (child < 0 || wait4(child, &status, 0, &used) < 0 || !WIFEXITED(status) || WEXITSTATUS(status) != 0) {
        return {};
    }
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return Cost{wall_s() - start, seconds(used.ru_utime) + seconds(used.ru_stime),
                static_cast<double>(used.ru_maxrss) * 1024e-6};
}

class TemporaryFolder {
  public:
    TemporaryFolder() {
        std::string name = (fs::temp_directory_path() / "tribo-bench-XXXXXX").string();
        if (mkdtemp(name.data())) path_ = name;
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder() {
        std::error_code ignored;
        if (!path_.empty()) fs::remove_all(path_, ignored);
    }
    const fs::path& path() const { return path_; }

  private:
    fs::path path_;
};

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
