// SPDX-License-Identifier: MIT
#include "job/input_kind.hpp"

#include <algorithm>
#include <array>

#include "base/text/file_names.hpp"
#include "job/program_file.hpp"
#include "readers/mesh/model.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::job {
namespace {

using namespace std::string_view_literals;

constexpr std::array kSections{"[stock]"sv,   "[cutter]"sv, "[[cutter]]"sv, "[material]"sv,
                               "[process]"sv, "[path]"sv,   "[part]"sv};

struct Beginning {
    std::string_view bytes;
    std::string_view likeness;
};
constexpr std::array kBeginnings{
    Beginning{"\x89PNG"sv, "looks like a picture"},
    Beginning{"\xff\xd8\xff"sv, "looks like a picture"},
    Beginning{"GIF8"sv, "looks like a picture"},
    Beginning{"%PDF"sv, "looks like a PDF document"},
    Beginning{"RIFF"sv, "looks like a recording"},
    Beginning{"fLaC"sv, "looks like a recording"},
    Beginning{"\x1f\x8b"sv, "is packed (gzip)"},
    Beginning{"PK\x03\x04"sv, "is packed (zip)"},
    Beginning{"\x7f"
              "ELF"sv,
              "looks like a program for a computer"},
    Beginning{"<"sv, "looks like XML or HTML"},
    Beginning{"{"sv, "looks like JSON"},
};

constexpr std::size_t kLookedAt = 4096;

bool has_section_of_a_job(std::string_view bytes) {
    readers::TextLines lines(bytes);
    while (const auto line = lines.next()) {
        const std::string_view text = readers::trimmed(*line);
        if (std::ranges::any_of(kSections, [&](std::string_view s) { return text.starts_with(s); }))
            return true;
    }
    return false;
}

}  // namespace

FileResult<InputKind> kind_of_input(const FileSource& files, const std::string& name) {
    if (extension_of(name) == ".toml") return InputKind{};
    const auto bytes = files.read(name, kLargestProgramBytes);
    if (!bytes) return std::unexpected(bytes.error());
    if (const auto kind = detect_program(*bytes, name)) return InputKind{kind};
    if (has_section_of_a_job(*bytes)) return InputKind{};
    return std::unexpected(FileFailure(
        {name, 0, 0, "is neither a job nor a program: it " + likeness(*bytes, name),
         "give a job (.toml), or a program: G-code, Heidenhain, Siemens, APT or keyframes (x,y,z,i,j,k)"}));
}

std::string likeness(std::string_view bytes, std::string_view name) {
    if (bytes.find_first_not_of(" \t\r\n") == std::string_view::npos) return "is empty";
    if (const std::string other(readers::other_model_format(name)); !other.empty()) {
        return "has the name of a " + other +
               " model, which is not read: export it as STL, OBJ, PLY, VRML 2.0 or glTF";
    }
    for (const Beginning& known : kBeginnings) {
        if (bytes.starts_with(known.bytes)) return std::string(known.likeness);
    }
    if (const auto model = readers::detect_model_format(bytes, name))
        return "looks like a model (" + std::string(readers::name(*model)) + ")";
    const std::string_view start = bytes.substr(0, kLookedAt);
    return start.find('\0') != std::string_view::npos ? "is no text"
                                                      : "looks like a text without blocks of a program";
}

}  // namespace tribo::job
