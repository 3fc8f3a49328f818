// SPDX-License-Identifier: MIT
// Tool paths from files, whichever of the three formats they are in, as one list of moves.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "job/file_source.hpp"
#include "job/job.hpp"
#include "motion/curve/keyframe_motion.hpp"
#include "motion/path/program.hpp"
#include "readers/gcode/reader.hpp"

namespace tribo::job {

// Programs and tool tables are read whole; longer ones are refused.
inline constexpr std::uint64_t kLargestProgramBytes = std::uint64_t{2} << 30;

struct ProgramFileOptions {
    double default_feed_mm_per_min = 0;  // where the program says none; 0: G-code and APT are then refused
    double unit_mm = 1;                  // of keyframes
    motion::Interpolation interpolation = motion::Interpolation::spline;  // of keyframes
    std::optional<readers::Dialect> dialect{};  // of G-code; absent: as its text says, else LinuxCNC's
    std::vector<motion::DeclaredTool> tools{};  // of a table or the job; they win over the program's own
    const motion::Machine* machine = nullptr;   // for the rotary words of G-code; motion::check accepts it
};

// By extension (.ngc .nc .gcode .tap ..., .apt .cls .cldata ..., .csv), and by content where that says
// nothing; empty for what is no program.
std::optional<PathKind> detect_program(std::string_view bytes, const std::string& path);

Result<motion::Program> parse_program(std::string_view bytes, const std::string& path, PathKind kind,
                                      const ProgramFileOptions& options = {});
// The same, with the moves going to the sink and not into the program. Of G-code, never all of them are held.
Result<motion::Program> parse_program(std::string_view bytes, const std::string& path, PathKind kind,
                                      const ProgramFileOptions& options, readers::MoveSink& sink);

// The program that a job names, with the job's feed where the program says none; the tools of the job's tool
// table stand before the program's own in Program::tools.
FileResult<motion::Program> read_program(const FileSource& files, const Job& job);

}  // namespace tribo::job
