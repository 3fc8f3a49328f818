// SPDX-License-Identifier: MIT
// Programs in the style of each control and CAM post (tests/job/posts, written for this test): each reads,
// and its control is told from its text.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <map>
#include <string>

#include "job/program_file.hpp"
#include "motion/path/path.hpp"
#include "places.hpp"

namespace tribo::job {
namespace {

std::string text_of(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

// The control by the first part of the file's name; empty: APT.
std::string control_of(const std::string& name) {
    const std::map<std::string, std::string> controls{{"fanuc", "Fanuc"},
                                                      {"haas", "Fanuc"},
                                                      {"mazak", "Fanuc"},
                                                      {"powermill", "Fanuc"},
                                                      {"g66", "Fanuc"},
                                                      {"g71", "Fanuc"},
                                                      {"renishaw", "Fanuc"},
                                                      {"yasnac", "Fanuc"},
                                                      {"edge", "Fanuc"},
                                                      {"denford", "Fanuc"},
                                                      {"five", "Fanuc"},
                                                      {"mach3", "LinuxCNC"},
                                                      {"grbl", "LinuxCNC"},
                                                      {"pathpilot", "LinuxCNC"},
                                                      {"dynapath", "LinuxCNC"},
                                                      {"ugs", "LinuxCNC"},
                                                      {"marlin", "LinuxCNC"},
                                                      {"lcnc3", "LinuxCNC"},
                                                      {"linuxcnc", "LinuxCNC"},
                                                      {"hole", "LinuxCNC"},
                                                      {"flatcam", "LinuxCNC"},
                                                      {"siemens", "Siemens"},
                                                      {"siem", "Siemens"},
                                                      {"heid", "Heidenhain"},
                                                      {"heidenhain", "Heidenhain"},
                                                      {"hypermill", "Heidenhain"},
                                                      {"okuma", "Okuma OSP"},
                                                      {"okuma2", "Okuma OSP"},
                                                      {"fagor", "Fagor 8055"},
                                                      {"iso", "Heidenhain DIN/ISO"},
                                                      {"nci", "Mastercam NCI"},
                                                      {"num", "NUM"},
                                                      {"apt", ""}};
    return controls.at(name.substr(0, name.find_first_of("_.")));
}

TEST(Posts, of_each_control_read) {
    // Lengths of the paths that are short enough to be added up by hand.
    const std::map<std::string, double> lengths{
        {"grbl_easel.nc", 3.81 + 2 * 4.5212 + 100},
        {"flatcam.nc", 16.5 + 1.5},
        {"dynapath.nc", 11 + 20 + 5 * M_PI},
        {"haas_holes.nc", 13 * 0.6 * 25.4},
        {"g66.nc", 2 * 12},
        {"hypermill_heid.h", 11 + 10},
        {"num_1060.xpi", 2 * (35 + 5 * M_PI / 2 + 15) + (5 + 2) + (5 + 4) + 2 * 10 + 10},
        {"fagor_rpt.pim", 3 * (std::hypot(5, 1) + 1) + 5 * M_PI},
        {"nci_mastercam.nci", 4 + 40 + 5 * M_PI + 20},
        {"denford.fnc", 4 + 20 + 5 * M_PI + 3 + 15},
    };
    int count = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(TRIBO_SOURCE_DIR) / "tests/job/posts")) {
        ++count;
        const std::string name = entry.path().filename().string(), text = text_of(entry.path());
        const auto kind = detect_program(text, name);
        ASSERT_TRUE(kind.has_value()) << name;
        ProgramFileOptions options;
        options.tools = {{.number = 1, .diameter_mm = 10, .line = 0},
                         {.number = 2, .diameter_mm = 5, .line = 0}};
        const auto program = parse_program(text, name, *kind, options);
        if (!program) {
            ADD_FAILURE() << program.error().text();
            continue;
        }
        EXPECT_EQ(program->dialect, control_of(name)) << name;
        EXPECT_FALSE(program->moves.empty()) << name;
        if (const auto expected = lengths.find(name); expected != lengths.end()) {
            double feed_mm = 0;
            for (const motion::Move& move : program->moves) {
                if (move.kind == motion::MoveKind::feed) feed_mm += motion::path_length_mm(move);
            }
            EXPECT_NEAR(feed_mm, expected->second, 1e-6) << name;
        }
    }
    EXPECT_GE(count, 40);
}

}  // namespace
}  // namespace tribo::job
