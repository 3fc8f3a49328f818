// SPDX-License-Identifier: MIT
#include "readers/gcode/text/tool_vectors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/vec3.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers::gcode {
namespace {

constexpr std::size_t kLookedAt = 1 << 16;  // only this many characters from the start are read
constexpr int kLeastBlocks = 3;
constexpr double kUnitLength = 2e-3;  // vectors of three decimals
// Codes that leave I J K to the lines.
constexpr std::array kPlainCodes{0.0, 1.0, 17.0, 20.0, 21.0, 40.0, 49.0, 54.0, 64.0, 80.0, 90.0, 93.0, 94.0};

struct BlockWords {
    std::array<std::optional<double>, 3> vector;
    bool has_place = false, has_other_code = false;
};

// Reads letters and numbers up to a comment; none for a block with other text.
std::optional<BlockWords> words_of(std::string_view line) {
    BlockWords words;
    for (std::size_t i = 0; i < line.size();) {
        const char c = to_upper(line[i]);
        if (c == ';' || c == '(' || c == '%') return words;
        if (is_blank(c)) {
            ++i;
            continue;
        }
        if (!is_letter(c)) return std::nullopt;
        std::size_t begin = i + 1;
        while (begin < line.size() && is_blank(line[begin])) ++begin;
        const std::size_t end = std::min(line.find_first_not_of("+-.0123456789", begin), line.size());
        const auto value = number_of(line.substr(begin, end - begin));
        if (!value) return std::nullopt;
        if (c >= 'I' && c <= 'K') words.vector[static_cast<std::size_t>(c - 'I')] = value;
        words.has_place = words.has_place || (c >= 'X' && c <= 'Z');
        const bool is_plain =
            c != 'G' || std::find(kPlainCodes.begin(), kPlainCodes.end(), *value) != kPlainCodes.end();
        words.has_other_code = words.has_other_code || !is_plain;
        i = end;
    }
    return words;
}

}  // namespace

ToolVectors tool_vectors_of(std::string_view bytes) {
    TextLines lines(bytes.substr(0, kLookedAt));
    int blocks = 0;
    bool is_upward = false;
    const bool is_cut = bytes.size() > kLookedAt;
    while (const auto line = lines.next()) {
        if (is_cut && lines.rest().empty()) break;  // half a line
        const auto words = words_of(*line);
        if (!words || words->has_other_code) return ToolVectors::none;
        const auto& [i, j, k] = words->vector;
        if (!i && !j && !k) continue;
        if (!i || !j || !k || !words->has_place) return ToolVectors::none;
        if (!(std::abs(length(Vec3{*i, *j, *k}) - 1) <= kUnitLength)) return ToolVectors::none;
        is_upward = is_upward || *k > 0;
        ++blocks;
    }
    if (blocks < kLeastBlocks) return ToolVectors::none;
    return is_upward ? ToolVectors::to_shank : ToolVectors::to_tip;
}

}  // namespace tribo::readers::gcode
