// SPDX-License-Identifier: MIT
// A job that names head responses: good ones are heard, bad ones are refused with the reason, and nothing of
// them reaches the program itself.
#include <chrono>
#include <fstream>
#include <gtest/gtest.h>
#include <random>
#include <sstream>

#include "app/run/job_folder.hpp"

namespace tribo::test {
namespace {

constexpr const char* kHeadJob = R"([stock]
box_mm = [[0, 0, -5], [10, 10, 0]]
[cutter]
kind = "flat"
diameter_mm = 6
[material]
name = "al7075-t6"
[process]
spindle_rpm = 6000
[path]
gcode = "slot.nc"
[sound]
)";
constexpr const char* kShipped = "/usr/share/libmysofa/MIT_KEMAR_normal_pinna.sofa";

std::string shipped() {
    std::ifstream file(kShipped, std::ios::binary);
    std::ostringstream bytes;
    bytes << file.rdbuf();
    return bytes.str();
}

Outcome rendered(const JobFolder& folder, const std::string& sound) {
    folder.put("job.toml", kHeadJob + sound);
    folder.put("slot.nc", "G21 G90 M3\nG0 X-5 Y5 Z-1\nG1 X4 F600\nM30\n");
    return folder.render({"--only", "sound"});
}

TEST(HeadResponses, of_a_file_are_read_by_a_child_and_heard) {
    const std::string good = shipped();
    if (good.empty()) GTEST_SKIP() << "libmysofa's set is not there";
    const JobFolder folder;
    folder.put("head.sofa", good);
    const Outcome own = rendered(folder, "hrtf = \"head.sofa\"\n");
    ASSERT_EQ(own.code, 0) << own.err;
    const std::string wave = folder.get("sound.wav");
    // The same set as the built-in one: the same sound.
    ASSERT_EQ(rendered(folder, "").code, 0);
    EXPECT_EQ(folder.get("sound.wav"), wave);
    ASSERT_EQ(rendered(folder, "mode = \"sphere\"\n").code, 0);
    EXPECT_NE(folder.get("sound.wav"), wave);
}

TEST(HeadResponses, of_a_bad_file_are_refused_with_the_reason) {
    const JobFolder folder;
    const auto refused = [&](const std::string& bytes) {
        folder.put("head.sofa", bytes);
        const Outcome run = rendered(folder, "hrtf = \"head.sofa\"\n");
        EXPECT_EQ(run.code, 2) << run.err;
        EXPECT_NE(run.err.find("head.sofa: error: "), std::string::npos) << run.err;
        EXPECT_NE(run.err.find("; try "), std::string::npos) << run.err;
    };
    refused("");
    refused("This is no SOFA file.\n");
    refused(std::string(100000, '\0'));
    const std::string good = shipped();
    if (good.empty()) return;
    refused(good.substr(0, good.size() / 3));
    refused(good.substr(0, 96));
    const Outcome missing = rendered(folder, "hrtf = \"nowhere.sofa\"\n");
    EXPECT_EQ(missing.code, 2) << missing.err;
}

TEST(HeadResponses, that_are_mutated_never_take_the_program_down) {
    const std::string good = shipped();
    if (good.empty()) GTEST_SKIP() << "libmysofa's set is not there";
    const JobFolder folder;
    std::mt19937 random(5);
    for (int n = 0; n < 12; ++n) {
        std::string bytes = good;
        // The first kilobytes hold the structure; the rest is packed numbers.
        for (int k = 0; k < 1 + n; ++k) bytes[random() % 8000] = static_cast<char>(random());
        folder.put("head.sofa", bytes);
        const Outcome run = rendered(folder, "hrtf = \"head.sofa\"\n");
        EXPECT_TRUE(run.code == 0 || run.code == 2) << run.code << run.err;
    }
}

}  // namespace
}  // namespace tribo::test
