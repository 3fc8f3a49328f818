// SPDX-License-Identifier: MIT
// What a job file may ask for beyond a box, a cutter and a path, from the file to the numbers that come out.
#include <gtest/gtest.h>

#include "app/run/job_folder.hpp"

namespace tribo::test {
namespace {

constexpr const char* kBoxStock = "[stock]\nbox_mm = [[0, 0, -10], [30, 20, 0]]\n";
constexpr const char* kFlatCutter =
    "[cutter]\nkind = \"flat\"\ndiameter_mm = 6\nflutes = 2\nlength_mm = 20\n";
constexpr const char* kSlotRest =
    "[material]\nname = \"al7075-t6\"\n[process]\nspindle_rpm = 6000\nfeed_mm_per_min = 900\n"
    "[path]\ngcode = \"slot.nc\"\n";
constexpr const char* kSlotProgram = "G21 G90 M3 F900\nG0 X-5 Y10 Z-2\nG1 X35\nM30\n";

std::string feature_job(const std::string& stock, const std::string& cutter, const std::string& more = {}) {
    return stock + cutter + kSlotRest + more;
}

TEST(JobFeatures, a_machined_part_is_the_next_jobs_stock) {
    const JobFolder folder;
    folder.put("slot.nc", kSlotProgram);
    folder.put("job.toml", feature_job(kBoxStock, kFlatCutter));
    ASSERT_EQ(folder.render({"--only", "mesh", "--resolution", "0.2"}).code, 0);
    folder.put("slot.nc", "G21 G90 M3 F900\nG0 X-5 Y10 Z-3\nG1 X35\nM30\n");
    folder.put("part.glb", folder.get("machined.glb"));
    folder.put("part.stl", folder.get("machined.stl"));
    for (const char* part : {"part.glb", "part.stl"}) {
        folder.put("job.toml", feature_job(std::string("[stock]\nmesh = \"") + part + "\"\n", kFlatCutter));
        const Outcome run = folder.render({"--only", "summary", "--resolution", "0.2"});
        ASSERT_EQ(run.code, 0) << run.err;
        EXPECT_EQ(run.err.find("unit_mm"), std::string::npos) << run.err;
        // The slot, 6 mm wide and 30 mm long, is made 1 mm deeper.
        EXPECT_NEAR(folder.summary()["removed_mm3"].get<double>(), 180, 1) << part;
    }
}

}  // namespace
}  // namespace tribo::test
