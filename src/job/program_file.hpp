// SPDX-License-Identifier: MIT
// Reads tool paths in any of the formats as one list of moves.
#pragma once

#include <cstdint>
#include <functional>
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

// Largest size of programs; they are read into memory.
inline constexpr std::uint64_t kLargestProgramBytes = std::uint64_t{2} << 30;
// Largest size of tool tables: a quarter of a million tools.
inline constexpr std::uint64_t kLargestToolTableBytes = std::uint64_t{16} << 20;

struct ProgramFileOptions {
    double default_feed_mm_per_min = 0;  // if the program has none; 0: such G-code and APT is refused
    double unit_mm = 1;                  // of keyframes, and of APT and NCI that state none
    motion::Interpolation interpolation = motion::Interpolation::spline;  // of keyframes
    std::optional<readers::Dialect> dialect{};    // of G-code; absent: detected from the text, else LinuxCNC
    std::vector<motion::DeclaredTool> tools{};    // of tool table or job; they override those of the program
    const motion::Machine* machine = nullptr;     // for the rotary words of G-code; motion::check accepts it
    std::size_t max_moves = readers::kMostMoves;  // more are refused
    std::function<double()> clock_s{};            // ends endless loops; see GcodeOptions
    std::vector<std::string>* missing_programs = nullptr;  // see GcodeOptions
    std::vector<Error>* refusals = nullptr;  // receives all refusals of a program; see GcodeOptions
};

// Detects the format by extension (.ngc .nc .gcode .tap ..., .apt .cls .cldata ..., .csv), else by content.
// Empty if the file is no program.
std::optional<PathKind> detect_program(std::string_view bytes, const std::string& path);

// The control of G-code: by the options, the text, the file's name; else LinuxCNC. Fanuc for the controls
// whose programs are read in its words.
readers::Dialect dialect_of_program(std::string_view bytes, const std::string& path,
                                    const ProgramFileOptions& options);

// False if the text of G-code has no word that calls a program.
bool may_call_programs(std::string_view bytes);

Result<motion::Program> parse_program(std::string_view bytes, const std::string& path, PathKind kind,
                                      const ProgramFileOptions& options = {});
// The same, but moves go to the sink and not into the program. For G-code they are never all in memory.
Result<motion::Program> parse_program(std::string_view bytes, const std::string& path, PathKind kind,
                                      const ProgramFileOptions& options, readers::MoveSink& sink);

// Reads the program of a job, with the feed of the job as default. In Program::tools the tools of the tool
// table come before those of the program.
FileResult<motion::Program> read_program(const FileSource& files, const Job& job,
                                         std::size_t max_moves = readers::kMostMoves,
                                         const std::function<double()>& clock_s = {});

// Longest program that is shown to a viewer as text.
inline constexpr std::uint64_t kLongestShownProgramBytes = std::uint64_t{4} << 20;
// The bytes of the program of a job, whose lines the moves count; empty if it is longer than that.
std::string shown_program(const FileSource& files, const Job& job);

}  // namespace tribo::job
