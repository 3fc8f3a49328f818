// SPDX-License-Identifier: MIT
// `tribo sweep` on this machine: results, resuming, bad input.
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <set>
#include <signal.h>
#include <sstream>
#include <sys/mount.h>
#include <thread>

#include "app/run/job_folder.hpp"
#include "app/run/small_inputs.hpp"

namespace tribo::test {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

// Rows of results.csv by column, as text. No field here holds a comma.
using Rows = std::vector<std::map<std::string, std::string>>;

Rows rows_of(const std::string& csv) {
    Rows rows;
    std::vector<std::string> names;
    std::istringstream in(csv);
    for (std::string line; std::getline(in, line);) {
        std::vector<std::string> fields;
        std::istringstream cells(line + ",");
        for (std::string cell; std::getline(cells, cell, ',');) fields.push_back(cell);
        if (names.empty()) {
            names = fields;
            continue;
        }
        auto& row = rows.emplace_back();
        for (std::size_t n = 0; n < std::min(names.size(), fields.size()); ++n) row[names[n]] = fields[n];
    }
    return rows;
}

class Sweep : public testing::Test {
  protected:
    Sweep() {
        folder_.put("job.toml", kSlotJob);
        folder_.put("slot.nc", kSlotProgram);
        folder_.put("sweep.toml", R"(base = "job.toml"
resolution_mm = 1
[axes]
process.spindle_rpm = [6000, 8000, 10000]
cutter.runout_mm = [0, 0.01]
)");
    }
    Outcome sweep(std::vector<std::string> more = {"--out", "cases_of"},
                  const std::string& file = "sweep.toml") const {
        more.insert(more.begin(), {"sweep", file});
        return run_tribo(more, folder_.path());
    }
    Rows results(const std::string& folder = "cases_of") const {
        return rows_of(folder_.file(folder + "/results.csv"));
    }
    // Every finished case on the disk, with how often.
    std::map<std::string, int> lines(const std::string& folder = "cases_of") const {
        std::map<std::string, int> lines;
        for (const auto& entry : fs::directory_iterator(folder_.path() + "/" + folder + "/cases")) {
            std::ifstream in(entry.path());
            for (std::string line; std::getline(in, line);) ++lines[line];
        }
        return lines;
    }
    std::string path(const std::string& name) const { return folder_.path() + "/" + name; }

    JobFolder folder_;
};

TEST_F(Sweep, gives_what_a_render_of_each_case_gives) {
    const Outcome run = sweep();
    ASSERT_EQ(run.code, 0) << run.err;
    const Rows rows = results();
    ASSERT_EQ(rows.size(), 6u);
    std::string job = kSlotJob;
    job.replace(job.find("6000"), 4, "8000");
    job.replace(job.find("length_mm"), 0, "runout_mm = 0.01\n");
    folder_.put("job.toml", job);
    ASSERT_EQ(folder_.render({"--resolution", "1", "--only", "summary"}).code, 0);
    const auto summary = folder_.summary();
    const auto& row = rows[3];
    EXPECT_EQ(row.at("case"), "3");
    EXPECT_EQ(row.at("process.spindle_rpm"), "8000");
    EXPECT_EQ(row.at("cutter.runout_mm"), "0.01");
    for (const char* name : {"duration_s", "removed_mm3", "mean_force_n", "peak_force_n", "peak_torque_nm",
                             "peak_power_w", "work_j", "energy_balance", "tooth_passing_hz"})
        EXPECT_EQ(std::stod(row.at(name)), summary[name].get<double>()) << name;
}

TEST_F(Sweep, gives_the_loads_of_an_audit) {
    folder_.put("sweep.toml",
                "base = \"job.toml\"\nresolution_mm = 1\ncompute = [\"audit\"]\n[axes]\n"
                "limits.force_n = [100, 200]\n");
    folder_.put("modes.toml", "base = \"job.toml\"\ncompute = \"stability\"\n");
    const Outcome run = sweep();
    ASSERT_EQ(run.code, 0) << run.err;
    const Rows rows = results();
    ASSERT_EQ(rows.size(), 2u);
    const double peak_n = std::stod(rows[0].at("peak_force_n"));
    EXPECT_NEAR(std::stod(rows[0].at("force_ratio")), peak_n / 100, 1e-9 * peak_n);
    EXPECT_NEAR(std::stod(rows[1].at("force_ratio")), peak_n / 200, 1e-9 * peak_n);
    // A job without modes has no stability: that is its result.
    ASSERT_EQ(sweep({"--out", "stability"}, "modes.toml").code, 0);
    EXPECT_NE(folder_.file("stability/results.csv").find("mode"), std::string::npos);
}

TEST_F(Sweep, never_computes_a_finished_case_again) {
    ASSERT_EQ(sweep().code, 0);
    const auto before = lines();
    const std::string csv = folder_.file("cases_of/results.csv");
    const Outcome again = sweep();
    EXPECT_NE(again.out.find("0 of them new"), std::string::npos) << again.out;
    EXPECT_EQ(lines(), before);
    EXPECT_EQ(folder_.file("cases_of/results.csv"), csv);
    // More values: only their cases are new.
    std::string more = folder_.file("sweep.toml");
    more.replace(more.find("10000"), 5, "10000, 12000");
    folder_.put("sweep.toml", more);
    EXPECT_NE(sweep().out.find("8, 2 of them new"), std::string::npos);
    EXPECT_EQ(results().size(), 8u);
    // A file that a case reads has other bytes: its cases are others.
    folder_.put("slot.nc", std::string(kSlotProgram) + "(a comment)\n");
    EXPECT_NE(sweep().out.find("8, 8 of them new"), std::string::npos);
    for (const auto& [line, count] : lines()) EXPECT_EQ(count, 1) << line;
}

TEST_F(Sweep, gives_the_same_rows_with_any_number_of_workers) {
    ASSERT_EQ(sweep({"--out", "one", "--workers", "1"}).code, 0);
    ASSERT_EQ(sweep({"--out", "three", "--workers", "3"}).code, 0);
    EXPECT_EQ(folder_.file("one/results.csv"), folder_.file("three/results.csv"));
}

// Kills the run, workers too, once some cases are finished, as often as it takes.
TEST_F(Sweep, goes_on_after_it_was_killed) {
    folder_.put("many.toml", R"(base = "job.toml"
resolution_mm = 0.5
[axes]
process.spindle_rpm = {from = 5000, to = 9900, step = 100}
)");
    ASSERT_EQ(sweep({"--out", "whole"}, "many.toml").code, 0);
    const auto finished = [&] { return fs::exists(path("killed/cases")) ? lines("killed").size() : 0; };
    int kills = 0;
    for (std::size_t least = 1; least < 40 && kills < 3; least += 12) {
        const std::size_t before = finished();
        RunningTribo run({"sweep", "many.toml", "--out", "killed"}, folder_.path());
        for (int n = 0; n < 3000 && finished() < before + 4; ++n) std::this_thread::sleep_for(5ms);
        run.stop(SIGKILL);
        ++kills;
    }
    // Half a line at the end of a file, as a killed writer leaves it.
    for (const auto& entry : fs::directory_iterator(path("killed/cases"))) {
        std::ofstream(entry.path(), std::ios::app) << R"({"id":"00112233445566778899aabbccddeeff","val)";
        break;
    }
    // Workers of the killed run end by themselves: nobody gives them cases.
    Outcome last;
    for (int n = 0; n < 100; ++n) {
        last = sweep({"--out", "killed"}, "many.toml");
        if (last.code == 0) break;
        std::this_thread::sleep_for(100ms);
    }
    ASSERT_EQ(last.code, 0) << last.err;
    EXPECT_EQ(folder_.file("killed/results.csv"), folder_.file("whole/results.csv"));
    EXPECT_EQ(results("killed").size(), 50u);
}

TEST_F(Sweep, ends_on_ctrl_c_and_keeps_what_is_finished) {
    folder_.put("many.toml", R"(base = "job.toml"
resolution_mm = 0.25
[axes]
process.spindle_rpm = {from = 5000, to = 15000, step = 10}
)");
    RunningTribo run({"sweep", "many.toml", "--out", "cases_of"}, folder_.path());
    const auto finished = [&] { return fs::exists(path("cases_of/cases")) ? lines().size() : 0; };
    for (int n = 0; n < 3000 && finished() < 2; ++n) std::this_thread::sleep_for(5ms);
    EXPECT_EQ(run.stop(SIGINT).code, 130);
    EXPECT_FALSE(fs::exists(path("cases_of/results.csv")));
    const Outcome status = sweep({"--out", "cases_of", "--status"}, "many.toml");
    EXPECT_EQ(status.code, 0);
    EXPECT_EQ(status.out.find("finished         0"), std::string::npos) << status.out;
}

TEST_F(Sweep, gives_a_case_that_fails_its_reason) {
    folder_.put("sweep.toml", R"(base = "job.toml"
resolution_mm = 1
[axes]
cutter.diameter_mm = [6, -1, 8]
path.gcode = ["slot.nc", "gone.nc"]
)");
    const Outcome run = sweep();
    EXPECT_EQ(run.code, 0) << run.err;
    const Rows rows = results();
    ASSERT_EQ(rows.size(), 6u);
    EXPECT_EQ(rows[0].at("error"), "");
    EXPECT_NE(folder_.file("cases_of/results.csv").find("gone.nc"), std::string::npos);
    EXPECT_NE(folder_.file("cases_of/results.csv").find("diameter_mm"), std::string::npos);
    const std::string page = folder_.file("cases_of/report.html");
    EXPECT_NE(page.find("Cases without a result"), std::string::npos);
    EXPECT_NE(run.out.find("no result        4"), std::string::npos) << run.out;
}

TEST_F(Sweep, tells_which_input_matters) {
    folder_.put("sweep.toml", R"(base = "job.toml"
resolution_mm = 2
[axes]
process.feed_mm_per_min = {uniform = [600, 1200]}
cutter.helix_deg = {uniform = [29.99, 30.01]}
[sample]
design = "sobol"
n = 8
)");
    ASSERT_EQ(sweep().code, 0);
    EXPECT_EQ(results().size(), 32u);
    const std::string page = folder_.file("cases_of/report.html");
    const std::size_t peak = page.find("<h3>peak_force_n</h3>");
    ASSERT_NE(peak, std::string::npos);
    EXPECT_LT(page.find("process.feed_mm_per_min", peak), page.find("cutter.helix_deg", peak));
}

TEST_F(Sweep, takes_a_folder_of_programs) {
    fs::create_directory(path("programs"));
    folder_.put("programs/b.nc", "G21 G90\nG0 X-5 Y10 Z-3\nG1 X35\nM30\n");
    folder_.put("programs/a.nc", kSlotProgram);
    folder_.put("programs/notes.pdf", "%PDF-1.4\n");
    folder_.put("sweep.toml", "base = \"job.toml\"\nprograms = \"programs\"\nresolution_mm = 1\n");
    const Outcome run = sweep();
    ASSERT_EQ(run.code, 0) << run.err;
    const Rows rows = results();
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_TRUE(rows[0].at("program").ends_with("a.nc"));
    EXPECT_NEAR(std::stod(rows[1].at("removed_mm3")) / std::stod(rows[0].at("removed_mm3")), 1.5, 1e-3);
}

TEST_F(Sweep, runs_one_case_alone_and_foretells_all) {
    const Outcome one = sweep({"--case", "4"});
    EXPECT_EQ(one.code, 0) << one.err;
    EXPECT_NE(one.out.find("process.spindle_rpm 10000"), std::string::npos) << one.out;
    EXPECT_NE(one.out.find("peak_force_n"), std::string::npos);
    EXPECT_EQ(sweep({"--case", "6"}).code, 2);
    const Outcome foretold = sweep({"--dry-run"});
    EXPECT_EQ(foretold.code, 0);
    EXPECT_NE(foretold.out.find("6, of which 6 have no result"), std::string::npos) << foretold.out;
    EXPECT_FALSE(fs::exists(path("cases_of")));
}

// The disk is full in the middle, then wide enough, then read-only.
TEST_F(Sweep, loses_nothing_on_a_full_disk_and_says_what_is_wrong) {
    fs::create_directory(path("disk"));
    const std::string disk = path("disk");
    const auto mount = [&](unsigned long flags, const char* options) {
        return ::mount("tmpfs", disk.c_str(), "tmpfs", flags, options) == 0;
    };
    if (!mount(0, "size=16k")) GTEST_SKIP() << "only root may mount a small disk";
    folder_.put("many.toml", R"(base = "job.toml"
resolution_mm = 1
[axes]
process.spindle_rpm = {from = 5000, to = 8900, step = 100}
)");
    const Outcome full = sweep({"--out", "disk/o"}, "many.toml");
    EXPECT_EQ(full.code, 3);
    EXPECT_NE(full.err.find("No space left on device; free some space"), std::string::npos) << full.err;
    std::set<std::string> finished;
    for (const auto& [line, times] : lines("disk/o"))
        if (line.ends_with('}')) finished.insert(line);
    EXPECT_LT(finished.size(), 40u);

    ASSERT_TRUE(mount(MS_REMOUNT, "size=4m"));
    const Outcome wide = sweep({"--out", "disk/o"}, "many.toml");
    EXPECT_EQ(wide.code, 0) << wide.err;
    EXPECT_EQ(results("disk/o").size(), 40u);
    auto all = lines("disk/o");
    std::erase_if(all, [](const auto& line) { return !line.first.ends_with('}'); });
    EXPECT_EQ(all.size(), 40u);
    for (const std::string& line : finished) EXPECT_EQ(all.at(line), 1) << line;

    ASSERT_TRUE(mount(MS_REMOUNT | MS_RDONLY, "size=4m"));
    const Outcome read_only = sweep({"--out", "disk/p"}, "many.toml");
    EXPECT_EQ(read_only.code, 3);
    EXPECT_NE(read_only.err.find("Read-only file system; try a place that can be written to"),
              std::string::npos)
        << read_only.err;
    EXPECT_EQ(::umount(disk.c_str()), 0);
}

TEST_F(Sweep, refuses_what_cannot_be_run) {
    const auto refused = [&](const std::vector<std::string>& call, int code, const std::string& says,
                             const std::string& file = "sweep.toml") {
        const Outcome run = sweep(call, file);
        EXPECT_EQ(run.code, code) << says;
        EXPECT_NE(run.err.find(says), std::string::npos) << run.err;
    };
    refused({}, 2, "add --out DIR");
    refused({"--out", "o"}, 2, "No such file", "gone.toml");
    folder_.put("wrong.toml", "base = \"job.toml\"\n[axes]\na.b = []\n");
    refused({"--out", "o"}, 2, "wrong.toml:3", "wrong.toml");
    fs::create_directory(path("mine"));
    folder_.put("mine/notes.txt", "mine");
    refused({"--out", "mine"}, 2, "holds something");
    EXPECT_EQ(folder_.file("mine/notes.txt"), "mine");
    refused({"--out", "job.toml"}, 2, "is no folder");
    refused({"--out", "o", "--workers", "0"}, 2, "--workers");
}

}  // namespace
}  // namespace tribo::test
