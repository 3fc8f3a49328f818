// SPDX-License-Identifier: MIT
#include "readers/gcode/command.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>

#include "readers/text/decimal_text.hpp"

namespace tribo::readers::gcode {
namespace {

constexpr double kLargestCode = 9999;

// Returns the code in tenths; none for a number that cannot be a code.
std::optional<int> tenths_of(double value) {
    if (value < 0 || value > kLargestCode) return std::nullopt;
    const double tenths = std::floor(10 * value + 0.5);
    if (std::abs(10 * value - tenths) > 1e-6) return std::nullopt;
    return static_cast<int>(tenths);
}

std::unexpected<Error> refuse(int line, const Word& word, std::string cause, std::string remedy) {
    return fail_at({}, line, word.column, std::move(cause), std::move(remedy));
}

std::unexpected<Error> refuse_code(int line, const Word& word, std::optional<int> tenths, Unread unread) {
    std::string text = tenths ? code_text(word.letter, *tenths) : word.letter + short_decimal(word.value);
    if (unread.what.empty()) {
        text += " is not known";
    } else {
        text += " (" + std::string(unread.what) + ") is not read yet";
    }
    return refuse(line, word, std::move(text), std::string(unread.remedy));
}

// G74 beside G0 to G3 sets how arcs are written: each within a quadrant (EIA RS-274-D). Alone it taps.
constexpr int kQuadrantMode = 740;
bool is_quadrant_mode(Code one, Code other) {
    const auto plain = [](Code code) { return code.tenths <= 30; };
    return (one.tenths == kQuadrantMode && plain(other)) || (other.tenths == kQuadrantMode && plain(one));
}

// Codes that do nothing but set a mode. A cycle beside G0 to G3, of another group on Fanuc controls, is none.
bool may_be_overruled(GGroup group, Code one, Code other) {
    if (group == GGroup::motion && std::max(one.tenths, other.tenths) > 30) return false;
    constexpr GGroup groups[] = {GGroup::motion,       GGroup::plane,      GGroup::distance,
                                 GGroup::feed_mode,    GGroup::units,      GGroup::cutter_side,
                                 GGroup::return_level, GGroup::work_offset};
    return std::ranges::find(groups, group) != std::end(groups);
}

std::unexpected<Error> refuse_pair(int line, const Word& word, int earlier, int later) {
    return refuse(line, word,
                  code_text(word.letter, later) + " contradicts " + code_text(word.letter, earlier) +
                      " in the same block",
                  "keep one of the two");
}

}  // namespace

std::string code_text(char letter, int tenths) {
    std::string text = letter + std::to_string(tenths / 10);
    if (tenths % 10 != 0) text += "." + std::to_string(tenths % 10);
    return text;
}

Result<void> Command::add_g(const Word& word) {
    auto tenths = tenths_of(word.value);
    // Taps with the spindle in step, in the tape format of Fanuc's series 15.
    if (tenths == 842) tenths = 840;
    if (tenths == 843) tenths = 740;
    const auto group = tenths ? group_of_g(*tenths) : std::nullopt;
    if (!group) return refuse_code(line_, word, tenths, unread_g(tenths.value_or(-1)));
    auto& place = g_[static_cast<std::size_t>(*group)];
    const Code code{*tenths, word.column};
    if (*group == GGroup::motion && place && is_quadrant_mode(*place, code)) {
        const bool is_later = code.tenths == kQuadrantMode;
        g_[static_cast<std::size_t>(GGroup::idle)] = is_later ? code : *place;
        if (!is_later) place = code;
        return {};
    }
    if (place && place->tenths != *tenths && *group != GGroup::idle) {
        if (!last_holds_ || !may_be_overruled(*group, *place, code))
            return refuse_pair(line_, word, place->tenths, *tenths);
        overruled_ = *place;
        overruling_ = code;
    }
    place = code;
    return {};
}

// Refuses codes whose meaning depends on the words beside them.
Result<void> Command::settle() {
    if (has_g(GGroup::mirror, 1000) && has('T')) {  // Brother: changes the tool, then positions
        const Code change = *g(GGroup::mirror);
        g_[static_cast<std::size_t>(GGroup::mirror)].reset();
        m_[static_cast<std::size_t>(MGroup::tool)] = Code{60, change.column};
        auto& motion = g_[static_cast<std::size_t>(GGroup::motion)];
        if (!motion) motion = Code{0, change.column};
    }
    if (next_tool_ != nullptr && !m(MGroup::tool)) {
        return refuse(line_, *next_tool_, "T stands twice in the block",
                      "delete one of the two or start a new line between them");
    }
    if (const auto units = g(GGroup::units); units && units->tenths >= 700 && has_any("DIJKLPQRUW")) {
        if (!has('I') || !has('L')) {
            return fail_at({}, line_, units->column,
                           code_text('G', units->tenths) + " (a cycle of a lathe) is not read yet",
                           "let the CAM system write it as plain G0 to G3 moves");
        }
        g_[static_cast<std::size_t>(GGroup::hole_pattern)] = units;
        g_[static_cast<std::size_t>(GGroup::units)].reset();
    }
    if (has_g(GGroup::idle, 470) && has('D')) {
        return fail_at({}, line_, g(GGroup::idle)->column,
                       "G47 with D (a move longer by two offsets) is not read yet",
                       "let the CAM system write it as a plain G0 to G3 move");
    }
    if (has_g(GGroup::idle, 1500) && has_any("PIJKQ")) {
        g_[static_cast<std::size_t>(GGroup::pocket)] =
            std::exchange(g_[static_cast<std::size_t>(GGroup::idle)], {});
        if (auto& side = g_[static_cast<std::size_t>(GGroup::cutter_side)]; side && side->tenths != 400)
            pocket_side_ = std::exchange(side, {})->tenths;
    }
    const auto cycle = g(GGroup::motion);
    if (g(GGroup::cycle_end) && cycle && cycle->tenths >= 730) {
        return fail_at({}, line_, g(GGroup::cycle_end)->column,
                       "G80 contradicts " + code_text('G', cycle->tenths) + " in the same block",
                       "keep one of the two");
    }
    return {};
}

Result<void> Command::add_m(const Word& word) {
    const auto tenths = tenths_of(word.value);
    const auto group = tenths ? group_of_m(*tenths) : std::nullopt;
    if (!group) {
        const Unread unread = tenths ? unread_m(*tenths) : Unread{"", "check the number"};
        if (!tenths || !unread.what.empty()) return refuse_code(line_, word, tenths, unread);
        unknown_m_.push_back({*tenths, word.column});
        return {};
    }
    auto& place = m_[static_cast<std::size_t>(*group)];
    // Mist and flood coolant may be on together.
    if (place && place->tenths != *tenths && *group != MGroup::coolant) {
        return refuse_pair(line_, word, place->tenths, *tenths);
    }
    place = Code{*tenths, word.column};
    return {};
}

Result<Command> Command::of(const Block& block, bool last_holds) {
    Command command;
    command.last_holds_ = last_holds;
    command.line_ = block.line;
    command.block_ = &block;
    for (const Word& word : block.words) {
        Result<void> added;
        if (word.letter == 'G') {
            added = command.add_g(word);
        } else if (word.letter == 'M') {
            added = command.add_m(word);
        } else if (const Word*& place = command.words_[index(word.letter)]; place == nullptr) {
            place = &word;
        } else if (word.letter == 'T' && command.next_tool_ == nullptr) {
            command.next_tool_ = &word;  // T1 T2 M6: the second is the tool after this one
        } else {
            added = refuse(block.line, word, std::string(1, word.letter) + " stands twice in the block",
                           "delete one of the two or start a new line between them");
        }
        if (!added) return std::unexpected(added.error());
    }
    if (auto settled = command.settle(); !settled) return std::unexpected(settled.error());
    return command;
}

bool Command::has_any(std::string_view letters) const {
    for (const char letter : letters) {
        if (has(letter)) return true;
    }
    return false;
}

bool Command::has_any_m() const {
    return !unknown_m_.empty() || std::any_of(m_.begin(), m_.end(), [](const std::optional<Code>& code) {
        return code.has_value();
    });
}

const Word* Command::use(char letter) {
    used_ |= std::uint32_t{1} << index(letter);
    return words_[index(letter)];
}

const Word* Command::first_unused() const {
    for (const Word& word : block_->words) {
        if (word.letter == 'G' || word.letter == 'M') continue;
        if ((used_ >> index(word.letter) & 1) == 0) return &word;
    }
    return nullptr;
}

}  // namespace tribo::readers::gcode
