// SPDX-License-Identifier: MIT
// Any bytes as a job file, beside small good files of every kind that it may name, give a job of finite
// numbers and a setup that can be milled, or an error with a remedy.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <utility>

#include "job/loader.hpp"
#include "job/memory_source.hpp"
#include "session/cut/mill_setup.hpp"

namespace {

using namespace tribo;

constexpr const char* kSolid = "v 0 0 0\nv 9 0 0\nv 0 9 0\nv 0 0 9\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
constexpr const char* kMachine =
    "based_on = \"table-ac\"\nrapid_mm_per_min = 5000\n[[axes]]\nword = \"A\"\nlimits_deg = [-30, 110]\n";
constexpr const char* kJob =
    "[stock]\nbox_mm = [[0, 0, -9], [9, 9, 0]]\n[cutter]\nkind = \"flat\"\ndiameter_mm = 6\n"
    "[material]\nname = \"al7075-t6\"\n[process]\nspindle_rpm = 6000\n[path]\ngcode = \"a.nc\"\n";

job::MemorySource neighbours() {
    job::MemorySource files;
    files.put("a.nc", "G21 G90 S6000 M3 F600\nT1 M6\nG0 X-9 Y5 Z5\nG1 Z-2\nX20\nG2 X25 Y10 I5\nM30\n");
    files.put("five.nc", "G21 G90 S6000 M3 F600\nG43.4 H1\nG0 X0 Y0 Z9 A0 C0\nG1 X5 A10 C20\nM30\n");
    files.put("a.h",
              "BEGIN PGM A MM\nTOOL CALL 1 Z S6000 F500\nL X+0 Y+0 Z+9 FMAX M3\nL X+9\nEND PGM A MM\n");
    files.put("a.apt",
              "UNITS/MM\nSPINDL/6000,RPM,CLW\nFEDRAT/500,MMPM\nGOTO/0,0,9\nGOTO/9,0,0,0,0,1\nFINI\n");
    files.put("a.csv", "x,y,z,i,j,k\n0,0,0,0,0,1\n5,5,0,0,0,1\n9,5,-1,0.1,0,1\n");
    files.put("a.tbl", "T1 P1 D6 Z50\nT2 P2 D8 Z60\n");
    files.put("a.obj", kSolid);
    files.put("m.toml", kMachine);
    files.put("b.toml", kJob);
    return files;
}

void check(const Error& error) {
    if (error.cause.empty() || error.remedy.empty()) std::abort();
}

void check(const job::LoadedJob& loaded) {
    const job::Job& job = loaded.job;
    if (job.cutters.empty()) std::abort();
    for (const milling::Cutter& cutter : job.cutters) {
        if (!milling::check(cutter)) std::abort();
    }
    for (const job::Solid& solid : loaded.fixtures) {
        if (!(std::isfinite(solid.volume_mm3) && solid.volume_mm3 > 0)) std::abort();
    }
    for (const motion::Move& move : loaded.program.moves) {
        if (!is_finite(move.end.tip_mm) || !is_finite(move.end.axis)) std::abort();
    }
    for (const double value :
         {job.process.spindle_rpm, job.process.feed_mm_per_min, job.machine.acceleration_mm_per_s2}) {
        if (!(std::isfinite(value) && value >= 0)) std::abort();
    }
    if (!(std::isfinite(job.machine.rapid_mm_per_min) && job.machine.rapid_mm_per_min > 0)) std::abort();
    if (!(std::isfinite(job.haptics.force_scale) && job.haptics.force_scale > 0)) std::abort();
    if (job.sound.listener_mm && !is_finite(*job.sound.listener_mm)) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::size_t largest = 1 << 16;
    if (size > largest) return 0;
    static job::MemorySource files = neighbours();
    files.put("job.toml", std::string(reinterpret_cast<const char*>(data), size));
    job::LoadOptions options;
    options.memory_bytes = std::uint64_t{64} << 20;
    const auto loaded = job::load_job(files, "job.toml", options);
    if (!loaded) {
        check(loaded.error());
        return 0;
    }
    check(*loaded);
    session::MillOptions how;
    how.memory_bytes = options.memory_bytes;
    Warnings warnings;
    const auto setup = session::prepare_mill(*loaded, how, warnings);
    if (!setup) {
        check(setup.error());
        return 0;
    }
    if (!(setup->cell_mm > 0 && std::isfinite(setup->cell_mm))) std::abort();
    if (!(setup->schedule->duration_s >= 0 && std::isfinite(setup->schedule->duration_s))) std::abort();
    if (setup->moves.size() != setup->cutter_of_move.size()) std::abort();
    return 0;
}
