// SPDX-License-Identifier: MIT
// Paths as job files describe them: weighted keyframes, and passes too close for the grid.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <numbers>

#include "app/run/job_run.hpp"

namespace tribo::test {
namespace {

constexpr const char* kTool =
    "[cutter]\nkind = \"ball\"\ndiameter_mm = 6\nflutes = 2\nlength_mm = 20\n"
    "[material]\nname = \"al7075-t6\"\n[process]\nspindle_rpm = 6000\nfeed_mm_per_min = 900\n";

// Keyframes on a half circle of radius 20 about (30, 10), 1 mm deep; `weight` says each one's, 0: no column.
constexpr int kFrames = 13;
constexpr double kRadius = 20;
Vec3 on_circle(int n) {
    const double angle = std::numbers::pi * n / (kFrames - 1);
    return {30 - kRadius * std::cos(angle), 10 + kRadius * std::sin(angle), -1};
}
std::string keyframes(double (*weight)(int)) {
    std::string text = weight(0) > 0 ? "x,y,z,i,j,k,weight\n" : "x,y,z,i,j,k\n";
    for (int n = 0; n < kFrames; ++n) {
        const Vec3 p = on_circle(n);
        char line[120];
        std::snprintf(line, sizeof line, "%.12f,%.12f,%.12f,0,0,1", p.x, p.y, p.z);
        text += line;
        if (weight(0) > 0) text += "," + std::to_string(weight(n));
        text += "\n";
    }
    return text;
}
std::vector<Vec3> tips(double (*weight)(int)) {
    const JobRun run = run_job({{"job.toml", std::string("[stock]\nbox_mm = [[0, 0, -5], [60, 40, 0]]\n") +
                                                 kTool + "[path]\nkeyframes = \"k.csv\"\n"},
                                {"k.csv", keyframes(weight)}},
                               0.5);
    EXPECT_EQ(run.error, "");
    std::vector<Vec3> tips;
    for (const session::KeptRow& kept : run.rows) tips.push_back(kept.row.pose.tip_mm);
    return tips;
}

// From a point to the line through the tips, which are half a millimetre apart.
double off_path(Vec3 p, const std::vector<Vec3>& tips) {
    double nearest = 1e300;
    for (std::size_t n = 1; n < tips.size(); ++n) {
        const Vec3 way = tips[n] - tips[n - 1];
        const double t = std::clamp(dot(p - tips[n - 1], way) / dot(way, way), 0.0, 1.0);
        nearest = std::min(nearest, distance(p, tips[n - 1] + t * way));
    }
    return nearest;
}

TEST(JobPath, through_keyframes_of_a_circle_stays_on_it_whatever_weight_they_share) {
    const std::vector<Vec3> plain = tips([](int) { return 0.0; });
    ASSERT_GT(plain.size(), 100u);
    for (const Vec3& tip : plain) {
        EXPECT_NEAR(tip.z, -1, 1e-9);
        // A cubic through points h apart is off by h^4 / (384 R^3), but for the swing of its free ends.
        if (std::abs(tip.x - 30) > 10) continue;
        const double h = std::numbers::pi * kRadius / (kFrames - 1);
        EXPECT_NEAR(std::hypot(tip.x - 30, tip.y - 10), kRadius,
                    2 * std::pow(h, 4) / 384 / std::pow(kRadius, 3));
    }
    // A rational curve does not see a factor that all its weights have.
    const std::vector<Vec3> heavy = tips([](int) { return 7.0; });
    ASSERT_EQ(heavy.size(), plain.size());
    for (std::size_t n = 0; n < plain.size(); ++n) EXPECT_LT(distance(heavy[n], plain[n]), 1e-6);
}

TEST(JobPath, of_uneven_weights_meets_every_keyframe_on_another_way) {
    const std::vector<Vec3> plain = tips([](int) { return 0.0; });
    const std::vector<Vec3> pulled = tips([](int n) { return n == 6 ? 5.0 : 1.0; });
    constexpr double kChord =
        0.25 / 8 / kRadius * 4;  // of rows half a millimetre apart, and room for curvature
    for (int n = 1; n + 1 < kFrames; ++n) EXPECT_LT(off_path(on_circle(n), pulled), kChord) << n;
    double largest = 0;
    for (const Vec3& tip : pulled) largest = std::max(largest, off_path(tip, plain));
    EXPECT_GT(largest, 0.02);
}

// A flat raster by a ball of 6 mm.
JobRun raster(double sidestep, double cell) {
    std::string program = "G21 G90 S6000 M3 F900\nG0 X2 Y4 Z-0.5\n";
    for (int n = 0; n < 12; ++n) {
        program += "G1 Y" + std::to_string(4 + sidestep * n) + "\nX" + (n % 2 == 0 ? "22" : "2") + "\n";
    }
    return run_job({{"job.toml", std::string("[stock]\nbox_mm = [[0, 0, -5], [24, 16, 0]]\n") + kTool +
                                     "[path]\ngcode = \"p.nc\"\n"},
                    {"p.nc", program}},
                   cell);
}

std::string about_ridges(const JobRun& run) {
    EXPECT_EQ(run.error, "");
    for (const Warning& w : run.warnings) {
        if (w.message().find("ridges") != std::string::npos) return w.message();
    }
    return "";
}

TEST(JobPath, of_passes_nearer_than_two_cells_is_warned_of_with_what_would_do) {
    const std::string said = about_ridges(raster(0.4, 0.25));
    for (const char* part : {"job.toml", "0.4 mm aside", "two cells of 0.25 mm", "try --resolution 0.2"}) {
        EXPECT_NE(said.find(part), std::string::npos) << part << ": " << said;
    }
    EXPECT_EQ(about_ridges(raster(0.4, 0.2)), "");
    EXPECT_EQ(about_ridges(raster(0.6, 0.25)), "");
}

}  // namespace
}  // namespace tribo::test
