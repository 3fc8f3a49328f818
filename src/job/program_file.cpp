// SPDX-License-Identifier: MIT
#include "job/program_file.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "base/text/file_names.hpp"
#include "job/program/called_programs.hpp"
#include "readers/apt/reader.hpp"
#include "readers/control/fanuc_words.hpp"
#include "readers/gcode/reader.hpp"
#include "readers/heidenhain/din_iso.hpp"
#include "readers/heidenhain/reader.hpp"
#include "readers/nci/reader.hpp"
#include "readers/siemens/reader.hpp"
#include "readers/tables/keyframes_csv.hpp"
#include "readers/tables/tool_table.hpp"

namespace tribo::job {
namespace {

constexpr std::size_t kDialectBytes = 4096;  // characters from the start

struct Extension {
    std::string_view text;
    PathKind kind;
};
constexpr std::array kExtensions{
    Extension{".ngc", PathKind::gcode},     Extension{".nc", PathKind::gcode},
    Extension{".gcode", PathKind::gcode},   Extension{".gc", PathKind::gcode},
    Extension{".tap", PathKind::gcode},     Extension{".cnc", PathKind::gcode},
    Extension{".mpf", PathKind::gcode},     Extension{".eia", PathKind::gcode},
    Extension{".min", PathKind::gcode},     Extension{".h", PathKind::gcode},
    Extension{".spf", PathKind::gcode},     Extension{".hnc", PathKind::gcode},
    Extension{".apt", PathKind::apt},       Extension{".cls", PathKind::apt},
    Extension{".cldata", PathKind::apt},    Extension{".cl", PathKind::apt},
    Extension{".aptsource", PathKind::apt}, Extension{".ncl", PathKind::apt},
    Extension{".i", PathKind::gcode},       Extension{".csv", PathKind::keyframes},
    Extension{".nci", PathKind::apt},       Extension{".xpi", PathKind::gcode},
};

// Of a line of APT, in lower case. The first two are comments of Creo and CATIA.
constexpr std::array<std::string_view, 9> kAptStarts{"$$->",   "$$*",    "partno",    "goto",   "multax",
                                                     "loadtl", "fedrat", "tool path", "cutter/"};

std::string lower(std::string_view text) {
    std::string out(text);
    for (char& c : out) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return out;
}

// A line that begins like a block of G-code: an optional N word, then G or M and a digit.
bool begins_like_gcode(std::string_view line) {
    const auto digit = [](char c) { return c >= '0' && c <= '9'; };
    const auto skip_blanks = [&] {
        while (!line.empty() && (line[0] == ' ' || line[0] == '\t')) line.remove_prefix(1);
    };
    skip_blanks();
    if (line.starts_with("n")) {
        line.remove_prefix(1);
        while (!line.empty() && digit(line[0])) line.remove_prefix(1);
        skip_blanks();
    }
    return line.size() >= 2 && (line[0] == 'g' || line[0] == 'm') && digit(line[1]);
}

std::optional<PathKind> detect_by_content(std::string_view bytes) {
    if (readers::looks_like_nci(bytes)) return PathKind::apt;
    const std::string text = lower(bytes.substr(0, kDialectBytes));
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find_first_of("\r\n", at), text.size());
        const std::string_view line = std::string_view(text).substr(at, end - at);
        if (line.starts_with("x,y,z,i,j,k")) return PathKind::keyframes;
        if (std::ranges::any_of(kAptStarts, [&](std::string_view word) { return line.starts_with(word); }))
            return PathKind::apt;
        if (begins_like_gcode(line) || line.find("begin pgm") < 8) return PathKind::gcode;
        at = end + 1;
    }
    return {};
}

Result<motion::Program> parse_keyframes(std::string_view bytes, const std::string& path,
                                        const ProgramFileOptions& options) {
    readers::KeyframeOptions reading{.source_name = path, .unit_mm = options.unit_mm};
    // Each keyframe after the first makes a move.
    reading.max_keyframes = std::min(reading.max_keyframes, options.max_moves + 1);
    const auto keyframes = readers::read_keyframes(bytes, reading);
    if (!keyframes) return std::unexpected(keyframes.error());
    motion::KeyframeOptions motion_options;
    motion_options.interpolation = options.interpolation;
    motion_options.max_moves = options.max_moves;
    auto moves = motion::keyframe_moves(*keyframes, options.default_feed_mm_per_min, motion_options);
    if (!moves) {
        Error error = moves.error();
        error.file = path;
        return std::unexpected(std::move(error));
    }
    motion::Program program;
    program.source = path;
    program.moves = *std::move(moves);
    return program;
}

Result<motion::Program> parse_apt(std::string_view bytes, const std::string& path,
                                  const ProgramFileOptions& options) {
    readers::AptOptions apt;
    apt.source_name = path;
    if (options.unit_mm == readers::mm_per(readers::LengthUnit::inch))
        apt.default_unit = readers::LengthUnit::inch;
    apt.default_feed_mm_per_min = options.default_feed_mm_per_min;
    apt.max_moves = options.max_moves;
    apt.refusals = options.refusals;
    return readers::looks_like_nci(bytes) ? readers::read_nci(bytes, apt) : readers::read_apt(bytes, apt);
}

Result<motion::Program> parse_din_iso(std::string_view bytes, const readers::GcodeOptions& options,
                                      readers::MoveSink* sink) {
    const std::string conversational = readers::in_conversational_words(bytes);
    auto program = sink != nullptr ? readers::read_heidenhain(conversational, options, *sink)
                                   : readers::read_heidenhain(conversational, options);
    if (!program) return program;
    program->dialect = "Heidenhain DIN/ISO";
    program->warnings.push_back({options.source_name, 0,
                                 "a DIN/ISO program of a Heidenhain control: its words are read in those of "
                                 "conversational programs"});
    return program;
}

// Moves go to the sink, or into the program where there is none.
Result<motion::Program> parse_gcode(std::string_view bytes, const std::string& path,
                                    const ProgramFileOptions& options, readers::MoveSink* sink) {
    readers::GcodeOptions gcode;
    gcode.source_name = path;
    gcode.default_feed_mm_per_min = options.default_feed_mm_per_min;
    gcode.machine = options.machine;
    gcode.max_moves = options.max_moves;
    gcode.clock_s = options.clock_s;
    gcode.refusals = options.refusals;
    // The last of a number wins there, the first of it here.
    for (auto tool = options.tools.rbegin(); tool != options.tools.rend(); ++tool) {
        gcode.tools.push_back({tool->number, tool->diameter_mm, tool->length_mm, tool->flutes});
    }
    gcode.missing_programs = options.missing_programs;
    if (!options.dialect && readers::looks_like_din_iso(bytes)) return parse_din_iso(bytes, gcode, sink);
    const auto other = options.dialect == readers::Dialect::num ? readers::OtherControl::num
                       : options.dialect                        ? std::optional<readers::OtherControl>()
                                                                : readers::detect_other_control(bytes);
    std::string in_fanuc_words;
    if (other) {
        in_fanuc_words = readers::in_fanuc_words(bytes, *other);
        bytes = in_fanuc_words;
    }
    const readers::Dialect dialect =
        other ? readers::Dialect::fanuc : dialect_of_program(bytes, path, options);
    if (dialect == readers::Dialect::heidenhain) {
        return sink != nullptr ? readers::read_heidenhain(bytes, gcode, *sink)
                               : readers::read_heidenhain(bytes, gcode);
    }
    if (dialect == readers::Dialect::siemens) {
        return sink != nullptr ? readers::read_siemens(bytes, gcode, *sink)
                               : readers::read_siemens(bytes, gcode);
    }
    if (dialect == readers::Dialect::fanuc) gcode.dialect = readers::GcodeDialect::fanuc;
    auto program =
        sink != nullptr ? readers::read_gcode(bytes, gcode, *sink) : readers::read_gcode(bytes, gcode);
    if (!program) return program;
    program->dialect = other ? readers::name_of(*other) : readers::name_of(dialect);
    if (other) {
        program->warnings.push_back({path, 0,
                                     "a program of the " + program->dialect +
                                         " control: its words are read in those of a Fanuc control"});
    }
    return program;
}

}  // namespace

std::optional<PathKind> detect_program(std::string_view bytes, const std::string& path) {
    const std::string extension = lower(extension_of(path));
    for (const Extension& known : kExtensions) {
        if (extension == known.text) return known.kind;
    }
    return detect_by_content(bytes);
}

readers::Dialect dialect_of_program(std::string_view bytes, const std::string& path,
                                    const ProgramFileOptions& options) {
    if (options.dialect == readers::Dialect::num) return readers::Dialect::fanuc;
    if (options.dialect) return *options.dialect;
    if (readers::looks_like_din_iso(bytes)) return readers::Dialect::heidenhain;
    if (readers::detect_other_control(bytes)) return readers::Dialect::fanuc;
    if (const auto told = readers::detect_dialect(bytes)) return *told;
    const std::string extension = lower(extension_of(path));
    const bool is_siemens = extension == ".mpf" || extension == ".spf";
    return is_siemens ? readers::Dialect::siemens : readers::Dialect::linuxcnc;
}

bool may_call_programs(std::string_view bytes) {
    // A bare name calls a program on a Siemens control: only its files are short enough to look everywhere.
    constexpr std::size_t short_text = 1 << 20;
    if (bytes.size() <= short_text) return true;
    constexpr std::string_view words[] = {"M98", "G65", "G66", "CALL", "call", "Call"};
    return std::ranges::any_of(
        words, [&](std::string_view word) { return bytes.find(word) != std::string_view::npos; });
}

Result<motion::Program> parse_program(std::string_view bytes, const std::string& path, PathKind kind,
                                      const ProgramFileOptions& options) {
    switch (kind) {
        case PathKind::keyframes:
            return parse_keyframes(bytes, path, options);
        case PathKind::apt:
            return parse_apt(bytes, path, options);
        case PathKind::gcode:
            break;
    }
    return parse_gcode(bytes, path, options, nullptr);
}

Result<motion::Program> parse_program(std::string_view bytes, const std::string& path, PathKind kind,
                                      const ProgramFileOptions& options, readers::MoveSink& sink) {
    if (kind == PathKind::gcode) return parse_gcode(bytes, path, options, &sink);
    auto program = parse_program(bytes, path, kind, options);
    if (!program) return program;
    for (const motion::Move& move : program->moves) sink.take(move);
    program->moves.clear();
    return program;
}

FileResult<motion::Program> read_program(const FileSource& files, const Job& job, std::size_t max_moves,
                                         const std::function<double()>& clock_s) {
    FileResult<std::string> bytes = files.read(job.path.file, kLargestProgramBytes);
    if (!bytes) return std::unexpected(bytes.error());
    ProgramFileOptions options;
    options.max_moves = max_moves;
    options.clock_s = clock_s;
    options.default_feed_mm_per_min = job.process.feed_mm_per_min;
    options.unit_mm = job.path.unit_mm;
    options.interpolation = job.path.interpolation;
    options.dialect = job.path.dialect;
    if (job.machine.kinematics) options.machine = &*job.machine.kinematics;
    readers::ToolTable table;
    if (!job.path.tools.empty()) {
        const FileResult<std::string> text = files.read(job.path.tools, kLargestToolTableBytes);
        if (!text) return std::unexpected(text.error());
        auto read = readers::read_tool_table(*text, {.source_name = job.path.tools});
        if (!read) return std::unexpected(FileFailure(read.error()));
        table = *std::move(read);
    }
    std::map<int, std::optional<double>> length_mm;
    for (const motion::DeclaredTool& tool : table.tools) length_mm[tool.number] = tool.length_mm;
    // The job's diameters before the table's.
    for (const milling::Cutter& cutter : job.cutters) {
        motion::DeclaredTool tool;
        tool.number = cutter.number;
        tool.diameter_mm = cutter.diameter_mm;
        tool.flutes = cutter.flutes;
        if (const auto known = length_mm.find(tool.number); known != length_mm.end())
            tool.length_mm = known->second;
        options.tools.push_back(tool);
    }
    options.tools.insert(options.tools.end(), table.tools.begin(), table.tools.end());
    Warnings called;
    std::string whole = *std::move(bytes);
    if (job.path.kind == PathKind::gcode) {
        whole = with_called_programs(files, std::move(whole), job.path.file, options, called);
    }
    auto program = parse_program(whole, job.path.file, job.path.kind, options);
    if (!program) return std::unexpected(FileFailure(program.error()));
    program->warnings.insert(program->warnings.end(), called.begin(), called.end());
    program->tools.insert(program->tools.begin(), table.tools.begin(), table.tools.end());
    program->warnings.insert(program->warnings.end(), table.warnings.begin(), table.warnings.end());
    return *std::move(program);
}

std::string shown_program(const FileSource& files, const Job& job) {
    FileResult<std::string> bytes = files.read(job.path.file, kLongestShownProgramBytes);
    return bytes ? *std::move(bytes) : std::string();
}

}  // namespace tribo::job
