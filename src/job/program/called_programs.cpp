// SPDX-License-Identifier: MIT
#include "job/program/called_programs.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "base/text/file_names.hpp"

namespace tribo::job {
namespace {

// A program is read once more for each level of calls.
constexpr int kDeepestCalls = 8;
constexpr std::size_t kMostPrograms = 100;
constexpr std::uint64_t kLargestCalledBytes = std::uint64_t{64} << 20;

// Receives moves and forgets them.
class NoMoves final : public readers::MoveSink {
  public:
    void take(const motion::Move&) override {}
};

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

std::string upper(std::string text) {
    for (char& c : text) {
        if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    }
    return text;
}

std::string lower(std::string text) {
    for (char& c : text) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return text;
}

// Names of the file that a control would look for.
std::vector<std::string> file_names(const std::string& name, readers::Dialect dialect,
                                    const std::string& extension) {
    std::vector<std::string> stems{name, upper(name), lower(name)};
    const bool is_number = !name.empty() && std::ranges::all_of(name, is_digit);
    if (is_number) {
        const std::string four = std::string(name.size() < 4 ? 4 - name.size() : 0, '0') + name;
        for (const char* letter : {"O", "o", ""}) {
            stems.push_back(letter + four);
            stems.push_back(letter + name);
        }
    }
    std::vector<std::string> extensions{extension, ""};
    if (dialect == readers::Dialect::siemens)
        extensions.insert(extensions.end(), {".SPF", ".spf", ".MPF", ".mpf"});
    if (dialect == readers::Dialect::heidenhain) extensions.insert(extensions.end(), {".h", ".H"});
    if (dialect == readers::Dialect::linuxcnc || dialect == readers::Dialect::fanuc) {
        extensions.insert(extensions.end(), {".ngc", ".nc", ".NC", ".txt", ".tap", ".cnc"});
    }
    std::vector<std::string> names;
    for (const std::string& stem : stems) {
        for (const std::string& ending : extensions) names.push_back(stem + ending);
    }
    return names;
}

std::string_view without_end(std::string_view text) {
    const std::size_t last = text.find_last_not_of("% \t\r\n");
    return text.substr(0, last == std::string_view::npos ? 0 : last + 1);
}

std::string_view without_percent(std::string_view text) {
    const std::size_t first = text.find_first_not_of("% \t\r\n");
    return first == std::string_view::npos ? std::string_view{} : without_end(text.substr(first));
}

// The called program as its control finds it behind the other.
std::string behind(const std::string& name, std::string_view text, readers::Dialect dialect) {
    switch (dialect) {
        case readers::Dialect::heidenhain:
            return std::string(text);
        case readers::Dialect::siemens:
            return (text.find("%_N_") < 16 ? "" : "%_N_" + upper(name) + "_SPF\n") + std::string(text);
        default:
            break;
    }
    const std::string_view body = without_percent(text);
    const bool is_sub = lower(std::string(body)).find("sub") != std::string::npos &&
                        lower(std::string(body)).find("endsub") != std::string::npos;
    if (is_sub) return std::string(body) + "\n";
    const bool has_name = body[0] == 'O' || body[0] == 'o' || body[0] == ':' || body[0] == '<';
    const bool is_number = std::ranges::all_of(name, is_digit);
    const std::string head = has_name ? "" : is_number ? "O" + name + "\n" : "<" + name + ">\n";
    return head + std::string(body) + "\nM99\n";
}

int lines_of(std::string_view text) {
    return static_cast<int>(std::ranges::count(text, '\n')) + 1;
}

}  // namespace

std::string with_called_programs(const FileSource& files, std::string program, const std::string& path,
                                 const ProgramFileOptions& options, Warnings& warnings) {
    if (!may_call_programs(program)) return program;
    const readers::Dialect dialect = dialect_of_program(program, path, options);
    const std::size_t slash = path.find_last_of("/\\");
    const std::string folder = slash == std::string::npos ? "" : path.substr(0, slash + 1);
    const std::string extension(extension_of(path));
    std::set<std::string> asked;
    bool is_first = true;
    for (int level = 0; level < kDeepestCalls && asked.size() < kMostPrograms; ++level) {
        std::vector<std::string> missing;
        ProgramFileOptions trial = options;
        trial.missing_programs = &missing;
        std::vector<Error> refusals;
        trial.refusals = &refusals;
        trial.default_feed_mm_per_min = std::max(options.default_feed_mm_per_min, 1.0);
        NoMoves none;
        const bool is_whole = parse_program(program, path, PathKind::gcode, trial, none).has_value();
        if (is_whole && missing.empty()) break;
        bool found_any = false;
        for (const std::string& name : missing) {
            if (!asked.insert(name).second || asked.size() > kMostPrograms) continue;
            for (const std::string& file : file_names(name, dialect, extension)) {
                const auto text = files.read(folder + file, kLargestCalledBytes);
                if (!text || without_percent(*text).empty()) continue;
                const bool is_gcode =
                    dialect == readers::Dialect::linuxcnc || dialect == readers::Dialect::fanuc;
                if (std::exchange(is_first, false) && is_gcode) {
                    program = std::string(without_end(program)) + "\nM30\n";
                }
                if (!program.ends_with('\n')) program += '\n';
                std::string text_of_warning = "the program ";
                text_of_warning += name;
                text_of_warning += " is read from ";
                text_of_warning += file;
                text_of_warning += ", with lines that count on from ";
                text_of_warning += std::to_string(lines_of(program));
                warnings.push_back({path, 0, std::move(text_of_warning)});
                program += behind(name, *text, dialect);
                found_any = true;
                break;
            }
        }
        if (!found_any) break;
    }
    return program;
}

}  // namespace tribo::job
