// SPDX-License-Identifier: MIT
#include "house/house_rules.hpp"

#include <algorithm>
#include <array>
#include <regex>
#include <sstream>

namespace tribo::house {
namespace {

using Names = std::set<std::string>;

struct Line {
    int number;
    std::string text;
};

std::vector<Line> lines_of(std::string_view text) {
    std::vector<Line> lines;
    std::istringstream in{std::string(text)};
    std::string line;
    while (std::getline(in, line)) lines.push_back({static_cast<int>(lines.size()) + 1, line});
    return lines;
}

// What the compiler sees of a line, without the text of strings.
std::string code_of(const std::string& line) {
    std::string code;
    bool in_string = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (in_string && line[i] == '\\') {
            ++i;
        } else if (line[i] == '"' && (i == 0 || line[i - 1] != '\'')) {
            in_string = !in_string;
        } else if (!in_string) {
            if (line.compare(i, 2, "//") == 0) break;
            code += line[i];
        }
    }
    return code;
}

std::string complaint(const std::string& path, int line, const std::string& text) {
    return path + ":" + std::to_string(line) + ": " + text;
}

const Room* room_named(const std::string& name) {
    const auto found = std::ranges::find(rooms(), name, &Room::name);
    return found == rooms().end() ? nullptr : &*found;
}

// The room that a source under src/ stands in; null elsewhere.
const Room* room_of(const std::string& path) {
    if (!path.starts_with("src/")) return nullptr;
    return room_named(path.substr(4, path.find('/', 4) - 4));
}

constexpr int kMostLines = 600;

}  // namespace

const std::vector<Room>& rooms() {
    const Names core{"base",  "contact", "motion",  "field",   "surface", "milling", "dynamics",
                     "sweep", "noise",   "elastic", "haptics", "sound",   "readers"};
    const auto with = [](Names names, const Names& more) {
        names.insert(more.begin(), more.end());
        return names;
    };
    static const std::vector<Room> table{
        {"base", "-", {}, true},
        {"contact", "base", {"base"}, true},
        {"motion", "base", {"base"}, true},
        {"field", "base contact", {"base", "contact"}, true},
        {"surface", "base contact field", {"base", "contact", "field"}, true},
        {"milling", "base contact motion field", {"base", "contact", "motion", "field"}, true},
        {"dynamics", "base contact motion milling", {"base", "contact", "motion", "milling"}, false},
        {"sweep", "base", {"base"}, true},
        {"noise", "base", {"base"}, true},
        {"elastic", "base contact", {"base", "contact"}, true},
        {"haptics", "base contact", {"base", "contact"}, true},
        {"sound", "base contact noise", {"base", "contact", "noise"}, true},
        {"readers", "base contact motion milling", {"base", "contact", "motion", "milling"}, true},
        {"job", "the rooms down to readers", core, true},
        {"files", "base contact sound readers job", {"base", "contact", "sound", "readers", "job"}, false},
        {"material", "base noise files", {"base", "noise", "files"}, false},
        {"protocol", "the rooms down to files", with(core, {"files", "job"}), false},
        {"session", "all above but files and material", with(core, {"job", "protocol"}), true},
        {"report", "the rooms down to material", with(core, {"files", "material", "job"}), false},
        {"wasm", "all above but files and report", with(core, {"material", "job", "protocol", "session"}),
         true},
        {"tribo", "the rooms down to session", with(core, {"files", "material", "job", "session"}), false},
        {"net", "base", {"base"}, false},
        {"devices", "base contact haptics net", {"base", "contact", "haptics", "net"}, false},
        {"app", "all above but wasm",
         with(core, {"files", "material", "job", "protocol", "session", "report", "tribo", "net", "devices"}),
         false},
    };
    return table;
}

std::vector<std::string> include_complaints(const std::string& path, std::string_view text) {
    static const std::regex include(R"re(^\s*#\s*include\s*"([^"]*)")re");
    std::vector<std::string> complaints;
    const Room* room = room_of(path);
    if (path.starts_with("src/") && room == nullptr && std::ranges::count(path, '/') > 1)
        complaints.push_back(complaint(path, 1, "stands in a room that is not in the table"));
    for (const Line& line : lines_of(text)) {
        std::smatch match;
        if (!std::regex_search(line.text, match, include)) continue;
        const std::string target = match[1];
        const bool bare = target.find('/') == std::string::npos;
        if (target.find("..") != std::string::npos || (bare && room != nullptr)) {
            complaints.push_back(
                complaint(path, line.number, "name a header from its root: \"" + target + "\""));
            continue;
        }
        if (bare) continue;
        const std::string other = target.substr(0, target.find('/'));
        if (room == nullptr || other == room->name) continue;
        if (!room->may_include.contains(other))
            complaints.push_back(
                complaint(path, line.number, room->name + "/ may not include " + other + "/"));
    }
    return complaints;
}

std::vector<std::string> same_bits_complaints(const std::string& path, std::string_view text) {
    struct Ban {
        std::regex pattern;
        const char* reason;
    };
    static const std::array bans{
        Ban{std::regex(
                R"(\bstd::(a?(sin|cos|tan)h?|atan2|exp2?|expm1|log(2|10|1p)?|pow|cbrt|hypot|t?gamma|erfc?)l?f?\s*\()"),
            "differs between systems: take it from base/math.hpp"},
        Ban{std::regex(R"(\bstd::unordered_)"), "has no defined order: use a sorted container"},
        Ban{std::regex(R"(\bstd::\w+_distribution\b|\bstd::rand\b|\bstd::random_device\b)"),
            "differs between libraries: use base/noise_hash.hpp"},
        Ban{std::regex(R"(\bstd::(j?thread|async|mutex|atomic|reduce|execution)\b)"),
            "threads come in from outside: take a ParallelFor"},
        Ban{std::regex(R"(\b(throw|try|catch|dynamic_cast|typeid)\b)"),
            "rooms down to wasm/ have neither exceptions nor type information: give a Result"},
        Ban{std::regex(
                R"(#\s*include\s*<(iostream|fstream|sstream|cstdio|filesystem|regex|locale|iomanip)>)"),
            "rooms down to wasm/ know no streams, files, locales or regular expressions"},
        Ban{std::regex(R"(\bstd::(sto(d|f|ld)|strto(d|f|ld)|atof)\b)"),
            "use parse_decimal of base/text/decimal.hpp"},
    };
    std::vector<std::string> complaints;
    const Room* room = room_of(path);
    if (room == nullptr || !room->same_bits) return complaints;
    // The one place where two threads meet, for what a servo or a sound card takes over.
    const bool is_hand_over = path == "src/base/hand_over.hpp";
    for (const Line& line : lines_of(text)) {
        const std::string code = code_of(line.text);
        std::smatch match;
        for (const Ban& ban : bans)
            if (!is_hand_over && std::regex_search(code, match, ban.pattern))
                complaints.push_back(complaint(path, line.number, match.str() + ": " + ban.reason));
    }
    return complaints;
}

std::vector<std::string> form_complaints(const std::string& path, std::string_view text) {
    // Spelt apart, so that this file does not complain of itself.
    static const std::regex unfinished(
        "\\b(TO"
        "DO|FIX"
        "ME|XX"
        "X)\\b");
    std::vector<std::string> complaints;
    const std::vector<Line> lines = lines_of(text);
    if (lines.empty() || lines.front().text != "// SPDX-License-Identifier: MIT")
        complaints.push_back(complaint(path, 1, "the first line is // SPDX-License-Identifier: MIT"));
    if (lines.size() > kMostLines)
        complaints.push_back(
            complaint(path, kMostLines, "longer than 600 lines: split it by what it answers"));
    if (path.ends_with(".hpp") && text.find("\n#pragma once\n") == std::string_view::npos)
        complaints.push_back(complaint(path, 1, "a header needs #pragma once"));
    for (const Line& line : lines)
        if (std::regex_search(line.text, unfinished))
            complaints.push_back(complaint(path, line.number, "finish it, or open an issue"));
    return complaints;
}

std::set<std::string> helpers_of(std::string_view text) {
    static const std::regex definition(R"(^[A-Za-z_][\w:<>,&*\s]*?[\s&*](\w+)\(.*)");
    static const std::regex other(
        R"(^(return|if|for|else|using|namespace|typedef|static_assert|extern)\b.*)");
    std::set<std::string> names;
    bool is_inside = false;
    for (const Line& line : lines_of(text)) {
        std::smatch match;
        if (line.text == "namespace {") is_inside = true;
        if (line.text == "}  // namespace") is_inside = false;
        const bool may_define =
            is_inside && !line.text.starts_with(' ') && line.text.find('(') != std::string::npos;
        if (may_define && !std::regex_match(line.text, other) &&
            std::regex_match(line.text, match, definition))
            names.insert(match[1]);
    }
    return names;
}

}  // namespace tribo::house
