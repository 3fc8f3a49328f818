// SPDX-License-Identifier: MIT
// `tribo render` from outside: which files come out, what is refused, what a killed run leaves.
#include <csignal>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <set>

#include "app/run/program.hpp"
#include "app/run/small_inputs.hpp"

namespace tribo::test {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

class Render : public ::testing::Test {
  protected:
    Render() : folder_(scratch_.path()) {
        write(folder_ / "slot.toml", kSlotJob);
        write(folder_ / "slot.nc", kSlotProgram);
    }
    // Without the list of the run.
    std::set<std::string> files_in(const std::string& name) const {
        std::set<std::string> names;
        for (const auto& entry : fs::directory_iterator(folder_ / name))
            names.insert(entry.path().filename());
        names.erase(".tribo-files");
        return names;
    }
    Outcome render(std::vector<std::string> more) const {
        std::vector<std::string> arguments{"render", "slot.toml"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_tribo(arguments, folder_.string());
    }
    Scratch scratch_;
    fs::path folder_;
};

TEST_F(Render, writes_every_file_that_the_page_promises) {
    const Outcome run = render({"--out", "out"});
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(files_in("out"), (std::set<std::string>{"summary.json", "forces.csv", "machined.glb",
                                                      "machined.stl", "sound.wav", "report.html"}));
    EXPECT_NE(run.out.find("removed"), std::string::npos);
}

TEST_F(Render, writes_only_what_is_asked_for_and_the_summary) {
    ASSERT_EQ(render({"--out", "a", "--only", "summary"}).code, 0);
    EXPECT_EQ(files_in("a"), std::set<std::string>{"summary.json"});
    ASSERT_EQ(render({"--out", "b", "--only", "forces,sound", "--as-published"}).code, 0);
    EXPECT_EQ(files_in("b"),
              (std::set<std::string>{"summary.json", "forces.csv", "published_forces.csv", "sound.wav"}));
}

TEST_F(Render, replaces_the_files_of_an_older_run_and_no_other) {
    ASSERT_EQ(render({"--out", "out"}).code, 0);
    write(folder_ / "out" / "notes.txt", "try 8000 rpm");
    ASSERT_EQ(render({"--out", "out", "--only", "summary"}).code, 0);
    EXPECT_EQ(files_in("out"), (std::set<std::string>{"summary.json", "notes.txt"}));
    // A file of the user's that a render may write is never replaced.
    write(folder_ / "out" / "machined.stl", "mine");
    const Outcome refused = render({"--out", "out"});
    EXPECT_EQ(refused.code, 2);
    EXPECT_NE(refused.err.find("out/machined.stl"), std::string::npos) << refused.err;
    EXPECT_EQ(files_in("out"), (std::set<std::string>{"summary.json", "notes.txt", "machined.stl"}));
    // A copied summary makes no folder one of Tribo's.
    fs::create_directory(folder_ / "thesis");
    fs::copy(folder_ / "out" / "summary.json", folder_ / "thesis" / "summary.json");
    EXPECT_EQ(render({"--out", "thesis"}).code, 2);
    fs::create_directory(folder_ / "mine");
    write(folder_ / "mine" / "letter.txt", "dear");
    EXPECT_EQ(render({"--out", "mine"}).code, 2);
    EXPECT_EQ(files_in("mine"), std::set<std::string>{"letter.txt"});
}

TEST_F(Render, refuses_more_memory_than_allowed_and_names_a_resolution_that_fits) {
    const Outcome run = render({"--out", "out", "--resolution", "0.01", "--memory", "200"});
    EXPECT_EQ(run.code, 2);
    EXPECT_NE(run.err.find("try --resolution"), std::string::npos) << run.err;
    EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(Render, names_the_line_of_what_it_cannot_mill) {
    write(folder_ / "slot.nc", "G21 G90\nG0 X0 Y0 Z0 A30\nG1 X10\n");
    const Outcome run = render({"--out", "out"});
    EXPECT_EQ(run.code, 2);
    EXPECT_NE(run.err.find("slot.nc:2"), std::string::npos) << run.err;
    EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(Render, stopped_by_the_user_leaves_nothing) {
    const Outcome run = run_tribo({"render", "slot.toml", "--out", "out", "--resolution", "0.02"},
                                  folder_.string(), 150, SIGTERM);
    if (run.code == 0) GTEST_SKIP() << "done before the signal came";
    EXPECT_EQ(run.code, 128 + SIGTERM);
    for (const auto& entry : fs::directory_iterator(folder_)) {
        EXPECT_EQ(entry.path().filename().string().find("tribo-partial"), std::string::npos);
    }
    EXPECT_FALSE(fs::exists(folder_ / "out"));
}

}  // namespace
}  // namespace tribo::test
