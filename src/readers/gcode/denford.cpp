// SPDX-License-Identifier: MIT
#include "readers/gcode/denford.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "base/limits.hpp"
#include "readers/control/block_text.hpp"
#include "readers/text/decimal_text.hpp"

namespace tribo::readers::gcode {
namespace {

// The numbers behind the letters D T X Y Z; none where the line holds anything else.
struct Numbers {
    static constexpr std::string_view kLetters = "DTXYZ";
    std::array<std::optional<double>, kLetters.size()> value;

    std::optional<double> of(char letter) const { return value[kLetters.find(letter)]; }
};

std::optional<Numbers> numbers_of(std::string_view text) {
    Numbers numbers;
    for (std::size_t at = text.find_first_not_of(" \t"); at < text.size();) {
        const std::size_t letter = Numbers::kLetters.find(to_upper(text[at]));
        const std::size_t begin = std::min(text.find_first_not_of(" \t", at + 1), text.size());
        const std::size_t end = std::min(text.find_first_not_of("+-.0123456789", begin), text.size());
        const auto value = number_of(text.substr(begin, end - begin));
        if (letter == std::string_view::npos || !value) return std::nullopt;
        numbers.value[letter] = value;
        at = text.find_first_not_of(" \t", end);
    }
    return numbers;
}

bool is_place(Vec3 p) {
    const Range& range = kLimits.coordinate.range;
    return range.contains(p.x) && range.contains(p.y) && range.contains(p.z);
}

}  // namespace

Result<void> take_denford_line(const Block& block, State& state, Output& output) {
    const std::string_view line = block.setting.substr(1, block.setting.find_first_of("];(") - 1);
    const std::size_t end = std::min(line.find_first_of(" \t"), line.size());
    const std::string name = upper(line.substr(0, end));
    const auto numbers = numbers_of(line.substr(end));
    const auto x = numbers ? numbers->of('X') : std::nullopt, y = numbers ? numbers->of('Y') : std::nullopt;
    if (name == "BILLET" && x && y && numbers->of('Z')) {
        const Vec3 size{*x, *y, *numbers->of('Z')};
        const bool has_volume = size.x > 0 && size.y > 0 && size.z > 0;
        if (!has_volume || !is_place(size)) {
            return output.refuse(block.line, 1, "this billet has no volume, or is larger than any machine",
                                 "correct its sizes");
        }
        state.billet = {size, state.billet.corner, block.line};
        output.warn(block.line, "[BILLET is taken as the stock, its top at Z0");
        return {};
    }
    if (name == "EDGEMOVE" && x && y && is_place({*x, *y, 0})) {
        state.billet.corner = {*x, *y, 0};
        return {};
    }
    const auto tool = numbers ? numbers->of('T') : std::nullopt,
               d = numbers ? numbers->of('D') : std::nullopt;
    if (name == "TOOLDEF" && tool && d && kLimits.tool_number.range.contains(*tool)) {
        output.notes.read("T" + short_decimal(*tool, 0) + " D=" + short_decimal(*d), block.line);
        return {};
    }
    return output.refuse(block.line, 1, "'[" + name.substr(0, 20) + "' is not read",
                         "delete the line, or write [BILLET X Y Z, [EDGEMOVE X Y or [TOOLDEF T D");
}

void declare_billet(const State& state, Output& output) {
    const Vec3 size = state.unit_mm * state.billet.size, corner = state.unit_mm * state.billet.corner;
    if (state.billet.line == 0) return;
    Box3 stock;
    stock.include(corner - Vec3{0, 0, size.z});
    stock.include(corner + Vec3{size.x, size.y, 0});
    output.program.stock = motion::DeclaredStock{stock, state.billet.line};
}

}  // namespace tribo::readers::gcode
