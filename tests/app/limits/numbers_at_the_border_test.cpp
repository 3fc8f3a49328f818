// SPDX-License-Identifier: MIT
// Numbers that once crashed the program, froze it or came out as nonsense, each through the program itself.
#include <gtest/gtest.h>

#include "app/run/job_folder.hpp"
#include "app/run/job_run.hpp"
#include "net/raw_client.hpp"

namespace tribo::test {
namespace {

struct Slot {
    std::string cutter = "diameter_mm = 6\n", material = "name = \"al7075-t6\"\n", process = kProcess,
                more = "";
    std::string program = "G21 G90 M3\nG0 X-5 Y10 Z-2\nG1 X35\nM30\n";

    static constexpr const char* kProcess = "spindle_rpm = 6000\nfeed_mm_per_min = 600\n";
    std::string job() const {
        return "[stock]\nbox_mm = [[0, 0, -10], [30, 20, 0]]\n[cutter]\nkind = \"flat\"\nlength_mm = 20\n" +
               cutter + "[material]\n" + material + "[process]\n" + process + "[path]\ngcode = \"p.nc\"\n" +
               more;
    }
};

Outcome rendered(const JobFolder& folder, const Slot& slot, std::vector<std::string> more = {}) {
    folder.put("job.toml", slot.job());
    folder.put("p.nc", slot.program);
    if (more.empty()) more = {"--only", "summary,forces"};
    return folder.render(more);
}

void expect_refusal(const Outcome& run, const std::string& place, const std::string& range) {
    EXPECT_EQ(run.code, 2) << run.err;
    EXPECT_NE(run.err.find(place), std::string::npos) << run.err;
    EXPECT_NE(run.err.find(range), std::string::npos) << run.err;
}

TEST(NumbersAtTheBorder, of_a_job_are_refused_at_their_line) {
    const JobFolder folder;
    const std::string own =
        "krc_n_per_mm2 = 1\nkac_n_per_mm2 = 1\nkte_n_per_mm = 1\nkre_n_per_mm = "
        "1\nkae_n_per_mm = 1\nktc_n_per_mm2 = 1e200\n";
    expect_refusal(rendered(folder, {.material = own}), "job.toml:13", "within 0.01 to 100000 N/mm2");
    expect_refusal(rendered(folder, {.process = "feed_mm_per_min = 600\nspindle_rpm = 1e-300\n"}),
                   "job.toml:11", "within 0.01 to 1000000 rpm");
    expect_refusal(rendered(folder, {.process = "spindle_rpm = 6000\nfeed_mm_per_min = 1e300\n"}),
                   "job.toml:11", "within 0.001 to 1000000 mm/min");
    expect_refusal(
        rendered(folder, {.more = "[engagement]\nentry_deg = 0\nexit_deg = 90\naxial_depth_mm = 1e9\n"}),
        "job.toml:17", "within 1e-4 to 1000 mm");
}

TEST(NumbersAtTheBorder, of_a_mesh_are_refused_with_the_file) {
    const JobFolder folder;
    folder.put("far.obj",
               "v 0 0 0\nv 1e30 0 0\nv 0 1e30 0\nv 0 0 1e30\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    folder.put("job.toml",
               "[stock]\nmesh = \"far.obj\"\n[cutter]\nkind = \"flat\"\ndiameter_mm = 6\n[material]\nname = "
               "\"al7075-t6\"\n[process]\nspindle_rpm = 6000\nfeed_mm_per_min = 600\n[path]\ngcode = "
               "\"p.nc\"\n");
    folder.put("p.nc", Slot().program);
    expect_refusal(folder.render({"--only", "summary"}), "far.obj: error: ", "within -1000000 to 1000000 mm");
}

TEST(NumbersAtTheBorder, of_a_material_do_not_end_press) {
    const Scratch scratch;
    scratch.put("m.json",
                R"({"schema": "tribo.material/1", "stiffness_n_per_mm": 4, "viscosity_n_s_per_mm": 0.3,)"
                R"( "width_mm": 1e-100})");
    scratch.put("s.csv", "t_s,x_mm,y_mm,force_n\n0,1,1,1\n1,1,1,1\n");
    expect_refusal(run_tribo({"press", "m.json", "--stroke", "s.csv", "--out", "out"}, scratch.path()),
                   "m.json", "width_mm is 1e-100; give a number from 0.1 to 100000");
}

// Both ends of width, radius and size together: a contact of a hundred million pixels, and one of a
// millionth.
TEST(NumbersAtTheBorder, of_a_contact_are_pressed) {
    const Scratch scratch;
    scratch.put("s.csv", "t_s,x_mm,y_mm,force_n\n0,0.05,0.05,1\n0.2,0.05,0.05,1e4\n");
    for (const auto& [width, radius] : {std::pair{"0.1", "10000"}, std::pair{"100000", "0.001"}}) {
        scratch.put("m.json", std::string(R"({"schema": "tribo.material/1", "stiffness_n_per_mm": 0.001,)") +
                                  R"( "viscosity_n_s_per_mm": 0, "width_mm": )" + width + "}");
        const Outcome run = run_tribo({"press", "m.json", "--stroke", "s.csv", "--out", "out", "--radius-mm",
                                       radius, "--size", "64", "--fps", "10"},
                                      scratch.path());
        EXPECT_EQ(run.code, 0) << run.err;
    }
}

TEST(NumbersAtTheBorder, of_a_recording_are_refused) {
    expect_refusal(run_tribo({"learn", "--recording", "1e308:a.wav", "--out", "m.json"}), "--recording",
                   "within 0.001 to 100000 mm/s");
}

// The spindle's work must be that of the chips.
TEST(NumbersAtTheBorder, a_large_cutter_has_a_true_force) {
    Slot slot;
    slot.cutter = "diameter_mm = 500\nflutes = 20\n";
    slot.program = "G21 G90 M3 S200\nG0 X-260 Y110 Z-2\nG1 X-200 F400\nM30\n";
    const JobRun run = run_job({{"job.toml", slot.job()}, {"p.nc", slot.program}}, 0.5);
    ASSERT_EQ(run.error, "");
    EXPECT_GT(run.totals.removed_mm3, 100);
    EXPECT_GT(run.totals.mean_force_n, 1);
    ASSERT_TRUE(run.totals.energy_balance);
    EXPECT_NEAR(*run.totals.energy_balance, 1, 0.02);
}

// The tool cuts, however little of it the grid sees.
TEST(NumbersAtTheBorder, a_coarse_grid_is_told_as_such) {
    const JobFolder folder;
    const Outcome run = rendered(folder, {}, {"--only", "summary,forces", "--resolution", "10"});
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_GT(folder.summary()["mean_force_n"].get<double>(), 1);
    EXPECT_EQ(run.err.find("nothing was cut"), std::string::npos) << run.err;
    EXPECT_NE(run.err.find("try a finer --resolution"), std::string::npos) << run.err;
}

std::string warnings_in(const JobFolder& folder) {
    std::string all;
    const nlohmann::json summary = folder.summary();
    for (const auto& warning : summary["warnings"]) all += warning.get<std::string>() + "\n";
    return all;
}

// S60 for S6000: 600 / (60 * 2) mm.
TEST(NumbersAtTheBorder, five_millimetres_per_tooth_are_told_in_summary_and_report) {
    const JobFolder folder;
    Slot slot;
    slot.cutter = "diameter_mm = 4\n";
    slot.program = "G21 G90 M3 S60\nG0 X-5 Y10 Z-2\nG1 X35\nM30\n";
    const Outcome run = rendered(folder, slot, {"--only", "summary,report"});
    ASSERT_EQ(run.code, 0) << run.err;
    const std::string told = "600 mm/min at 60 rpm are 5 mm per tooth for a cutter of 4 mm";
    EXPECT_NE(warnings_in(folder).find("p.nc:3: warning: " + told), std::string::npos) << warnings_in(folder);
    EXPECT_NE(folder.get("report.html").find(told), std::string::npos);
}

TEST(NumbersAtTheBorder, a_spindle_at_rest_is_told) {
    const JobFolder folder;
    Slot slot;
    slot.program = "G21 G90 S0 M3\nG0 X-5 Y10 Z-2\nG1 X35\nM30\n";
    ASSERT_EQ(rendered(folder, slot).code, 0);
    EXPECT_NE(warnings_in(folder).find("p.nc:3: warning: feed move with S0: the spindle stands still"),
              std::string::npos)
        << warnings_in(folder);
}

TEST(NumbersAtTheBorder, are_told_to_a_page_before_the_cut) {
    const Scratch scratch;
    Slot slot;
    slot.program = "G21 G90 M3 S60\nG0 X-5 Y10 Z-2\nG1 X35\nM30\n";
    scratch.put("job.toml", slot.job());
    scratch.put("p.nc", slot.program);
    scratch.put("index.html", "<p>page");
    RunningTribo engine({"live", "job.toml", "--resolution", "0.5", "--port", "0", "--web-root", "."},
                        scratch.path());
    const std::string out = engine.out_with("Ctrl-C");
    const std::size_t at = out.find("127.0.0.1:");
    ASSERT_NE(at, out.npos) << out;
    net::test::RawClient client(static_cast<std::uint16_t>(std::stoi(out.substr(at + 10))));
    ASSERT_TRUE(client.join("tribo.live.1"));
    const auto info = client.frame();
    ASSERT_TRUE(info);
    EXPECT_NE(info->payload.find("p.nc:3: warning: 600 mm/min at 60 rpm are 5 mm per tooth"),
              std::string::npos)
        << info->payload;
}

}  // namespace
}  // namespace tribo::test
