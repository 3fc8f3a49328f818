// SPDX-License-Identifier: MIT
#include "job/toml/job_toml.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <numbers>
#include <rapidcheck/gtest.h>

#include "job/memory_source.hpp"
#include "job/toml/toml_section.hpp"

namespace tribo::job {
namespace {

using job::Job;

// The job of the README, with every line where the tests below count on it.
constexpr const char* kBowl = R"([part]
surface = "bowl.wrl"
[stock]
box_mm = [[-50,-50,-25],[50,50,0]]
[cutter]
kind = "flat"
diameter_mm = 12.0
flutes = 2
helix_deg = 30.0
length_mm = 40.0
[material]
name = "al7075-t6"
[process]
spindle_rpm = 6000
feed_mm_per_min = 900
[path]
keyframes = "bowl.csv"
[sound]
listener_mm = [0,0,0]
distance_factor = 1.0
[haptics]
force_scale = 0.01
)";

std::string replaced(std::string text, const std::string& what, const std::string& with) {
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return at == std::string::npos ? text : text.replace(at, what.size(), with);
}

Job job_of(const std::string& text) {
    FileResult<Job> job = parse_job(text, "jobs/bowl.toml", MemorySource());
    EXPECT_TRUE(job) << job.error().text();
    return job ? *std::move(job) : Job{};
}

TEST(JobFile, of_the_readme_says_what_it_says) {
    const Job job = job_of(kBowl);
    EXPECT_EQ(job.part.value().path, "jobs/bowl.wrl");
    EXPECT_FALSE(job.part->unit_mm.has_value());
    EXPECT_EQ(job.stock.box_mm.min, (Vec3{-50, -50, -25}));
    EXPECT_EQ(job.stock.box_mm.max, (Vec3{50, 50, 0}));
    EXPECT_FALSE(job.stock.model);
    ASSERT_EQ(job.cutters.size(), 1u);
    EXPECT_EQ(job.cutters[0].number, 0);
    EXPECT_EQ(job.cutters[0].kind, milling::CutterKind::flat);
    EXPECT_EQ(job.cutters[0].diameter_mm, 12);
    EXPECT_EQ(job.cutters[0].flutes, 2);
    EXPECT_EQ(job.material.name, "al7075-t6");
    EXPECT_FALSE(job.material.coefficients);
    EXPECT_EQ(job.process.spindle_rpm, 6000);
    EXPECT_EQ(job.process.feed_mm_per_min, 900);
    EXPECT_EQ(job.path.kind, job::PathKind::keyframes);
    EXPECT_EQ(job.path.file, "jobs/bowl.csv");
    EXPECT_EQ(job.path.interpolation, motion::Interpolation::spline);
    EXPECT_EQ(job.sound.listener_mm.value(), (Vec3{0, 0, 0}));
    EXPECT_EQ(job.sound.distance_factor, 1);
    EXPECT_EQ(job.haptics.force_scale, 0.01);
    EXPECT_FALSE(job.engagement);
    EXPECT_TRUE(job.fixtures.empty());
    EXPECT_EQ(job.machine.rapid_mm_per_min, 10000);
}

TEST(JobFile, may_use_every_key) {
    const Job job = job_of(R"(
[part]
surface = "/models/p.stl"
unit_mm = 25.4
[stock]
mesh = "blank.stl"
unit_mm = 1000
[[cutter]]
number = 3
kind = "bull"
diameter_mm = 10
corner_mm = 2
flutes = 3
helix_deg = 0
length_mm = 20
runout_mm = 0.01
runout_deg = 45
pitch_deg = [110, 120, 130]
[cutter.holder]
diameter_mm = [10, 40]
length_mm = [30, 50]
[[cutter]]
number = 4
kind = "ball"
diameter_mm = 6
[holder]
diameter_mm = 25
length_mm = 60
[material]
ktc_n_per_mm2 = 767
krc_n_per_mm2 = 169
kac_n_per_mm2 = 222
kte_n_per_mm = 28
kre_n_per_mm = 27
kae_n_per_mm = 0.7
[path]
gcode = "p.ngc"
machine = "xyzac-trt"
[engagement]
entry_deg = 0
exit_deg = 90
axial_depth_mm = 5
[sound]
gain_db = -6
bits = 24
hrtf = "head.sofa"
mode = "hrtf"
[haptics]
profile = "jnd.toml"
probe = "ray"
friction_static = 0.4
friction_kinetic = 0.3
stiffness_n_per_mm = 0.8
[[fixture]]
box_mm = [[0,0,0],[10,10,10]]
[[fixture]]
mesh = "clamp.obj"
[machine]
rapid_mm_per_min = 20000
acceleration_mm_per_s2 = 3000
limits_mm = [[-100,-100,-100],[100,100,100]]
stock_mm = [0,0,13]
tool_length_mm = 80
axes = [{ word = "A", pivot_mm = [0,20,10], limits_deg = [-90, 45] }, { word = "C", direction = [0,0,-2], zero_deg = 90 }]
)");
    EXPECT_EQ(job.part->path, "/models/p.stl");
    EXPECT_EQ(job.part->unit_mm, 25.4);
    EXPECT_EQ(job.stock.model.value().path, "jobs/blank.stl");
    EXPECT_EQ(job.stock.model->unit_mm, 1000);
    ASSERT_EQ(job.cutters.size(), 2u);
    EXPECT_EQ(job.cutters[0].corner_mm, 2);
    EXPECT_EQ(job.cutters[0].pitch_deg, (std::vector<double>{110, 120, 130}));
    ASSERT_EQ(job.cutters[0].holder.size(), 2u);
    EXPECT_EQ(job.cutters[0].holder[1].diameter_mm, 40);
    ASSERT_EQ(job.cutters[1].holder.size(), 1u);
    EXPECT_EQ(job.cutters[1].holder[0].length_mm, 60);
    EXPECT_EQ(job.material.coefficients.value().kre, 27);
    EXPECT_EQ(job.path.kind, job::PathKind::gcode);
    EXPECT_EQ(job.path.machine, "xyzac-trt");
    EXPECT_EQ(job.engagement.value().exit_deg, 90);
    EXPECT_EQ(job.sound.bits, 24);
    EXPECT_EQ(job.sound.mode.value(), job::SoundMode::hrtf);
    EXPECT_EQ(job.sound.hrtf, "jobs/head.sofa");
    EXPECT_FALSE(job.sound.listener_mm);
    EXPECT_EQ(job.haptics.probe, job::ProbeKind::ray);
    EXPECT_EQ(job.haptics.friction_kinetic.value(), 0.3);
    ASSERT_EQ(job.fixtures.size(), 2u);
    EXPECT_EQ(job.fixtures[1].model.value().path, "jobs/clamp.obj");
    EXPECT_EQ(job.machine.acceleration_mm_per_s2, 3000);
    const motion::Machine& machine = job.machine.kinematics.value();
    EXPECT_EQ(machine.name, "xyzac-trt");
    ASSERT_EQ(machine.part_side.size(), 2u);
    EXPECT_EQ(machine.part_side[0].direction, (Vec3{1, 0, 0}));
    EXPECT_EQ(machine.part_side[0].pivot_mm, (Vec3{0, 20, 10}));
    EXPECT_DOUBLE_EQ(machine.part_side[0].max, std::numbers::pi / 4);
    EXPECT_EQ(machine.part_side[1].direction, (Vec3{0, 0, -1}));
    EXPECT_DOUBLE_EQ(machine.part_side[1].zero, std::numbers::pi / 2);
    EXPECT_EQ(machine.axis('X')->max, 100);
    EXPECT_EQ(machine.stock_mm, (Vec3{0, 0, 13}));
    EXPECT_EQ(machine.tool_length_mm.value(), 80);
}

TEST(JobFile, may_say_that_there_is_no_limit_of_acceleration) {
    for (const std::string zero : {"0", "0.0"}) {
        const Job job = job_of(std::string(kBowl) + "[machine]\nacceleration_mm_per_s2 = " + zero + "\n");
        EXPECT_EQ(job.machine.acceleration_mm_per_s2, 0);
    }
    for (const std::string refused : {"0.5", "-1"}) {
        const FileResult<Job> job =
            parse_job(std::string(kBowl) + "[machine]\nacceleration_mm_per_s2 = " + refused + "\n",
                      "jobs/bowl.toml", MemorySource());
        ASSERT_FALSE(job);
        EXPECT_NE(job.error().text().find("1 to 10000000"), std::string::npos) << job.error().text();
    }
}

TEST(JobFile, may_have_a_byte_order_mark_and_line_ends_of_any_system) {
    std::string text = "\xEF\xBB\xBF";
    for (const char* c = kBowl; *c != 0; ++c) text += *c == '\n' ? std::string("\r\n") : std::string(1, *c);
    EXPECT_EQ(job_of(text).cutters.size(), 1u);
}

TEST(JobFile, takes_its_machine_from_a_file_of_its_own) {
    MemorySource files;
    files.put("jobs/machines/m.toml", "rapid_mm_per_min = 500\n");
    files.put("jobs/job.toml", "machine = \"machines/m.toml\"\n" + std::string(kBowl));
    const FileResult<Job> job = read_job(files, "jobs/job.toml");
    ASSERT_TRUE(job) << job.error().text();
    EXPECT_EQ(job->machine.rapid_mm_per_min, 500);
    files.put("jobs/machines/m.toml", "\nrapid_mm_per_min = -1\n");
    const FileResult<Job> wrong = read_job(files, "jobs/job.toml");
    ASSERT_FALSE(wrong);
    EXPECT_EQ(wrong.error().file, "jobs/machines/m.toml");
    EXPECT_EQ(wrong.error().line, 2);
    files.clear();
    files.put("jobs/job.toml", "machine = \"machines/m.toml\"\n" + std::string(kBowl));
    EXPECT_EQ(read_job(files, "jobs/job.toml").error().file, "jobs/machines/m.toml");
}

TEST(JobFile, describes_a_machine_axis_by_axis_from_the_frame_outwards) {
    const Job job = job_of(std::string(kBowl) + R"(
[machine]
axes = [
  { word = "Y", carries = "part", direction = [0,-1,0], limits_mm = [-200, 200] },
  { word = "C", carries = "part", direction = [0,0,-1] },
  { word = "B", carries = "tool", direction = [0,1,0], pivot_mm = [0,0,120], limits_deg = [-95, 95] },
]
)");
    const motion::Machine& machine = job.machine.kinematics.value();
    EXPECT_EQ(machine.name, "described in jobs/bowl.toml");
    ASSERT_EQ(machine.part_side.size(), 2u);
    EXPECT_EQ(machine.part_side[0].word, 'Y');
    EXPECT_EQ(machine.part_side[1].word, 'C');
    ASSERT_EQ(machine.tool_side.size(), 3u);  // X and Z are straight axes at the frame
    EXPECT_EQ(machine.tool_side[2].word, 'B');
    EXPECT_EQ(machine.axis('Y')->min, -200);
}

TEST(JobFile, takes_the_machine_of_its_path_from_a_file) {
    MemorySource files;
    files.put("m.toml", "based_on = \"xyzbc-trt\"\nstock_mm = [0,0,40]\n");
    std::string text = kBowl;
    const std::string keyframes = "keyframes = \"bowl.csv\"";
    text.replace(text.find(keyframes), keyframes.size(), "gcode = \"p.ngc\"\nmachine = \"m.toml\"");
    files.put("job.toml", text);
    const FileResult<Job> job = read_job(files, "job.toml");
    ASSERT_TRUE(job) << job.error().text();
    EXPECT_EQ(job->machine.kinematics.value().stock_mm.z, 40);
    EXPECT_TRUE(job->machine.kinematics->axis('B') != nullptr);
}

struct BadJob {
    const char* what;      // in kBowl
    const char* with;      // put in its place
    int line;              // where the message points
    const char* fragment;  // of the message
};

class BadJobs : public testing::TestWithParam<BadJob> {};

TEST_P(BadJobs, are_refused_with_place_and_cause) {
    const BadJob& bad = GetParam();
    const FileResult<Job> job =
        parse_job(replaced(kBowl, bad.what, bad.with), "jobs/bowl.toml", MemorySource());
    ASSERT_FALSE(job);
    EXPECT_EQ(job.error().fault, FileFault::input);
    EXPECT_EQ(job.error().file, "jobs/bowl.toml");
    EXPECT_EQ(job.error().line, bad.line) << job.error().text();
    EXPECT_GT(job.error().column, 0);
    EXPECT_NE(job.error().text().find(bad.fragment), std::string::npos) << job.error().text();
}

INSTANTIATE_TEST_SUITE_P(
    JobFile, BadJobs,
    testing::Values(
        // Keys nobody knows.
        BadJob{"diameter_mm", "diamter_mm", 7, "unknown key 'diamter_mm' in [cutter]; try 'diameter_mm'"},
        BadJob{"spindle_rpm", "spindel_rpm", 14, "try 'spindle_rpm'"},
        BadJob{"[cutter]", "[cuter]", 5, "unknown key 'cuter'; try 'cutter'"},
        BadJob{"[haptics]", "[haptic]", 21, "try 'haptics'"},
        BadJob{"flutes = 2", "teeth_count = 2", 8, "try one of number, kind, diameter_mm"},
        BadJob{"feed_mm_per_min", "feed", 15, "unknown key 'feed' in [process]"},
        BadJob{"box_mm", "box", 4, "try 'box_mm'"}, BadJob{"surface =", "surfaces =", 2, "try 'surface'"},
        BadJob{"keyframes", "keyframe", 17, "try 'keyframes'"},
        BadJob{"distance_factor = 1.0", "listener = [0,0,0]", 20, "try 'listener_mm'"},
        // Not TOML.
        BadJob{"kind = \"flat\"", "kind = flat", 6, "not valid TOML"},
        BadJob{"[stock]", "[stock", 3, "not valid TOML"},
        BadJob{"flutes = 2", "flutes = 2\nflutes = 3", 9, "not valid TOML"},
        BadJob{"name = \"al7075-t6\"", "name = \"al7075-t6", 12, "not valid TOML"},
        BadJob{"bowl.csv", "bowl\xE9.csv", 17, "not valid TOML"},
        // Values of the wrong type.
        BadJob{"12.0", "\"12\"", 7, "'diameter_mm' must be a number, not a string"},
        BadJob{"flutes = 2", "flutes = 2.5", 8, "'flutes' must be a whole number, not 2.5"},
        BadJob{"flutes = 2", "flutes = true", 8, "must be a number, not true or false"},
        BadJob{"\"flat\"", "3", 6, "'kind' must be a string, not a number"},
        BadJob{"\"bowl.csv\"", "[\"a\"]", 17, "'keyframes' must be a string, not an array"},
        BadJob{"[[-50,-50,-25],[50,50,0]]", "[-50,-50,-25,50,50,0]", 4, "must be two corners"},
        BadJob{"[50,50,0]", "[50,50]", 4, "must be two corners"},
        BadJob{"[0,0,0]", "[0,0,\"up\"]", 19, "'listener_mm' must be a number, not a string"},
        BadJob{"[0,0,0]", "0", 19, "must be three numbers [x, y, z]"},
        BadJob{"[material]\nname = \"al7075-t6\"", "[sound.mode]\nx = 1", 1,
               "'material' is missing; add [material]"},
        BadJob{"[sound]", "[[sound]]\n[[sound]]", 18, "there may be only one [sound]"},
        // Numbers that cannot be.
        BadJob{"12.0", "nan", 7, "not a finite number"}, BadJob{"900", "inf", 15, "not a finite number"},
        BadJob{"12.0", "-12.0", 7, "diameter_mm"}, BadJob{"12.0", "0", 7, "diameter_mm"},
        BadJob{"flutes = 2", "flutes = 0", 8, "'flutes' is 0; keep the flutes within 1 to 64"},
        BadJob{"flutes = 2", "flutes = 65", 8, "within 1 to 64"},
        BadJob{"helix_deg = 30.0", "helix_deg = 90", 9, "helix_deg"},
        BadJob{"length_mm = 40.0", "length_mm = 0", 10, "length_mm"},
        BadJob{"6000", "0", 14, "'spindle_rpm' is 0; keep the spindle speed within 0.01 to 1000000 rpm"},
        BadJob{"900", "-900", 15, "'feed_mm_per_min' is -900"},
        BadJob{"[50,50,0]]", "[50,-50,0]]", 4, "both corners have the same y"},
        BadJob{"[-50,-50,-25]", "[-50,-inf,-25]", 4, "not a finite number"},
        BadJob{"distance_factor = 1.0", "distance_factor = 0", 20, "within 0.001 to 1000000"},
        BadJob{"distance_factor = 1.0", "bits = 20", 20, "'bits' is 20; try 16, 24 or 32"},
        BadJob{"distance_factor = 1.0", "gain_db = 1000", 20, "within -120 to 120 dB"},
        BadJob{"force_scale = 0.01", "force_scale = -1", 22, "within 1e-9 to 1000"},
        BadJob{"force_scale = 0.01", "friction_static = 0.2\nfriction_kinetic = 0.4", 23,
               "above 'friction_static'"},
        BadJob{"length_mm = 40.0", "runout_mm = -0.1", 10, "runout_mm"},
        BadJob{"length_mm = 40.0", "pitch_deg = [100, 200]", 10, "pitch_deg"},
        BadJob{"length_mm = 40.0", "pitch_deg = [120, 120, 120]", 10, "pitch_deg"},
        BadJob{"length_mm = 40.0", "number = 0", 10, "within 1 to 999999999"},
        BadJob{"surface = \"bowl.wrl\"", "surface = \"bowl.wrl\"\nunit_mm = 0", 3, "'unit_mm' is 0"},
        BadJob{"name = \"al7075-t6\"",
               "ktc_n_per_mm2 = 9\nkrc_n_per_mm2 = 9\nkac_n_per_mm2 = 9\nkte_n_per_mm = -1\nkre_n_per_mm = "
               "0\nkae_n_per_mm = 0",
               15, "'kte_n_per_mm' is -1"},
        // Words that are not among the choices.
        BadJob{"\"flat\"", "\"flta\"", 6,
               "'kind' cannot be 'flta'; try 'flat' (one of flat, ball, bull, taper,"},
        BadJob{"distance_factor = 1.0", "mode = \"stereo\"", 20, "try one of hrtf, sphere, pan"},
        BadJob{"\"bowl.csv\"", "\"bowl.csv\"\ninterpolation = \"cubic\"", 18,
               "try one of spline, linear, fit"},
        BadJob{"force_scale = 0.01", "probe = \"pt\"", 22, "'probe' cannot be 'pt'"},
        BadJob{"\"al7075-t6\"", "\"\"", 12, "'name' is empty"},
        BadJob{"\"al7075-t6\"", "\"al7057-t6\"", 12, "al7075-t6"},
        BadJob{"\"bowl.csv\"", "\"\"", 17, "'keyframes' is empty"},
        // A body and modes that cannot be.
        BadJob{"length_mm = 40.0", "stickout_mm = 30", 10, "stickout_mm is shorter than the cutting edges"},
        BadJob{"length_mm = 40.0", "neck_mm = 10", 10, "neck_mm says nothing without a stick-out"},
        BadJob{"length_mm = 40.0", "stickout_mm = 60\nneck_mm = 13", 11,
               "neck_mm is wider than the shank of 12"},
        BadJob{"length_mm = 40.0", "stickout_mm = 60\nreach_mm = 50", 11, "there is none"},
        BadJob{"length_mm = 40.0", "stickout_mm = 60\nneck_mm = 10\nreach_mm = 70", 12,
               "not between the end"},
        BadJob{"length_mm = 40.0", "stickout_mm = 60\nbody = \"steel\"", 11, "one of carbide, hss"},
        BadJob{"force_scale = 0.01", "[dynamics]\nestimate = \"true\"", 23,
               "must be true or false, not a string"},
        BadJob{"force_scale = 0.01", "[dynamics]\nestimate = true", 5, "it has no 'stickout_mm'"},
        BadJob{"force_scale = 0.01",
               "[[mode]]\ndirection = [1,0,0]\nfrequency_hz = 900\ndamping_ratio = "
               "0.02\nstiffness_n_per_mm = 1000\n[dynamics]\nestimate = true",
               28, "has modes of the tool, and asks to estimate them"},
        BadJob{"feed_mm_per_min = 900", "feed_mm_per_min = 900\nspindle_variation = 0.2", 16,
               "'spindle_variation' stands without 'spindle_variation_hz'"},
        BadJob{"feed_mm_per_min = 900", "feed_mm_per_min = 900\nspindle_variation_hz = 2", 16,
               "'spindle_variation_hz' stands without 'spindle_variation'"},
        BadJob{"name = \"al7075-t6\"", "name = \"al7075-t6\"\nspread = 0.2", 13,
               "a named material has its band"},
        // Missing.
        BadJob{"diameter_mm = 12.0", "", 5, "'diameter_mm' is missing in [cutter]; add it under [cutter]"},
        BadJob{"kind = \"flat\"", "", 5, "'kind' is missing"},
        BadJob{"kind = \"flat\"", "kind = \"bull\"", 5, "'corner_mm' is missing"},
        BadJob{"box_mm = [[-50,-50,-25],[50,50,0]]", "", 3, "neither 'box_mm' nor 'mesh'"},
        BadJob{"name = \"al7075-t6\"", "", 11, "no name and no coefficients"},
        BadJob{"name = \"al7075-t6\"", "ktc_n_per_mm2 = 700", 11, "'krc_n_per_mm2' is missing"},
        BadJob{"keyframes = \"bowl.csv\"", "", 16, "[path] names no program"},
        BadJob{"surface = \"bowl.wrl\"", "", 1, "'surface' is missing in [part]"},
        BadJob{"[sound]", "[engagement]\nentry_deg = 0\naxial_depth_mm = 1\n[sound]", 18,
               "'exit_deg' is missing"},
        BadJob{"[sound]", "[[fixture]]\n[sound]", 18, "[[fixture]] has neither"},
        BadJob{"[cutter]", "[[cutter]]\nkind = \"ball\"\ndiameter_mm = 6\n[[cutter]]", 5, "has no 'number'"},
        // Contradictions.
        BadJob{"\"bowl.csv\"", "\"bowl.csv\"\ngcode = \"a.ngc\"", 18, "has both 'keyframes' and 'gcode'"},
        BadJob{"\"bowl.csv\"", "\"bowl.csv\"\nmachine = \"xyzac-trt\"", 18, "'machine' belongs to G-code"},
        BadJob{"keyframes", "interpolation = \"linear\"\napt", 17, "'interpolation' belongs to keyframes"},
        BadJob{"[[-50,-50,-25],[50,50,0]]", "[[-50,-50,-25],[50,50,0]]\nmesh = \"a.stl\"", 5,
               "has both 'box_mm' and 'mesh'"},
        BadJob{"[[-50,-50,-25],[50,50,0]]", "[[-50,-50,-25],[50,50,0]]\nunit_mm = 2", 5, "belongs to a mesh"},
        BadJob{"name = \"al7075-t6\"", "name = \"x\"\nktc_n_per_mm2 = 700", 13,
               "both a name and coefficients"},
        BadJob{"length_mm = 40.0", "corner_mm = 1", 10, "a flat cutter has no 'corner_mm'"},
        BadJob{"[sound]", "[engagement]\nentry_deg = 90\nexit_deg = 90\naxial_depth_mm = 1\n[sound]", 20,
               "'exit_deg' is not behind 'entry_deg'"},
        BadJob{"distance_factor = 1.0", "mode = \"pan\"\nhrtf = \"a.sofa\"", 21, "the mode does not use it"},
        BadJob{"length_mm = 40.0", "holder = {diameter_mm = [1, 2], length_mm = 3}", 10,
               "2 diameters has 1 lengths"},
        BadJob{"[sound]", "[machine]\naxes = [{word = \"A\"}]\n[sound]", 19, "missing in an axis"},
        BadJob{"keyframes = \"bowl.csv\"", "gcode = \"p.ngc\"\nmachine = \"xyzab-trt\"", 18,
               "there is no machine 'xyzab-trt'"},
        BadJob{"[sound]", "[machine]\nbased_on = \"xyzac\"\n[sound]", 19,
               "there is no machine 'xyzac'; try 'xyzac-trt'"},
        BadJob{"[sound]", "[machine]\nstock_mm = [0,0,0]\n[sound]", 19, "belongs to a machine with axes"},
        BadJob{"[sound]",
               "[machine]\nbased_on = \"xyzac-trt\"\naxes = [{word = \"A\", limits_deg = [5, 4]}]\n[sound]",
               20, "is not a lower and an upper limit"},
        BadJob{"[sound]",
               "[machine]\nbased_on = \"xyzac-trt\"\naxes = [{word = \"A\", limits_mm = [4, 5]}]\n[sound]",
               20, "'limits_mm' does not fit the axis A; write degrees"},
        BadJob{"[sound]",
               "[machine]\nbased_on = \"xyzac-trt\"\naxes = [{word = \"A\", carries = \"tool\"}]\n[sound]",
               20, "what carries what is settled"},
        BadJob{"[sound]",
               "[machine]\naxes = [{word = \"A\", carries = \"part\", direction = [0,0,1]}]\n[sound]", 19,
               "it tilts nothing"},
        BadJob{"[cutter]", "[[cutter]]\nnumber = 1\nkind = \"ball\"\ndiameter_mm = 6\n[[cutter]]\nnumber = 1",
               10, "two cutters have the number 1"}));

TEST(JobFile, that_is_empty_says_what_to_write) {
    for (const char* text : {"", "\n\n# nothing\n"}) {
        const FileResult<Job> job = parse_job(text, "e.toml", MemorySource());
        ASSERT_FALSE(job);
        EXPECT_EQ(
            job.error().text(),
            "e.toml:1:1: error: the job is empty; write at least [stock], [cutter], [material] and [path]");
    }
}

RC_GTEST_PROP(JobFile, with_any_damage_is_read_or_refused_but_never_worse, ()) {
    std::string text = kBowl;
    const int damages = *rc::gen::inRange(1, 6);
    for (int i = 0; i < damages; ++i) {
        const std::size_t at = *rc::gen::inRange<std::size_t>(0, text.size());
        switch (*rc::gen::inRange(0, 4)) {
            case 0:
                text[at] = *rc::gen::arbitrary<char>();
                break;
            case 1:
                text.erase(at, *rc::gen::inRange<std::size_t>(1, 20));
                break;
            case 2:
                text.insert(at, text.substr(text.size() / 2, 10));
                break;
            default:
                text.resize(at);
                break;
        }
        if (text.empty()) text = "x";
    }
    const FileResult<Job> job = parse_job(text, "bowl.toml", MemorySource());
    if (job) {
        RC_ASSERT(!job->cutters.empty());
        RC_ASSERT(std::isfinite(job->cutters[0].diameter_mm));
    } else {
        RC_ASSERT(!job.error().cause.empty());
        RC_ASSERT(job.error().line >= 1);
    }
}

TEST(JobFile, has_a_stated_number_of_tables_of_one_kind) {
    const auto fault = [](const std::string& text) {
        const FileResult<Job> job = parse_job(text, "jobs/bowl.toml", MemorySource());
        return job ? "" : job.error().text();
    };
    std::string fixtures;
    for (std::size_t n = 0; n < kMostTables; ++n) fixtures += "[[fixture]]\nbox_mm=[[0,0,0],[1,1,1]]\n";
    EXPECT_EQ(job_of(kBowl + fixtures).fixtures.size(), kMostTables);
    EXPECT_EQ(
        fault(kBowl + fixtures + "[[fixture]]\nmesh = \"a.stl\"\n"),
        "jobs/bowl.toml:2023:1: error: 1001 tables 'fixture', more than 1000; leave out what is not used, "
        "or join several into one");
    std::string cutters;
    for (std::size_t n = 1; n <= kMostTables + 1; ++n) {
        cutters += "[[cutter]]\nnumber = " + std::to_string(n) + "\nkind = \"flat\"\ndiameter_mm = 6\n";
    }
    EXPECT_NE(fault(cutters).find("1001 tables 'cutter', more than 1000"), std::string::npos);
    std::string steps = "1";
    for (int n = 0; n < 100; ++n) steps += ",1";
    EXPECT_NE(fault(kBowl + ("[holder]\ndiameter_mm = [" + steps + "]\nlength_mm = [" + steps + "]\n"))
                  .find("a holder of 101 steps, more than 100"),
              std::string::npos);
}

TEST(JobFile, is_written_by_hand) {
    const FileResult<Job> job =
        parse_job(kBowl + std::string(kLargestJobBytes, '#'), "jobs/bowl.toml", MemorySource());
    ASSERT_FALSE(job);
    EXPECT_NE(job.error().cause.find("bytes, more than 1048576"), std::string::npos) << job.error().text();
}

// toml++ goes down its tables by recursion; half a million of them end the stack.
TEST(JobFile, has_keys_of_few_parts) {
    const auto refused = [](const std::string& text) {
        const FileResult<Job> job = parse_job(text, "deep.toml", MemorySource());
        return job ? "" : job.error().text();
    };
    std::string parts;
    for (int n = 0; n < 250'000; ++n) parts += "a .";
    const std::string cause = ": error: a key has more than 16 parts; write [section] and key = value";
    EXPECT_EQ(refused(parts + "b = 1\n"), "deep.toml:1:48" + cause);
    EXPECT_EQ(refused("# . . .\n[" + parts + "b]\n"), "deep.toml:2:49" + cause);
    EXPECT_EQ(refused("x = \"\"\"\n\\\"\"\"\n\"\"\"\ny = {" + parts + "b = 1}\n"), "deep.toml:4:53" + cause);
    EXPECT_EQ(refused(" = 1\n'x' . " + parts + "b = 1\n"), "deep.toml:2:51" + cause);
    EXPECT_EQ(refused("x = {y = \"\"\"a\"\"\"\"," + parts + "b = 1}\n"), "deep.toml:1:66" + cause);
    // In comments and strings dots are plain text, and numbers have one.
    const std::string dots(100, '.');
    EXPECT_EQ(job_of(replaced(kBowl, "kind = \"flat\"", "kind = \"flat\"  # " + dots)).cutters.size(), 1u);
    EXPECT_EQ(job_of(replaced(kBowl, "bowl.csv", "bowl" + dots + ".csv")).path.file,
              "jobs/bowl" + dots + ".csv");
    EXPECT_EQ(job_of(replaced(kBowl, "[0,0,0]", "[0.0,0.0,\n0.0]")).sound.listener_mm.value(), Vec3{});
    std::string nested;
    for (int n = 0; n < 400'000; ++n) nested += "[";
    EXPECT_NE(refused("x = " + nested).find("not valid TOML"), std::string::npos);
}

// Names and comments may be in any language. Elsewhere a letter beyond ASCII is an error with its place.
TEST(JobFile, takes_utf8_in_strings_and_comments) {
    const std::string greek = "\xCE\xBC\xCE\xAD\xCF\x84\xCE\xB1\xCE\xBB\xCE\xBB\xCE\xBF",
                      umlaut = "W\xC3\xA4rme", euro = "\xE2\x82\xAC", emoji = "\xF0\x9F\x94\xA9";
    for (const std::string& word : {greek, umlaut, euro, emoji}) {
        const Job job = job_of("# " + word + "\n" +
                               replaced(kBowl, "bowl.csv\"", word + ".csv\"  # " + word) + "# " + word);
        EXPECT_EQ(job.path.file, "jobs/" + word + ".csv");
        for (const std::string& text :
             {word + " = 1\n", "x = " + word + "\n", "x " + word + " = 1\n", "[" + word + "]\n",
              "x = 1 " + word + "\n", "x = [1, " + word + "]\n", "x = 1" + word + "\n",
              "x = tru" + word + "\n", "x = {" + word + " = 1}\n",
              "x = \"\"\"a \\\n " + word + "\"\"\"\n" + word}) {
            const FileResult<Job> bad = parse_job(text, "bad.toml", MemorySource());
            ASSERT_FALSE(bad) << text;
            EXPECT_NE(bad.error().cause.find("not valid TOML"), std::string::npos) << bad.error().text();
            EXPECT_GE(bad.error().line, 1);
        }
    }
}

}  // namespace
}  // namespace tribo::job
