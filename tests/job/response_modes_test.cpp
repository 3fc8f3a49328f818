// SPDX-License-Identifier: MIT
// [[frf]] of a job: what it says, what is read, and which modes come out.
#include "job/response_modes.hpp"

#include <complex>
#include <cstdio>
#include <gtest/gtest.h>

#include "dynamics/mode.hpp"
#include "job/loader.hpp"
#include "job/memory_source.hpp"
#include "job/toml/job_toml.hpp"

namespace tribo::job {
namespace {

constexpr const char* kJobRest =
    "[stock]\nbox_mm = [[0, 0, -10], [40, 30, 0]]\n"
    "[cutter]\nkind = \"flat\"\ndiameter_mm = 6\nflutes = 2\nlength_mm = 20\n"
    "[material]\nname = \"al7075-t6\"\n[process]\nspindle_rpm = 6000\n"
    "[path]\ngcode = \"slot.nc\"\n";
// The section begins at line 14.
const std::string kFrf = "[[frf]]\nfile = \"tap.csv\"\ndirection = [0, 3, 0]\n";

constexpr dynamics::Mode kMode{{0, 1, 0}, 922, 0.011, 1340};

// From 2 to 3000 Hz.
std::string tap(double sign = 1) {
    std::string csv = "frequency_hz,re_mm_per_n,im_mm_per_n\n";
    for (int n = 1; n <= 1500; ++n) {
        const std::complex<double> h = dynamics::receptance(kMode, 2 * n);
        char line[100];
        std::snprintf(line, sizeof line, "%d,%.17g,%.17g\n", 2 * n, h.real(), sign * h.imag());
        csv += line;
    }
    return csv;
}

MemorySource files_with(const std::string& sections, const std::string& response = tap()) {
    MemorySource files;
    files.put("slot.nc", "G21 G90 M3 F600\nG0 X-10 Y5 Z-2\nG1 X50\nM30\n");
    files.put("tap.csv", response);
    files.put("a.toml", kJobRest + sections);
    return files;
}

TEST(ResponseModes, come_after_those_that_are_stated_by_either_loader) {
    const MemorySource files = files_with(
        "[[mode]]\ndirection = [1, 0, 0]\nfrequency_hz = 300\ndamping_ratio = 0.1\nstiffness_n_per_mm = 7\n" +
        kFrf + "on = \"part\"\nband_hz = [500, 1500]\n");
    const auto loaded = load_job(files, "a.toml");
    ASSERT_TRUE(loaded) << loaded.error().text();
    auto read = read_job(files, "a.toml");
    ASSERT_TRUE(read);
    EXPECT_EQ(read->modes.size(), 1u);
    EXPECT_FALSE(read->frfs[0].fit);
    ASSERT_TRUE(read_and_complete(files, *read));
    for (const Job& job : {loaded->job, *read}) {
        ASSERT_EQ(job.modes.size(), 2u);
        EXPECT_EQ(job.modes[0].frequency_hz, 300);
        const dynamics::Mode& mode = job.modes[1];
        EXPECT_NEAR(mode.frequency_hz, 922, 1e-3);
        EXPECT_NEAR(mode.damping_ratio, 0.011, 1e-7);
        EXPECT_NEAR(mode.stiffness_n_per_mm, 1340, 1e-2);
        EXPECT_EQ(mode.direction.y, 1);
        EXPECT_EQ(mode.on, dynamics::ModeOn::part);
        ASSERT_EQ(job.frfs.size(), 1u);
        EXPECT_EQ(job.frfs[0].fit->from_hz, 500);
        EXPECT_EQ(job.frfs[0].fit->points, 501u);
        EXPECT_LT(job.frfs[0].fit->residual, 1e-6);
    }
    EXPECT_TRUE(loaded->warnings.empty());
}

TEST(ResponseModes, warn_of_another_sign_and_of_a_large_residual) {
    const auto other = load_job(files_with(kFrf, tap(-1)), "a.toml");
    ASSERT_TRUE(other) << other.error().text();
    ASSERT_EQ(other->warnings.size(), 1u);
    EXPECT_EQ(
        other->warnings[0].message(),
        "tap.csv:1: warning: the imaginary part has the sign of e^(-iwt); it is read with the other sign");
    // Every other line is a fifth less.
    std::string csv = "frequency_hz,re_mm_per_n,im_mm_per_n\n";
    for (int n = 1; n <= 1500; ++n) {
        const std::complex<double> h = dynamics::receptance(kMode, 2 * n) * (n % 2 == 0 ? 1.2 : 0.8);
        char line[100];
        std::snprintf(line, sizeof line, "%d,%.17g,%.17g\n", 2 * n, h.real(), h.imag());
        csv += line;
    }
    const auto rough = load_job(files_with(kFrf, csv), "a.toml");
    ASSERT_TRUE(rough) << rough.error().text();
    ASSERT_EQ(rough->warnings.size(), 1u);
    // 0.2 / sqrt(1 + 0.2^2).
    EXPECT_NE(rough->warnings[0].text.find("leave a residual of 19.6 %"), std::string::npos)
        << rough->warnings[0].text;
}

TEST(ResponseModes, name_the_file_that_has_none) {
    const auto refused = [](const std::string& sections, const std::string& response) {
        const auto loaded = load_job(files_with(sections, response), "a.toml");
        return loaded ? "" : loaded.error().text();
    };
    std::string flat = "frequency_hz,re_mm_per_n,im_mm_per_n\n";
    for (int n = 1; n <= 100; ++n) flat += std::to_string(n) + ",1e-5,0\n";
    EXPECT_TRUE(refused(kFrf, flat).starts_with("tap.csv:1: error: no mode stands out"))
        << refused(kFrf, flat);
    EXPECT_TRUE(refused(kFrf, "").starts_with("tap.csv:1: error: the file holds no frequency response"));
    EXPECT_TRUE(refused(kFrf + "unit = \"g/N\"\n", tap()).starts_with("tap.csv:1: error: a unit is stated"));
    EXPECT_TRUE(
        refused(kFrf + "band_hz = [5000, 6000]\n", tap()).starts_with("tap.csv:1: error: the band has 0"));
    EXPECT_NE(refused("[[frf]]\nfile = \"gone.csv\"\ndirection = [1, 0, 0]\n", tap()).find("gone.csv"),
              std::string::npos);
}

// Of an earlier job only the stock counts.
TEST(ResponseModes, of_an_earlier_job_are_not_read) {
    MemorySource files = files_with("[[frf]]\nfile = \"gone.csv\"\ndirection = [1, 0, 0]\n");
    std::string second = kJobRest;
    second.replace(0, second.find("[cutter]"), "[stock]\nfrom = \"a.toml\"\n");
    files.put("b.toml", second + kFrf);
    const auto loaded = load_job(files, "b.toml");
    ASSERT_TRUE(loaded) << loaded.error().text();
    EXPECT_EQ(loaded->job.modes.size(), 1u);
    EXPECT_TRUE(loaded->earlier[0].job.modes.empty());
}

TEST(ResponseModes, refuse_wrong_keys_by_their_line) {
    struct Case {
        std::string section;
        int line;
        const char* fragment;
    };
    const std::string file = "[[frf]]\nfile = \"tap.csv\"\n";
    for (const Case& c :
         {Case{"[[frf]]\ndirection = [1, 0, 0]\n", 14, "'file' is missing"},
          Case{file, 14, "'direction' is missing"},
          Case{file + "direction = [0, 0, 0]\n", 16, "no direction"},
          Case{kFrf + "on = \"holder\"\n", 17, "try one of tool, part"},
          Case{kFrf + "band_hz = 3\n", 17, "'band_hz' is no band"},
          Case{kFrf + "band_hz = [1, 2, 3]\n", 17, "'band_hz' is no band"},
          Case{kFrf + "band_hz = [20, 20]\n", 17, "two rising frequencies"},
          Case{kFrf + "band_hz = [0, 20]\n", 17, "within 1 to 100000 Hz"},
          Case{kFrf + "modes = 0\n", 17, "keep the modes to fit within 1 to 12"},
          Case{kFrf + "modes = 1.5\n", 17, "'modes'"}, Case{kFrf + "unit = \"m\"\n", 17, "mm/N"},
          Case{kFrf + "[dynamics]\nestimate = true\n", 18, "the job has modes of the tool"},
          Case{kFrf + "unti = \"m/N\"\n", 17, "try 'unit'"}}) {
        const auto job = parse_job(kJobRest + c.section, "a.toml", MemorySource());
        ASSERT_FALSE(job) << c.section;
        EXPECT_EQ(job.error().line, c.line) << job.error().text();
        EXPECT_NE(job.error().text().find(c.fragment), std::string::npos) << job.error().text();
    }
}

}  // namespace
}  // namespace tribo::job
