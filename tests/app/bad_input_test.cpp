// SPDX-License-Identifier: MIT
// What `tribo render` says to jobs, programs and models that are wrong, ugly or elsewhere: one line with the
// place where there is one, the cause and a remedy, exit code 2 (or 3 where the system refused), and no
// folder.
#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>
#include <sys/mount.h>

#include "app/run/job_folder.hpp"
#include "files/file_size_limit.hpp"

namespace tribo::test {
namespace {

// A job that is right, in parts that cases exchange.
struct Parts {
    std::string stock = "[stock]\nbox_mm = [[0, 0, -10], [30, 20, 0]]\n";
    std::string cutter = "[cutter]\nkind = \"flat\"\ndiameter_mm = 6\nflutes = 2\nlength_mm = 20\n";
    std::string material = "[material]\nname = \"al7075-t6\"\n";
    std::string process = "[process]\nspindle_rpm = 6000\nfeed_mm_per_min = 900\n";
    std::string path = "[path]\ngcode = \"p.nc\"\n";
    std::string more;
    std::string program = "G21 G90 M3\nG0 X-5 Y10 Z-2\nG1 X35\nM30\n";
    std::string keyframes = "x,y,z,i,j,k\n-5,10,-2,0,0,1\n35,10,-2,0,0,1\n";
    std::string apt = "UNITS/MM\nFEDRAT/900\nGOTO/-5,10,-2,0,0,1\nGOTO/35,10,-2\nFINI\n";
    std::string model;  // m.stl, and all others by their names below
    std::vector<std::string> call = {"--only", "summary"};

    std::string job() const { return stock + cutter + material + process + path + more; }
};

void put(const JobFolder& folder, const Parts& parts) {
    folder.put("job.toml", parts.job());
    folder.put("p.nc", parts.program);
    folder.put("k.csv", parts.keyframes);
    folder.put("p.apt", parts.apt);
    for (const char* name : {"m.stl", "m.obj", "m.ply", "m.wrl", "m.glb"}) folder.put(name, parts.model);
}

const std::string kKeyframes = "[path]\nkeyframes = \"k.csv\"\n", kApt = "[path]\napt = \"p.apt\"\n";
std::string stock_from(const std::string& file) {
    return "[stock]\nmesh = \"" + file + "\"\n";
}

struct BadInput {
    const char* name;
    void (*spoil)(Parts&);
    const char* message;  // a part of it: place, cause or remedy
    int code = 2;
};

const BadInput kCases[] = {
    // The job file.
    {"job_is_empty", [](Parts& p) { p.stock = p.cutter = p.material = p.process = p.path = ""; },
     "job.toml:1:1: error: the job is empty"},
    {"job_is_cut_off", [](Parts& p) { p.more = "[sound]\ngain_db = "; },
     "job.toml:16:11: error: not valid TOML"},
    {"job_is_latin_1", [](Parts& p) { p.more = "# M\xFCller\n"; }, "save the file as UTF-8"},
    {"job_has_no_stock", [](Parts& p) { p.stock = ""; }, "stock"},
    {"job_has_no_cutter", [](Parts& p) { p.cutter = ""; }, "cutter"},
    {"job_has_no_material", [](Parts& p) { p.material = ""; }, "material"},
    {"job_has_no_path", [](Parts& p) { p.path = ""; }, "path"},
    {"job_names_two_paths", [](Parts& p) { p.path += "apt = \"p.apt\"\n"; }, "has both 'gcode' and 'apt'"},
    {"unknown_section", [](Parts& p) { p.more = "[sond]\n"; }, "try 'sound'"},
    {"unknown_key", [](Parts& p) { p.process = "[process]\nspindle_rmp = 6000\n"; }, "try 'spindle_rpm'"},
    {"unknown_material", [](Parts& p) { p.material = "[material]\nname = \"al7057-t6\"\n"; }, "al7075-t6"},
    {"number_is_nan", [](Parts& p) { p.process = "[process]\nspindle_rpm = nan\n"; }, "'spindle_rpm'"},
    {"number_is_infinite", [](Parts& p) { p.process = "[process]\nfeed_mm_per_min = inf\n"; },
     "'feed_mm_per_min'"},
    {"number_is_text", [](Parts& p) { p.process = "[process]\nspindle_rpm = \"6000\"\n"; }, "'spindle_rpm'"},
    {"number_is_negative", [](Parts& p) { p.cutter = "[cutter]\nkind = \"flat\"\ndiameter_mm = -6\n"; },
     "'diameter_mm' is -6; keep the cutter diameter within 0.01 to 1000 mm"},
    {"box_is_flat", [](Parts& p) { p.stock = "[stock]\nbox_mm = [[0, 0, 0], [30, 20, 0]]\n"; }, "'box_mm'"},
    {"corner_too_large",
     [](Parts& p) {
         p.cutter = "[cutter]\nkind = \"bull\"\ndiameter_mm = 6\ncorner_mm = 4\nflutes = 2\nlength_mm = 20\n";
     },
     "corner"},
    {"pitch_does_not_close", [](Parts& p) { p.cutter += "pitch_deg = [100, 200]\n"; }, "pitch"},
    {"engagement_is_backwards",
     [](Parts& p) { p.more = "[engagement]\nentry_deg = 90\nexit_deg = 30\naxial_depth_mm = 2\n"; },
     "'exit_deg' is not behind 'entry_deg'"},
    {"file_is_not_there", [](Parts& p) { p.path = "[path]\ngcode = \"q.nc\"\n"; },
     "'gcode' names q.nc, which is not there; correct the name"},
    {"stock_is_not_there", [](Parts& p) { p.stock = stock_from("n.stl"); },
     "job.toml:2:8: error: 'mesh' names n.stl, which is not there"},
    {"fixture_is_not_there", [](Parts& p) { p.more = "[[fixture]]\nmesh = \"n.stl\"\n"; },
     "'mesh' names n.stl, which is not there"},
    {"design_is_not_there", [](Parts& p) { p.more = "[part]\nsurface = \"n.stl\"\n"; },
     "'surface' names n.stl, which is not there"},
    {"machine_is_not_there", [](Parts& p) { p.path += "machine = \"n.toml\"\n"; },
     "'machine' names n.toml, which is not there"},
    {"tool_table_is_not_there", [](Parts& p) { p.path += "tools = \"n.tbl\"\n"; },
     "'tools' names n.tbl, which is not there"},
    {"response_is_not_there",
     [](Parts& p) { p.more = "[[frf]]\nfile = \"n.csv\"\ndirection = [1, 0, 0]\non = \"tool\"\n"; },
     "'file' names n.csv, which is not there"},
    {"head_is_not_there",
     [](Parts& p) {
         p.more = "[sound]\nmode = \"hrtf\"\nhrtf = \"n.sofa\"\n";
         p.call = {"--only", "sound"};
     },
     "'hrtf' names n.sofa, which is not there"},
    {"recording_is_not_there",
     [](Parts& p) {
         p.more = "[sound]\nrecording = \"n.wav\"\nrecording_rpm = 6000\n";
         p.call = {"--only", "sound"};
     },
     "'recording' names n.wav, which is not there"},
    {"file_is_a_folder", [](Parts& p) { p.path = "[path]\ngcode = \".\"\n"; }, "is a folder"},
    {"spindle_is_nowhere", [](Parts& p) { p.process = "[process]\nfeed_mm_per_min = 900\n"; },
     "p.nc:3: error: the spindle has no speed here; add an S word to the program or spindle_rpm"},
    // Programs.
    {"program_is_empty", [](Parts& p) { p.program = ""; }, "p.nc"},
    {"program_moves_nothing", [](Parts& p) { p.program = "G21 G90 M3\nM30\n"; }, "p.nc"},
    {"program_is_binary", [](Parts& p) { p.program = std::string("G21\nG0 X1\0Y2\n", 13); }, "byte 0x00"},
    {"program_is_utf_16", [](Parts& p) { p.program = "\xFF\xFEG\x01"; }, "byte 0xFF"},
    {"word_is_nan", [](Parts& p) { p.program = "G21\nG1 XNAN F5\n"; }, "p.nc:2:"},
    {"word_is_huge", [](Parts& p) { p.program = "G21\nG0 X0 Y0 Z0\nG1 X1e300 F5\n"; }, "p.nc:3:"},
    {"word_is_far_away", [](Parts& p) { p.program = "G21\nG0 X0 Y0 Z0\nG1 X99999999999 F5\n"; }, "p.nc:3:"},
    {"word_is_unknown", [](Parts& p) { p.program = "G21\nG0 X0 Y0 Z0\nG1 X1 F5 ?7\n"; }, "p.nc:3:10"},
    {"arc_misses_its_end", [](Parts& p) { p.program = "G21 F5 M3\nG0 X0 Y0 Z0\nG2 X10 Y0 I2 J0\n"; },
     "p.nc:3:"},
    {"rotary_without_a_machine", [](Parts& p) { p.program = "G21 F5\nG0 X0 Y0 Z0 A30\nG1 X9\n"; }, "p.nc:2"},
    {"inches_far_from_the_stock", [](Parts& p) { p.process = "[process]\nspindle_rpm = 6000\n"; },
     "p.nc:3"},  // no feed: the units of nothing
    {"keyframes_are_one", [](Parts& p) { p.path = kKeyframes, p.keyframes = "x,y,z,i,j,k\n1,2,3,0,0,1\n"; },
     "k.csv:2"},
    {"keyframe_is_nan",
     [](Parts& p) { p.path = kKeyframes, p.keyframes = "x,y,z,i,j,k\n0,0,0,0,0,1\nnan,2,3,0,0,1\n"; },
     "k.csv:3:1"},
    {"keyframe_is_cut_off",
     [](Parts& p) { p.path = kKeyframes, p.keyframes = "x,y,z,i,j,k\n0,0,0,0,0,1\n1,2,3,0"; }, "k.csv:3"},
    {"keyframe_has_no_axis",
     [](Parts& p) { p.path = kKeyframes, p.keyframes = "x,y,z,i,j,k\n0,0,0,0,0,0\n1,2,3,0,0,1\n"; },
     "k.csv:2"},
    {"keyframes_with_semicolons",
     [](Parts& p) { p.path = kKeyframes, p.keyframes = "x;y;z;i;j;k\n0;0;0;0;0;1\n"; }, "semicolons"},
    {"apt_is_empty", [](Parts& p) { p.path = kApt, p.apt = ""; }, "p.apt"},
    {"apt_number_is_text", [](Parts& p) { p.path = kApt, p.apt = "UNITS/MM\nFEDRAT/5\nGOTO/0,0,zero\n"; },
     "p.apt:3:"},
    {"apt_line_is_junk", [](Parts& p) { p.path = kApt, p.apt = "UNITS/MM\nN10 G1 X5\n"; }, "p.apt:2"},
    // Models.
    {"model_is_empty", [](Parts& p) { p.stock = stock_from("m.stl"); }, "m.stl: error: the file is empty"},
    {"model_is_not_one", [](Parts& p) { p.stock = stock_from("m.stl"), p.model = "dear diary"; }, "m.stl"},
    {"stl_is_cut_off",
     [](Parts& p) {
         p.stock = stock_from("m.stl"), p.model = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0";
     },
     "m.stl:4"},
    {"obj_index_is_too_large",
     [](Parts& p) { p.stock = stock_from("m.obj"), p.model = "v 0 0 0\nf 1 2 3\n"; }, "m.obj:2"},
    {"obj_is_nan",
     [](Parts& p) { p.stock = stock_from("m.obj"), p.model = "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"; },
     "m.obj:1"},
    {"ply_promises_too_much",
     [](Parts& p) {
         p.stock = stock_from("m.ply");
         p.model =
             "ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\n"
             "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n";
     },
     "m.ply"},
    {"vrml_is_version_1", [](Parts& p) { p.stock = stock_from("m.wrl"), p.model = "#VRML V1.0 ascii\n"; },
     "m.wrl"},
    {"glb_is_cut_off", [](Parts& p) { p.stock = stock_from("m.glb"), p.model = "glTF\2"; }, "m.glb"},
    {"stock_is_open",
     [](Parts& p) { p.stock = stock_from("m.obj"), p.model = "v 0 0 0\nv 30 0 0\nv 0 20 0\nf 1 2 3\n"; },
     "m.obj"},
    {"stock_unit_is_no_length", [](Parts& p) { p.stock = stock_from("m.obj") + "unit_mm = 0\n"; },
     "'unit_mm'"},
    // The call.
    {"no_room_in_memory", [](Parts& p) { p.call = {"--resolution", "0.01", "--memory", "150"}; },
     "try --resolution"},
    {"grid_finer_than_anything", [](Parts& p) { p.call = {"--resolution", "1e-9"}; }, "--resolution"},
    {"sample_rate_too_low", [](Parts& p) { p.call = {"--sample-rate", "8000"}; }, "--sample-rate"},
    {"unknown_output", [](Parts& p) { p.call = {"--only", "meshes"}; }, "try 'mesh'"},
};

class BadInputs : public testing::TestWithParam<BadInput> {};

TEST_P(BadInputs, are_refused_in_one_line_that_helps) {
    const JobFolder folder;
    Parts parts;
    GetParam().spoil(parts);
    put(folder, parts);
    const Outcome run = folder.render(parts.call);
    EXPECT_EQ(run.code, GetParam().code) << run.err;
    EXPECT_EQ(run.out, "");
    // Warnings may stand before it; the error is the last line.
    const std::size_t at = run.err.rfind('\n', run.err.size() - 2);
    const std::string last = run.err.substr(at == std::string::npos ? 0 : at + 1);
    EXPECT_NE(last.find("error: "), std::string::npos) << run.err;
    EXPECT_NE(last.find("; "), std::string::npos) << "no remedy: " << last;
    EXPECT_NE(last.find(GetParam().message), std::string::npos) << last;
    EXPECT_FALSE(std::filesystem::exists(folder.path() + "/out"));
}

INSTANTIATE_TEST_SUITE_P(Render, BadInputs, testing::ValuesIn(kCases),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(BadInput, has_forty_cases_with_a_message_each) {
    EXPECT_GE(std::size(kCases), 40u);
}

struct UglyInput {
    const char* name;
    void (*change)(Parts&);
};

std::string with_crlf(std::string text) {
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2)
        text.replace(at, 1, "\r\n");
    return text;
}

// Ugly, and right all the same.
const UglyInput kUgly[] = {
    {"crlf",
     [](Parts& p) {
         for (std::string* text : {&p.stock, &p.cutter, &p.material, &p.process, &p.path, &p.program}) {
             *text = with_crlf(*text);
         }
     }},
    {"crlf_keyframes",
     [](Parts& p) { p.path = kKeyframes, p.keyframes = "\xEF\xBB\xBF" + with_crlf(p.keyframes); }},
    {"crlf_apt", [](Parts& p) { p.path = kApt, p.apt = with_crlf(p.apt); }},
    {"latin_1_comment",
     [](Parts& p) {
         p.program =
             "(Fr\xE4ser \xD8"
             "6)\n" +
             p.program;
     }},
    {"no_line_end", [](Parts& p) { p.program = "G21 G90 M3\nG0 X-5 Y10 Z-2\nG1 X35"; }},
    {"percent_signs_and_blank_lines", [](Parts& p) { p.program = "%\n\n" + p.program + "%\nleft over\n"; }},
};

class UglyInputs : public testing::TestWithParam<UglyInput> {};

TEST_P(UglyInputs, mill_the_same_part) {
    const JobFolder folder;
    Parts parts;
    GetParam().change(parts);
    put(folder, parts);
    const Outcome run = folder.render({"--only", "summary", "--resolution", "0.5"});
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_NEAR(folder.summary()["removed_mm3"].get<double>(), 30 * 6 * 2, 2);
}

INSTANTIATE_TEST_SUITE_P(Render, UglyInputs, testing::ValuesIn(kUgly),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(BadInput, a_program_in_the_wrong_unit_is_told_by_what_it_does_not_cut) {
    const JobFolder folder;
    Parts parts;
    parts.program = "G20 G90 M3\nG0 X-5 Y10 Z-2\nG1 X35 F9\nM30\n";
    put(folder, parts);
    const Outcome run = folder.render({"--only", "summary", "--resolution", "0.5"});
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_NE(run.err.find("nothing was cut"), std::string::npos) << run.err;
}

TEST(BadInput, a_folder_that_is_a_link_is_not_replaced) {
    const JobFolder folder;
    put(folder, {});
    std::filesystem::create_directory(folder.path() + "/elsewhere");
    std::filesystem::create_directory_symlink("elsewhere", folder.path() + "/out");
    const Outcome run = folder.render({"--only", "summary"});
    EXPECT_EQ(run.code, 2);
    EXPECT_NE(run.err.find("out: error: the output folder is a symbolic link; "), std::string::npos)
        << run.err;
    EXPECT_TRUE(std::filesystem::is_symlink(folder.path() + "/out"));
    EXPECT_TRUE(std::filesystem::is_empty(folder.path() + "/elsewhere"));
}

TEST(BadInput, a_disk_that_is_full_half_way_leaves_nothing) {
    const JobFolder folder;
    put(folder, {});
    Outcome run;
    {
        const FileSizeLimit limit(20'000);
        run = folder.render({"--only", "sound"});
    }
    EXPECT_EQ(run.code, 3);
    EXPECT_NE(run.err.find("sound.wav: error: cannot write: File too large; "), std::string::npos) << run.err;
    std::vector<std::string> left;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
        left.push_back(entry.path().filename());
    }
    EXPECT_EQ(std::count_if(left.begin(), left.end(),
                            [](const std::string& name) { return name.find("out") != std::string::npos; }),
              0);

    const std::string disk = folder.path() + "/disk";
    std::filesystem::create_directory(disk);
    if (::mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=64k") != 0) return;  // only root may
    run = run_tribo({"render", "job.toml", "--out", "disk/out"}, folder.path());
    EXPECT_EQ(run.code, 3);
    EXPECT_NE(run.err.find("No space left on device; free some space"), std::string::npos) << run.err;
    EXPECT_TRUE(std::filesystem::is_empty(disk));
    ::umount(disk.c_str());
}

}  // namespace
}  // namespace tribo::test
