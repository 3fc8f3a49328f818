// SPDX-License-Identifier: MIT
// Chains of set-ups through files: [stock] from a job and from a render's folder, turned by [setup].
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>

#include "app/run/job_folder.hpp"
#include "places.hpp"

namespace tribo::test {
namespace {

constexpr const char* kCutter = "[cutter]\nkind = \"flat\"\ndiameter_mm = 6\nflutes = 2\nlength_mm = 20\n";
constexpr const char* kRest =
    "[material]\nname = \"al7075-t6\"\n[process]\nspindle_rpm = 6000\nfeed_mm_per_min = 900\n";
constexpr const char* kBox = "[stock]\nbox_mm = [[0, 0, -10], [30, 20, 0]]\n";

std::string job(const std::string& stock, const std::string& path, const std::string& cutter = kCutter) {
    return stock + cutter + kRest + "[path]\n" + path + "\n";
}
std::string from(const std::string& what, const std::string& setup = {}) {
    return "[stock]\nfrom = \"" + what + "\"\n" + setup;
}
std::string program(const std::string& body) {
    return "G21 G90 M3 F900\n" + body + "M30\n";
}

// Along x at y = 10, 2 mm deep; along y at x = 15, 3 mm deep.
const std::string kAlongX = "G0 X-5 Y10 Z5\nG0 Z-2\nG1 X35\nG0 Z5\n";
const std::string kAlongY = "G0 X15 Y-5 Z5\nG0 Z-3\nG1 Y25\nG0 Z5\n";

class JobChain : public testing::Test {
  protected:
    JobChain() {
        folder.put("a.nc", program(kAlongX));
        folder.put("b.nc", program(kAlongY));
        folder.put("a.toml", job(kBox, "gcode = \"a.nc\""));
        folder.put("job.toml", job(from("a.toml"), "gcode = \"b.nc\""));
    }
    Outcome render(const std::string& name, const std::string& out,
                   std::vector<std::string> more = {}) const {
        std::vector<std::string> arguments{"render", name, "--out", out, "--resolution", "0.25"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_tribo(arguments, folder.path());
    }
    double removed_mm3(const std::string& name, std::vector<std::string> more = {"--only", "summary"}) const {
        const Outcome run = render(name, "out", std::move(more));
        EXPECT_EQ(run.code, 0) << run.err;
        return run.code == 0 ? folder.summary()["removed_mm3"].get<double>() : -1;
    }
    // The line that begins with the job's place, or with what else is named.
    std::string refusal(const std::string& name = "job.toml", const std::string& out = "out") const {
        const Outcome run = render(name, out, {"--only", "summary"});
        EXPECT_EQ(run.code, 2) << run.err;
        return run.err.substr(0, run.err.find('\n'));
    }
    JobFolder folder;
};

TEST_F(JobChain, is_the_same_as_one_job_of_both_programs) {
    const std::vector<std::string> all{"--only", "summary,forces,mesh"};
    const double a = removed_mm3("a.toml"), b = removed_mm3("job.toml", all);
    const auto mesh = folder.get("machined.stl");
    const double left = folder.summary()["remaining_mm3"];
    const ForceColumns forces = folder.forces();
    folder.put("ab.nc", program(kAlongX + kAlongY));
    folder.put("ab.toml", job(kBox, "gcode = \"ab.nc\""));
    EXPECT_NEAR(removed_mm3("ab.toml", all), a + b, 1e-6);
    EXPECT_NEAR(folder.summary()["remaining_mm3"].get<double>(), left, 1e-6);
    EXPECT_TRUE(folder.get("machined.stl") == mesh);
    const ForceColumns both = folder.forces();
    for (const char* column :
         {"tip_x_mm", "tip_y_mm", "axial_depth_mm", "mean_fx_n", "peak_fxy_n", "removed_mm3"}) {
        const auto& own = forces.at(column);
        const auto& one = both.at(column);
        ASSERT_GT(one.size(), own.size());
        EXPECT_TRUE(std::equal(own.rbegin(), own.rend(), one.rbegin())) << column;
    }
}

TEST_F(JobChain, begins_with_the_stock_of_a_folder_as_with_that_of_its_job) {
    const double b = removed_mm3("job.toml");
    ASSERT_EQ(render("a.toml", "first/a", {"--only", "summary"}).code, 0);
    folder.put("job.toml", job(from("first/a/"), "gcode = \"b.nc\""));
    EXPECT_EQ(removed_mm3("job.toml"), b);
    // Moved together, folder and job still find each other.
    std::filesystem::create_directory(folder.path() + "/elsewhere");
    for (const char* name : {"a.toml", "a.nc", "b.nc", "job.toml", "first"})
        std::filesystem::rename(folder.path() + "/" + name, folder.path() + "/elsewhere/" + name);
    EXPECT_EQ(removed_mm3("elsewhere/job.toml"), b);
}

TEST_F(JobChain, follows_links_to_a_folder_and_to_jobs_elsewhere) {
    const double b = removed_mm3("job.toml");
    ASSERT_EQ(render("a.toml", "deep/er/first", {"--only", "summary"}).code, 0);
    std::filesystem::create_directory_symlink("deep/er/first", folder.path() + "/shortcut");
    folder.put("job.toml", job(from("shortcut"), "gcode = \"b.nc\""));
    EXPECT_EQ(removed_mm3("job.toml"), b);
    // One text for two first jobs: each finds the program that stands beside its link.
    folder.put("text/first.toml", job(kBox, "gcode = \"p.nc\""));
    folder.put("one/p.nc", program(kAlongY));
    std::filesystem::create_symlink("../text/first.toml", folder.path() + "/one/first.toml");
    ASSERT_EQ(render("one/first.toml", "rendered", {"--only", "summary"}).code, 0);
    folder.put("job.toml", job(from("rendered"), "gcode = \"b.nc\""));
    EXPECT_EQ(removed_mm3("job.toml"), 0);
}

TEST_F(JobChain, begins_where_a_render_until_a_time_ended) {
    // 1 s at 15 mm/s after some hundredths of a second of rapids: 10 mm into the blank of 30.
    ASSERT_EQ(render("a.toml", "half", {"--only", "summary", "--until", "1"}).code, 0);
    folder.put("again.toml", job(from("half"), "gcode = \"a.nc\""));
    const double whole = removed_mm3("a.toml");
    const double first = removed_mm3("a.toml", {"--only", "summary", "--until", "1"});
    EXPECT_GT(first, 0.2 * whole);
    EXPECT_LT(first, 0.6 * whole);
    EXPECT_NEAR(removed_mm3("again.toml"), whole - first, 1e-6);
}

TEST_F(JobChain, mills_the_other_side_after_the_part_was_turned_over) {
    // Zero at the old bottom, z down, x kept: y runs from 20 to 0.
    folder.put("job.toml", job(from("a.toml", "[setup]\norigin_mm = [0, 20, -10]\nz_axis = [0, 0, -1]\n"),
                               "gcode = \"b.nc\""));
    EXPECT_NEAR(removed_mm3("job.toml", {"--only", "summary,forces"}), 6 * 3 * 20, 0.1);
    EXPECT_EQ(folder.forces()["tip_z_mm"][5], -3);
    EXPECT_NEAR(folder.summary()["remaining_mm3"].get<double>(), 6000 - 6 * 2 * 30 - 6 * 3 * 20, 0.1);
    // 8.5 mm deep meets the first slot's floor, which stands 8 mm below the new top: 30 less that slot of 6.
    folder.put("b.nc", program("G0 X15 Y-5 Z5\nG0 Z-8.5\nG1 Y25\nG0 Z5\n"));
    EXPECT_NEAR(removed_mm3("job.toml"), 6 * 8.5 * 20 - 6 * 6 * 0.5, 1);
}

TEST_F(JobChain, may_begin_with_keyframes_a_rotary_machine_and_other_tools) {
    folder.put("k.csv", "x,y,z,i,j,k\n-5,10,-2,0,0,1\n15,10,-2,0,0,1\n35,10,-2,0,0,1\n");
    folder.put("k.toml", job(kBox, "keyframes = \"k.csv\""));
    // The same slot with a ball, on a table that is turned by half a turn about z; then deeper with the flat.
    folder.put("m.nc", "G21 G90 M3 F900\nG0 X5 Y-10 Z5 A0 C180\nG0 Z-2\nG1 X-35\nG0 Z5\nM30\n");
    folder.put("m.toml", job(from("k.toml"), "gcode = \"m.nc\"\nmachine = \"xyzac-trt\"",
                             "[cutter]\nkind = \"ball\"\ndiameter_mm = 8\n"));
    folder.put("job.toml", job(from("m.toml"), "gcode = \"a.nc\""));
    EXPECT_NEAR(removed_mm3("k.toml"), 6 * 2 * 30, 0.1);
    // Of the ball's circle, radius 4 and 2 above the face, what lies beside the slot of 6: to either side the
    // integral of sqrt(16 - y^2) - 2 from 3 to sqrt(12), along 30 mm.
    const auto area = [](double y) { return y / 2 * std::sqrt(16 - y * y) + 8 * std::asin(y / 4) - 2 * y; };
    EXPECT_NEAR(removed_mm3("m.toml"), 2 * 30 * (area(std::sqrt(12.0)) - area(3)), 0.3);
    EXPECT_NEAR(removed_mm3("job.toml"), 0, 1e-9);
}

TEST_F(JobChain, of_the_examples_leaves_the_part_of_the_drawing) {
    const Outcome run = run_tribo({"render", std::string(TRIBO_SOURCE_DIR) + "/examples/housing/bottom.toml",
                                   "--out", "out", "--only", "summary", "--resolution", "0.4"},
                                  folder.path());
    ASSERT_EQ(run.code, 0) << run.err;
    constexpr double pi = 3.14159265358979;
    const auto round = [](double diameter, double depth) { return pi / 4 * diameter * diameter * depth; };
    const double outside = (56 * 36 - (4 - pi) * 8 * 8) * 20;
    EXPECT_NEAR(folder.summary()["remaining_mm3"].get<double>(),
                outside - round(28, 9) - round(22, 3) - round(14, 8), 10);
    EXPECT_TRUE(folder.summary()["collisions"].empty());
    EXPECT_TRUE(folder.summary()["warnings"].empty());
}

TEST_F(JobChain, is_looked_at_and_felt_as_any_job) {
    const Outcome inspect = run_tribo({"inspect", "job.toml", "--json"}, folder.path());
    ASSERT_EQ(inspect.code, 0) << inspect.err;
    EXPECT_EQ(nlohmann::json::parse(inspect.out)["stock"]["from"], "a.toml");
    // Down through the first slot: the floor is touched at -2, where the blank would be at 0.
    folder.put("s.csv", "t_s,x_mm,y_mm,z_mm\n0,5,10,2\n1,5,10,-1.9\n");
    const Outcome feel = run_tribo({"feel", "job.toml", "--stroke", "s.csv", "--out", "t.csv", "--device",
                                    "playback", "--resolution", "0.25"},
                                   folder.path());
    ASSERT_EQ(feel.code, 0) << feel.err;
    const std::string trace = folder.file("t.csv");
    EXPECT_EQ(trace.find(",1\n"), std::string::npos) << "the slot of the first job was not there";
}

TEST_F(JobChain, is_refused_with_the_file_and_what_to_do) {
    folder.put("job.toml", job(from("job.toml"), "gcode = \"b.nc\""));
    EXPECT_EQ(
        refusal(),
        "job.toml:2:8: error: the job begins with the stock that it leaves itself: job.toml -> job.toml; "
        "let the first of the jobs begin with box_mm or mesh");
    std::filesystem::create_symlink("job.toml", folder.path() + "/link.toml");
    folder.put("job.toml", job(from("link.toml"), "gcode = \"b.nc\""));
    EXPECT_EQ(refusal().substr(0, 99),
              "link.toml:2:8: error: the job begins with the stock that it leaves itself: link.toml -> "
              "link.toml; ");
    folder.put("job.toml", job(from("gone.toml"), "gcode = \"b.nc\""));
    EXPECT_EQ(refusal(),
              "job.toml:2:8: error: 'gone.toml' to take the stock from is not there; name an earlier "
              "job (.toml) or the folder of its render");
    folder.put("job.toml", job(from("a.nc"), "gcode = \"b.nc\""));
    EXPECT_NE(refusal().find("'a.nc' is no job (.toml) and no folder of a render"), std::string::npos);
    folder.put("other/summary.json", "{\"schema\": \"mine/1\"}");
    folder.put("job.toml", job(from("other"), "gcode = \"b.nc\""));
    EXPECT_NE(refusal().find("'other' is no folder that tribo render wrote"), std::string::npos);
    // What is wrong in the first job is told as its own.
    folder.put("a.toml", job("[stock]\nbox_mm = 3\n", "gcode = \"a.nc\""));
    folder.put("job.toml", job(from("a.toml"), "gcode = \"b.nc\""));
    EXPECT_EQ(refusal().substr(0, 18), "a.toml:2:10: error");
    folder.put("a.toml", job(kBox, "gcode = \"gone.nc\""));
    EXPECT_EQ(refusal().substr(0, 48), "a.toml:14:9: error: 'gcode' names gone.nc, which");
}

TEST_F(JobChain, from_a_folder_is_refused_once_its_job_changed_or_would_be_overwritten) {
    ASSERT_EQ(render("a.toml", "first", {"--only", "summary"}).code, 0);
    folder.put("job.toml", job(from("first"), "gcode = \"b.nc\""));
    EXPECT_EQ(
        refusal("job.toml", "first"),
        "first: error: the job begins with the stock of this folder, which it would replace; name another "
        "folder, or let [stock] from name the earlier job itself");
    folder.put("a.nc", program("G0 X-5 Y10 Z5\nG0 Z-2.001\nG1 X35\nG0 Z5\n"));
    EXPECT_NE(refusal().find("changed since: its path; render it again, or name the job itself"),
              std::string::npos);
    // A comment changes no stock.
    folder.put("a.nc", "(a comment)\n" + program(kAlongX));
    EXPECT_EQ(render("job.toml", "out", {"--only", "summary"}).code, 0);
    std::filesystem::remove(folder.path() + "/a.toml");
    EXPECT_NE(refusal().find("'first' was rendered from 'a.toml', which is gone; bring it back"),
              std::string::npos);
}

}  // namespace
}  // namespace tribo::test
