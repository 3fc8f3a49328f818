// SPDX-License-Identifier: MIT
// Small files that once took minutes or gigabytes: each is refused with the number that fits, by its file and
// line, in bounded time and memory.
#include <functional>
#include <gtest/gtest.h>

#include "app/run/job_folder.hpp"
#include "places.hpp"

namespace tribo::test {
namespace {

std::string repeated(const std::string& text, int times) {
    std::string all;
    for (int n = 0; n < times; ++n) all += text;
    return all;
}

const std::string kJob =
    "[stock]\nbox_mm = [[0, 0, -10], [30, 20, 0]]\n[cutter]\nkind = \"flat\"\ndiameter_mm = 6\n"
    "[material]\nname = \"al7075-t6\"\n[process]\nspindle_rpm = 6000\nfeed_mm_per_min = 900\n"
    "[path]\ngcode = \"p.nc\"\n";
const std::string kMoves = "G21 G90 M3 F600\nG0 X-5 Y10 Z-2\nG1 X35\n";
const std::string kBox = "[[fixture]]\nbox_mm=[[0,0,0],[1,1,1]]\n";

struct Bomb {
    const char* what;
    std::function<void(const JobFolder&)> put;
    std::vector<std::string> call;
    const char* message;  // a part of it
    double most_mb;
};

const std::vector<std::string> kRender{"render", "job.toml", "--out", "out", "--only", "summary"};
const std::vector<std::string> kRenderIn100Mb{"render", "job.toml", "--out",    "out",
                                              "--only", "summary",  "--memory", "100"};

const Bomb kBombs[] = {
    {"a face of 120,000 repeated corners",
     [](const JobFolder& f) { f.put("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf" + repeated(" 1 2 3", 40'000)); },
     {"inspect", "m.obj"},
     "m.obj:4:",
     300},
    {"60,000 fixtures", [](const JobFolder& f) { f.put("job.toml", kJob + repeated(kBox, 60'000)); }, kRender,
     "job.toml: error: is longer than the 1 MB", 300},
    {"20,000 fixtures",
     [](const JobFolder& f) {
         f.put("job.toml", kJob + repeated(kBox, 20'000));
         f.put("p.nc", kMoves);
     },
     kRender, "error: 20000 tables 'fixture', more than 1000; leave out", 300},
    {"a million keyframes",
     [](const JobFolder& f) {
         std::string text = "x,y,z,i,j,k\n";
         for (int n = 0; n < 1'000'000; ++n) text += std::to_string(n % 1000) + ",0,0,0,0,1\n";
         f.put("k.csv", text);
     },
     {"inspect", "k.csv"},
     "k.csv:100002: error: one spline through 1000000 keyframes, more than 100000; write interpolation",
     400},
    {"a loop without end",
     [](const JobFolder& f) { f.put("p.nc", kMoves + "o1 while [1]\n#1=[#1+1]\no1 endwhile\n"); },
     {"inspect", "p.nc"},
     "a loop around this line does not seem to end; correct the loop's condition",
     300},
    {"a loop without end that moves",
     [](const JobFolder& f) { f.put("p.nc", kMoves + "o1 while [1]\nX1\nX2\no1 endwhile\n"); },
     {"inspect", "p.nc"},
     "p.nc:",
     300},
    {"a loop without end that moves, in little memory",
     [](const JobFolder& f) {
         f.put("job.toml", kJob);
         f.put("p.nc", kMoves + "o1 while [1]\nX1\nX2\no1 endwhile\n");
     },
     kRenderIn100Mb, "moves; split it, or allow more memory", 250},
    {"a part of eight million triangles, in little memory",
     [](const JobFolder& f) {
         f.put("job.toml", kJob + "[part]\nsurface = \"m.wrl\"\n");
         f.put("p.nc", kMoves);
         f.put("m.wrl", "#VRML V2.0 utf8\nDEF S Shape { geometry Sphere { } }\n" + repeated("USE S\n", 2000));
     },
     kRenderIn100Mb, "triangles; simplify the model, or allow more memory", 250},
    {"kilometres of path with a turning axis, in little memory",
     [](const JobFolder& f) {
         f.put("job.toml", kJob.substr(0, kJob.find("[path]")) + "[path]\napt = \"p.apt\"\n");
         f.put("p.apt", "UNITS/MM\nFEDRAT/900\n" +
                            repeated("GOTO/-900000,0,0,0,0,1\nGOTO/900000,0,0,0.5,0,1\n", 1000) + "FINI\n");
     },
     kRenderIn100Mb, "p.apt:5: error: up to here the moves are split into more than", 250},
};

TEST(Bombs, are_refused_in_bounded_time_and_memory) {
    for (const Bomb& bomb : kBombs) {
        SCOPED_TRACE(bomb.what);
        const JobFolder folder;
        bomb.put(folder);
        const Outcome run = run_tribo(bomb.call, folder.path());
        EXPECT_EQ(run.code, 2) << run.err;
        EXPECT_NE(run.err.find(bomb.message), std::string::npos) << run.err;
        EXPECT_NE(run.err.find("; "), std::string::npos) << run.err;
        if (kAddressSanitizer) continue;
        EXPECT_LT(run.cpu_s, 15);
        EXPECT_LT(run.peak_mb, bomb.most_mb);
    }
}

}  // namespace
}  // namespace tribo::test
