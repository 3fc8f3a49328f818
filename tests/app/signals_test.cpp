// SPDX-License-Identifier: MIT
// SIGINT, SIGTERM and SIGHUP end every verb soon, also where it waits for a pipe, and nothing is left.
#include <algorithm>
#include <array>
#include <chrono>
#include <fcntl.h>
#include <filesystem>
#include <gtest/gtest.h>
#include <map>
#include <signal.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

#include "app/run/program.hpp"
#include "app/run/small_inputs.hpp"

namespace tribo::test {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// The promise is a second; a loaded machine and sanitizers take more. Without the promise: for ever.
constexpr auto kSoon = std::chrono::seconds(10);
constexpr auto kUnderWay = std::chrono::milliseconds(400);
// How soon a run begins to write is not promised: the thread sanitizer prepares a listener's head for 10 s.
constexpr auto kFirstFile = std::chrono::minutes(1);
constexpr auto kLook = std::chrono::milliseconds(1);

class Signals : public testing::Test {
  protected:
    Signals() {
        scratch.put("slot.toml", kSlotJob);
        scratch.put("slot.nc", kSlotProgram);
        scratch.put("m.json", kVoicedMaterial);
        scratch.put("rub.csv", "t_s,x_mm,y_mm,force_n\n0,0,0,1\n1,100,0,1\n");
        scratch.put("feel.csv", "t_s,x_mm,y_mm,z_mm\n0,12,10,1\n0.1,12,10,-2\n");
        EXPECT_EQ(::mkfifo((scratch / "pipe").c_str(), 0600), 0);
        // The ending tells what kind of file is expected.
        EXPECT_EQ(::symlink("pipe", (scratch / "pipe.toml").c_str()), 0);
        EXPECT_EQ(::symlink("pipe", (scratch / "pipe.wav").c_str()), 0);
        before = names();
    }
    std::map<std::string, std::uintmax_t> names() const {
        std::map<std::string, std::uintmax_t> all;
        for (const auto& entry : fs::recursive_directory_iterator(scratch.path()))
            all[entry.path().string()] = entry.is_regular_file() ? entry.file_size() : 0;
        return all;
    }
    void expect_end(const std::vector<std::string>& arguments, int signal) const {
        RunningTribo run(arguments, scratch.path());
        std::this_thread::sleep_for(kUnderWay);
        expect_end(run, arguments[0], signal);
    }
    // The signal comes so long after the first thing that the run makes.
    void expect_end_of_writing(const std::vector<std::string>& arguments, int signal,
                               std::chrono::milliseconds after) const {
        RunningTribo run(arguments, scratch.path());
        const auto give_up = Clock::now() + kFirstFile;
        while (!makes_something() && Clock::now() < give_up) std::this_thread::sleep_for(kLook);
        EXPECT_TRUE(makes_something()) << arguments[0];
        std::this_thread::sleep_for(after);
        expect_end(run, arguments[0], signal);
    }
    void expect_end(RunningTribo& run, const std::string& verb, int signal) const {
        const auto begin = Clock::now();
        const Outcome outcome = run.stop(signal);
        EXPECT_LT(Clock::now() - begin, kSoon) << verb;
        EXPECT_EQ(outcome.code, 128 + signal) << verb << ": " << outcome.err;
        EXPECT_EQ(names(), before) << verb;
    }
    bool makes_something() const {
        return std::ranges::any_of(fs::directory_iterator(scratch.path()), [&](const auto& entry) {
            return !before.contains(entry.path().string());
        });
    }
    Scratch scratch;
    std::map<std::string, std::uintmax_t> before;
};

TEST_F(Signals, end_every_verb_that_waits_for_its_input) {
    const std::vector<std::vector<std::string>> calls{
        {"render", "pipe.toml", "--out", "out"},
        {"render", "pipe", "--out", "out"},
        {"inspect", "pipe"},
        {"learn", "--recording", "100:pipe.wav", "--out", "new.json"},
        {"rub", "pipe", "--stroke", "rub.csv", "--out", "new.wav"},
        {"rub", "m.json", "--stroke", "pipe", "--out", "new.wav"},
        {"feel", "slot.toml", "--stroke", "pipe", "--out", "new.csv"},
        {"feel", "pipe.toml", "--stroke", "feel.csv", "--out", "new.csv"},
        {"press", "m.json", "--stroke", "pipe", "--out", "out"},
    };
    int n = 0;
    constexpr std::array kSignals{SIGINT, SIGTERM, SIGHUP};
    for (const auto& call : calls) expect_end(call, kSignals[static_cast<std::size_t>(n++ % 3)]);
}

TEST_F(Signals, end_every_verb_that_waits_for_the_reader_of_its_output) {
    expect_end({"rub", "m.json", "--stroke", "rub.csv", "--out", "pipe"}, SIGTERM);
    expect_end({"inspect", "slot.nc", "--picture", "pipe"}, SIGINT);
    expect_end({"feel", "slot.toml", "--stroke", "feel.csv", "--out", "pipe"}, SIGHUP);
    expect_end({"feel", "slot.toml", "--stroke", "feel.csv", "--out", "pipe", "--stats", "s"}, SIGINT);
}

TEST_F(Signals, leave_nothing_of_half_written_files_and_folders) {
    // Seven hours of sound, and a cut and a press of a minute at least on any machine.
    scratch.put("long_rub.csv", "t_s,x_mm,y_mm,force_n\n0,0,0,1\n25200,900000,0,1\n");
    scratch.put("press.csv", "t_s,x_mm,y_mm,force_n\n0,0,0,1\n3600,360000,0,1\n");
    std::string program = "G21 G90\nG0 X-5 Y10 Z0\n";
    for (int n = 0; n < 3'000; ++n) {
        program += "G1 X" + std::to_string(35 - 40 * (n % 2)) + " Y" + std::to_string(n % 20) + " Z-" +
                   std::to_string(0.001 * n) + "\n";
    }
    scratch.put("slot.nc", program + "M30\n");
    before = names();
    for (const auto after : {std::chrono::milliseconds(0), kUnderWay}) {
        expect_end_of_writing({"rub", "m.json", "--stroke", "long_rub.csv", "--out", "new.wav"}, SIGINT,
                              after);
        expect_end_of_writing({"render", "slot.toml", "--out", "new/out", "--resolution", "0.1"}, SIGTERM,
                              after);
        expect_end_of_writing({"press", "m.json", "--stroke", "press.csv", "--out", "new/out", "--fps", "20"},
                              SIGHUP, after);
    }
}

TEST_F(Signals, second_one_leaves_the_exit_code_to_the_first) {
    RunningTribo run({"inspect", "pipe"}, scratch.path());
    std::this_thread::sleep_for(kUnderWay);
    ::kill(run.pid(), SIGTERM);
    // Of two that wait together the system delivers either first.
    std::this_thread::sleep_for(kUnderWay / 2);
    EXPECT_EQ(run.stop(SIGINT).code, 128 + SIGTERM);
}

TEST_F(Signals, are_ignored_where_the_program_was_started_so) {
    ::signal(SIGHUP, SIG_IGN);  // as nohup does; the child inherits it
    RunningTribo run({"inspect", "pipe"}, scratch.path());
    std::this_thread::sleep_for(kUnderWay);
    ::kill(run.pid(), SIGHUP);
    std::this_thread::sleep_for(3 * kUnderWay);
    ::signal(SIGHUP, SIG_DFL);
    // It still waits for its input, and reads what comes.
    const int pipe = ::open((scratch / "pipe").c_str(), O_WRONLY | O_NONBLOCK);
    ASSERT_GE(pipe, 0);
    constexpr std::string_view kProgram = "G21 G90 F100\nG1 X1\nM30\n";
    EXPECT_EQ(::write(pipe, kProgram.data(), kProgram.size()), static_cast<ssize_t>(kProgram.size()));
    ::close(pipe);
    EXPECT_EQ(run.stop(0).code, 0);
}

}  // namespace
}  // namespace tribo::test
