// SPDX-License-Identifier: MIT
// An output that the run also reads, or that has no folder, is refused by name, before any work, and every
// file stays.
#include <filesystem>
#include <gtest/gtest.h>
#include <map>

#include "app/run/program.hpp"
#include "app/run/small_inputs.hpp"
#include "files/image/png.hpp"
#include "files/riff.hpp"

namespace tribo::test {
namespace {

namespace fs = std::filesystem;

class Outputs : public testing::Test {
  protected:
    Outputs() {
        scratch.put("slot.toml", kSlotJob);
        scratch.put("slot.nc", kSlotProgram);
        scratch.put("m.json", kVoicedMaterial);
        scratch.put("rub.csv", "t_s,x_mm,y_mm,force_n\n0,0,0,1\n0.2,20,0,1\n");
        scratch.put("feel.csv", "t_s,x_mm,y_mm,z_mm\n0,12,10,1\n0.1,12,10,-2\n");
        scratch.put("user.toml", "force_magnitude = 0.1\n");
        fs::create_symlink("m.json", scratch / "link.json");
        fs::create_hard_link(scratch / "rub.csv", scratch / "same.csv");
    }
    Outcome run(const std::vector<std::string>& arguments) const {
        return run_tribo(arguments, scratch.path());
    }
    std::map<std::string, std::string> contents() const {
        std::map<std::string, std::string> all;
        for (const auto& entry : fs::recursive_directory_iterator(scratch.path())) {
            const std::string name = entry.path().lexically_relative(scratch.path()).string();
            all[name] = entry.is_regular_file() ? scratch.get(name) : "";
        }
        return all;
    }
    void expect_refused(const std::vector<std::string>& arguments, const std::string& name,
                        const std::string& cause = "is an input of this run") const {
        const auto before = contents();
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.code, 2) << name;
        EXPECT_TRUE(outcome.err.starts_with(name + ": error: " + cause)) << outcome.err;
        EXPECT_EQ(contents(), before);
    }
    Scratch scratch;
};

TEST_F(Outputs, of_rub_are_not_its_inputs) {
    expect_refused({"rub", "m.json", "--stroke", "rub.csv", "--out", "m.json"}, "m.json");
    expect_refused({"rub", "m.json", "--stroke", "rub.csv", "--out", "rub.csv"}, "rub.csv");
    expect_refused({"rub", "m.json", "--stroke", "rub.csv", "--out", "link.json"}, "link.json");
    expect_refused({"rub", "m.json", "--stroke", "rub.csv", "--out", "same.csv"}, "same.csv");
    expect_refused({"rub", "m.json", "--stroke", "rub.csv", "--out", "./m.json"}, "./m.json");
}

TEST_F(Outputs, of_inspect_are_not_its_inputs) {
    expect_refused({"inspect", "slot.nc", "--picture", "slot.nc"}, "slot.nc");
    // A file that the job names.
    expect_refused({"inspect", "slot.toml", "--picture", "slot.nc"}, "slot.nc");
}

TEST_F(Outputs, of_feel_are_not_its_inputs_nor_each_other) {
    const std::vector<std::string> call{"feel", "slot.toml", "--stroke", "feel.csv"};
    const auto with = [&](std::vector<std::string> more) {
        std::vector<std::string> all = call;
        all.insert(all.end(), more.begin(), more.end());
        return all;
    };
    expect_refused(with({"--out", "feel.csv"}), "feel.csv");
    expect_refused(with({"--out", "slot.nc"}), "slot.nc");
    expect_refused(with({"--out", "new.csv", "--stats", "slot.toml"}), "slot.toml");
    expect_refused(with({"--out", "user.toml", "--profile", "user.toml"}), "user.toml");
    expect_refused(with({"--out", "new.csv", "--mode", "cut", "--bake", "slot.nc"}), "slot.nc",
                   "this is not a baked force table");
    expect_refused(with({"--out", "new.csv", "--stats", "./new.csv"}), "./new.csv",
                   "is named for two outputs");
}

TEST_F(Outputs, have_a_folder_before_any_work) {
    const std::vector<std::vector<std::string>> calls{
        {"rub", "m.json", "--stroke", "rub.csv", "--out", "gone/r.wav"},
        {"inspect", "slot.nc", "--picture", "gone/p.png"},
        {"feel", "slot.toml", "--stroke", "feel.csv", "--out", "gone/t.csv"},
        {"feel", "slot.toml", "--stroke", "feel.csv", "--out", "t.csv", "--stats", "gone/s.json"},
        {"feed", "slot.toml", "--force-n", "100", "--out", "gone/new.nc"},
        {"render", "slot.nc", "--tool", "flat 6", "--out", "out", "--job-out", "gone/j.toml"},
    };
    for (const auto& call : calls) expect_refused(call, call.back(), "its folder is not there");
    fs::create_directory(scratch / "made");
    expect_refused({"rub", "m.json", "--stroke", "rub.csv", "--out", "made"}, "made", "is a folder");
    EXPECT_EQ(run({"rub", "m.json", "--stroke", "rub.csv", "--out", "made/r.wav"}).code, 0);
}

TEST_F(Outputs, of_learn_are_not_its_inputs) {
    files::Image image;
    image.width = image.height = 2;
    image.rgba.assign(16, 200);
    ASSERT_TRUE(files::write_png(scratch / "image.png", image));
    ASSERT_EQ(run({"rub", "m.json", "--stroke", "rub.csv", "--out", "r.wav"}).code, 0);
    expect_refused({"learn", "--recording", "100:r.wav", "--out", "r.wav"}, "r.wav");
    expect_refused({"learn", "--recording", "100:r.wav", "--image", "image.png", "--out", "image.png"},
                   "image.png");
    fs::create_symlink("r.wav", scratch / "l.html");
    expect_refused({"learn", "--recording", "100:r.wav", "--report", "--out", "l.json"}, "l.html");
}

TEST_F(Outputs, folders_hold_no_input) {
    ASSERT_EQ(run({"render", "slot.toml", "--out", "out", "--only", "mesh"}).code, 0);
    // The finished part of the first run as the design of the second.
    scratch.put("next.toml", std::string(kSlotJob) + "[part]\nsurface = \"out/machined.stl\"\n");
    expect_refused({"render", "next.toml", "--out", "out", "--only", "mesh"}, "out/machined.stl");
    EXPECT_EQ(run({"render", "next.toml", "--out", "other", "--only", "mesh"}).code, 0);

    ASSERT_EQ(run({"press", "m.json", "--stroke", "rub.csv", "--out", "pressed", "--size", "8"}).code, 0);
    std::string with_image = kVoicedMaterial;
    with_image.insert(1, "\"image\": \"pressed/frame_0000.png\", \"width_mm\": 20, ");
    scratch.put("again.json", with_image);
    expect_refused({"press", "again.json", "--stroke", "rub.csv", "--out", "pressed", "--size", "8"},
                   "pressed/frame_0000.png");
}

TEST_F(Outputs, may_be_those_of_an_earlier_run) {
    for (int round = 0; round < 2; ++round) {
        EXPECT_EQ(run({"rub", "m.json", "--stroke", "rub.csv", "--out", "r.wav"}).code, 0);
        EXPECT_EQ(run({"render", "slot.toml", "--out", "out", "--only", "mesh"}).code, 0);
        // A baked table is read and written by the same flag.
        const Outcome felt = run(
            {"feel", "slot.toml", "--stroke", "feel.csv", "--mode", "cut", "--bake", "b", "--out", "t.csv"});
        EXPECT_EQ(felt.code, 0) << felt.err;
    }
}

}  // namespace
}  // namespace tribo::test
