// SPDX-License-Identifier: MIT
// `tribo rub` from outside: level and length of a stroke's sound, the published recipe, and bad calls.
#include <cmath>
#include <gtest/gtest.h>

#include "app/run/program.hpp"
#include "files/riff.hpp"

namespace tribo::test {
namespace {

constexpr int kRubRate = 48000;

// -20 dB at 100 mm/s and 1 N, 10 dB a decade between two voices; no texture.
constexpr const char* kMaterial = R"({"schema": "tribo.material/1", "stiffness_n_per_mm": 4,
 "viscosity_n_s_per_mm": 0.3, "voices": [
  {"speed_mm_per_s": 100, "level_db": -20, "sample_rate_hz": 48000, "reflection": [-0.5, 0.3]},
  {"speed_mm_per_s": 1000, "level_db": -10, "sample_rate_hz": 48000, "reflection": [-0.2, 0.1]}]})";
// 2 s at 100 mm/s, a second at rest, 2 s at 316 mm/s, half a second off the surface.
constexpr const char* kRubStroke =
    "t_s,x_mm,y_mm,force_n\n0,0,0,1\n2,200,0,1\n3,200,0,1\n5,832.5,0,1\n5.01,832.5,0,0\n5.5,832.5,0,0\n";

double level_db(const std::vector<double>& x, double from_s, double to_s) {
    double sum = 0;
    const auto first = static_cast<std::size_t>(from_s * kRubRate),
               last = static_cast<std::size_t>(to_s * kRubRate);
    for (std::size_t n = first; n < last; ++n) sum += x.at(n) * x.at(n);
    return 10 * std::log10(sum / static_cast<double>(last - first) + 1e-300);
}

class Rub : public testing::Test {
  protected:
    Rub() {
        scratch.put("m.json", kMaterial);
        scratch.put("s.csv", kRubStroke);
    }
    Outcome rub(std::vector<std::string> more) const {
        std::vector<std::string> all{"rub", "m.json", "--stroke", "s.csv"};
        all.insert(all.end(), more.begin(), more.end());
        return run_tribo(all, scratch.path());
    }
    Scratch scratch;
};

TEST_F(Rub, has_the_level_of_the_law_and_is_silent_where_the_finger_rests) {
    const Outcome run = rub({"--out", "f.wav"});
    ASSERT_EQ(run.code, 0) << run.err;
    const Riff file(scratch.get("f.wav"));
    ASSERT_TRUE(file.well_formed);
    EXPECT_EQ(file.format(2, 2), 1u);  // mono
    EXPECT_EQ(file.format(4, 4), 48000u);
    EXPECT_EQ(file.format(14, 2), 24u);
    const std::vector<double> x = file.samples(24);
    EXPECT_GE(x.size(), static_cast<std::size_t>(5.5 * kRubRate));
    EXPECT_LT(x.size(), static_cast<std::size_t>(6 * kRubRate));
    EXPECT_NEAR(level_db(x, 0.1, 1.9), -20, 0.3);
    EXPECT_LT(level_db(x, 2.1, 2.9), -200);
    // Half way in the logarithm of speed, half way in dB.
    EXPECT_NEAR(level_db(x, 3.1, 4.9), -15, 0.3);
    EXPECT_LT(level_db(x, 5.1, 5.4), -200);
    EXPECT_EQ(scratch.entries(), 3u);
}

TEST_F(Rub, as_published_squares_the_level_and_hears_a_finger_at_rest) {
    ASSERT_EQ(rub({"--out", "f.wav", "--as-published"}).code, 0);
    const std::vector<double> x = Riff(scratch.get("f.wav")).samples(24);
    EXPECT_NEAR(level_db(x, 0.1, 1.9), -40, 0.3);  // mean power 0.01 as the gain
    EXPECT_NEAR(level_db(x, 2.1, 2.9), -40, 0.3);
}

TEST_F(Rub, of_one_seed_is_the_same_file_and_of_another_is_not) {
    ASSERT_EQ(rub({"--out", "a.wav", "--seed", "7", "--bits", "16"}).code, 0);
    ASSERT_EQ(rub({"--out", "b.wav", "--seed", "7", "--bits", "16"}).code, 0);
    ASSERT_EQ(rub({"--out", "c.wav", "--seed", "8", "--bits", "16"}).code, 0);
    ASSERT_EQ(rub({"--out", "d.wav", "--seed", "7", "--bits", "16", "--interpolate", "lsf"}).code, 0);
    EXPECT_EQ(scratch.get("a.wav"), scratch.get("b.wav"));
    EXPECT_NE(scratch.get("a.wav"), scratch.get("c.wav"));
    EXPECT_NE(scratch.get("a.wav"), scratch.get("d.wav"));
    EXPECT_NEAR(level_db(Riff(scratch.get("d.wav")).samples(16), 3.1, 4.9), -15, 0.3);
}

TEST_F(Rub, refuses_bad_calls_by_name_and_leaves_what_was_there) {
    scratch.put("f.wav", "old");
    const auto refuses = [&](const std::string& part, std::vector<std::string> more = {}) {
        more.insert(more.end(), {"--out", "f.wav"});
        const std::size_t before = scratch.entries();
        const Outcome run = rub(more);
        EXPECT_EQ(run.code, 2) << part;
        EXPECT_NE(run.err.find(part), std::string::npos) << run.err;
        EXPECT_EQ(scratch.get("f.wav"), "old");
        EXPECT_EQ(scratch.entries(), before);
    };
    refuses("--bits", {"--bits", "12"});
    refuses("--interpolate", {"--interpolate", "cubic"});
    refuses("--sample-rate", {"--sample-rate", "1"});
    scratch.put("s.csv", "t_s,x_mm,y_mm,force_n\n0,0,0,1\n0,1,0,1\n");
    refuses("s.csv:3");
    scratch.put("s.csv", "t_s,x_mm,y_mm,force_n\n0,0,0,1\n1,nan,0,1\n");
    refuses("s.csv:3");
    scratch.put("s.csv", "t_s,x_mm,y_mm,force_n\n0,0,0,1\n900000,1,0,1\n");
    refuses("longer");
    scratch.put("s.csv", kRubStroke);
    scratch.put("m.json",
                R"({"schema": "tribo.material/1", "stiffness_n_per_mm": 4, "viscosity_n_s_per_mm": 1})");
    refuses("no voices");
    std::string unstable = kMaterial;
    unstable.replace(unstable.find("-0.5"), 4, "-1.5");
    scratch.put("m.json", unstable);
    refuses("m.json");
    scratch.put("m.json", "{");
    refuses("m.json");
}

TEST_F(Rub, names_folders_and_files_that_are_not_there) {
    EXPECT_EQ(rub({"--out", "no/such/folder/f.wav"}).code, 2);
    EXPECT_EQ(rub({"--out", "."}).code, 2);
    EXPECT_EQ(run_tribo({"rub", "gone.json", "--stroke", "s.csv", "--out", "f.wav"}, scratch.path()).code, 2);
    EXPECT_EQ(scratch.entries(), 2u);
    // A device that takes nothing is the system's refusal.
    EXPECT_EQ(rub({"--out", "/dev/full"}).code, 3);
}

TEST_F(Rub, interrupted_leaves_the_old_file_and_nothing_else) {
    scratch.put("f.wav", "old");
    scratch.put("s.csv", "t_s,x_mm,y_mm,force_n\n0,0,0,1\n6000,600000,0,1\n");
    const Outcome run =
        run_tribo({"rub", "m.json", "--stroke", "s.csv", "--out", "f.wav"}, scratch.path(), 300);
    EXPECT_EQ(run.code, 130);
    EXPECT_EQ(scratch.get("f.wav"), "old");
    EXPECT_EQ(scratch.entries(), 3u);
}

}  // namespace
}  // namespace tribo::test
