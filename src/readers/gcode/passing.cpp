// SPDX-License-Identifier: MIT
#include "readers/gcode/passing.hpp"

#include <algorithm>
#include <string>

#include "readers/text/text_lines.hpp"

namespace tribo::readers::gcode {
namespace {

// Numbers of offsets, tools and times, extrusion of printers: alone they move no axis.
constexpr std::string_view kHarmless = "DEHLPQ";
constexpr int kRigidTapping = 290;

std::unexpected<Error> refuse_unused(const Command& command, const Word& word, const Output& output) {
    const std::string letter(1, word.letter);
    switch (word.letter) {
        case 'I':
        case 'J':
        case 'K':
            return output.refuse(command.line(), word.column, letter + " without an arc to use it",
                                 "write G2 or G3 before it, G43.5 where I J K are the tool's axis, or delete "
                                 "the word");
        case 'R':
            return output.refuse(command.line(), word.column, "R without an arc to use it",
                                 "write G2 or G3 before it, ,R for a round corner, or delete the word");
        default:
            return output.refuse(command.line(), word.column, letter + " without a code that uses it",
                                 "delete the word, or add the code that it belongs to");
    }
}

}  // namespace

void note_writing(const Block& block, Output& output) {
    if (block.has_nested_comment && output.first(Note::nested_comment)) {
        output.warn(
            block.line,
            "a comment stands inside another one: both are passed over; some controls end them at the "
            "first ')'");
    }
    if (block.has_open_comment && output.first(Note::open_comment)) {
        output.warn(block.line, "a comment is not closed: it is taken to end with its line");
    }
    if (block.has_print && output.first(Note::print)) {
        output.warn(block.line, "output to a printer or a file (DPRNT and the like) is left out");
    }
    if (block.has_deleted_rest && output.first(Note::deleted_rest)) {
        output.warn(block.line, "what follows '/' in a block is skipped, as with block delete switched on");
    }
}

void note_least_increments(const State& state, Output& output) {
    constexpr double large_mm = 1000;
    if (output.options.dialect != GcodeDialect::fanuc || state.largest_mm < large_mm) return;
    TextLines lines(output.text);
    while (const auto line = lines.next()) {
        const std::string_view code = line->substr(0, line->find_first_of("(;"));
        for (std::size_t at = 0; at < code.size(); ++at) {
            const char letter = to_upper(code[at]);
            if (letter < 'X' || letter > 'Z') continue;
            const std::size_t end = std::min(code.find_first_not_of("+-0123456789", at + 1), code.size());
            // A point, or a formula.
            if (end < code.size() && std::string_view(".#[").find(code[end]) != std::string_view::npos)
                return;
        }
    }
    output.warn(
        0,
        "no coordinate has a point, and some are large: a Fanuc control that is set up so counts them in "
        "thousandths of a millimetre (parameter 3401, DPI); whole millimetres or inches are taken");
}

bool pass_drawing_data(const Block& block, const State& state, Output& output) {
    constexpr double first = 1900, box = 1902, last = 1999;
    if (output.options.dialect != GcodeDialect::fanuc || block.words.empty()) return false;
    const Word& code = block.words.front();
    if (code.letter != 'G' || code.value < first || code.value > last) return false;
    // B D H along X Y Z; I J K from a corner, and from the top, to the zero.
    const auto mm = [&](char letter) {
        const auto word = std::ranges::find(block.words, letter, &Word::letter);
        return word == block.words.end() ? 0.0 : word->value * state.unit_mm;
    };
    const Vec3 size{mm('B'), mm('D'), mm('H')}, zero{mm('I'), mm('J'), mm('K')};
    const bool is_stock = code.value == box && zero.z == 0 && size.x > 0 && size.y > 0 && size.z > 0;
    if (is_stock) {
        Box3 stock;
        stock.include(Vec3{-zero.x, -zero.y, -size.z});
        stock.include(Vec3{size.x - zero.x, size.y - zero.y, 0});
        output.program.stock = motion::DeclaredStock{stock, block.line};
    }
    if (output.first(Note::drawing_data)) {
        output.warn(block.line, is_stock ? "G1902 (the blank that MANUAL GUIDE i draws) is taken as the stock"
                                         : "G1900 to G1999 tell MANUAL GUIDE i what to draw: left out");
    }
    return true;
}

void pass_unknown_codes(Command& command, Output& output) {
    if (command.unknown_m().empty()) return;
    for (const Code code : command.unknown_m()) {
        // M29 S500: the tapping that follows is rigid.
        if (code.tenths == kRigidTapping && output.options.dialect == GcodeDialect::fanuc) continue;
        if (!output.first(Note::unknown_m, code.tenths)) continue;
        output.warn(command.line(), code_text('M', code.tenths) +
                                        " is not known: it is taken as a switch of the machine that moves "
                                        "nothing");
    }
    if (!command.g(GGroup::motion) && !command.has_any("XYZABC")) command.use_rest();
}

Result<void> pass_unused_words(Command& command, State& state, Output& output) {
    const std::optional<Word>& corner = command.block().corner;
    const bool is_at_feed = state.motion == MotionMode::line || state.motion == MotionMode::arc_clockwise ||
                            state.motion == MotionMode::arc_counter_clockwise;
    if (corner && !(is_at_feed && command.has_any("XYZ"))) {
        return output.refuse(command.line(), corner->column, "a corner (,R or ,C) without a feed move",
                             "write it beside X and Y at feed, or delete it");
    }
    while (const Word* word = command.first_unused()) {
        // Surface normals of compensation in space, which the programmed path does not need.
        const bool is_normal = state.compensation.is_on && state.compensation.code % 10 > 1 &&
                               word->letter >= 'I' && word->letter <= 'K';
        const bool is_harmless = is_normal || kHarmless.find(word->letter) != std::string_view::npos;
        if (!is_harmless && word->value != 0) return refuse_unused(command, *word, output);
        command.use(word->letter);
        if (word->letter == 'D') {
            const Compensation& comp = state.compensation;
            if (comp.is_on && comp.left_mm != 0 && word->value != comp.number) {
                return output.refuse(command.line(), word->column,
                                     "D changes the cutter compensation that line " +
                                         std::to_string(comp.line) + " has switched on",
                                     "write G40 before it, and G41 or G42 beside D");
            }
            state.offset_number = word->value;
            // On Fanuc controls it holds for the next G41.
            if (output.options.dialect == GcodeDialect::fanuc) continue;
        }
        if (word->letter == 'H' && word->value == 0) continue;  // no offset
        if (!output.first(Note::unused_word, word->letter)) continue;
        std::string text = std::string(1, word->letter) + " is used by no code of its block: it is left out";
        if (word->letter == 'E') text += "; a program with many E words is one for a printer";
        output.warn(command.line(), std::move(text));
    }
    return {};
}

void pass_setting(const Block& block, State& state, Output& output) {
    if (output.first(Note::setting)) {
        output.warn(block.line, "a line that begins with '$' is for the machine and left out: " +
                                    std::string(block.setting.substr(0, 20)));
    }
    const bool goes_home = block.setting.size() > 1 && to_upper(block.setting[1]) == 'H';
    if (!goes_home) return;
    for (Known& known : state.known) {
        if (known == Known::yes) known = Known::lost;
    }
    state.lost_line = block.line;
}

void note_lathe(const State& state, Output& output) {
    if (state.plane != Plane::zx || state.has_y || output.moves == 0) return;
    output.warn(
        0,
        "the program moves X and Z alone, in G18: if it is for a lathe, its X are diameters and it is not "
        "read rightly");
}

}  // namespace tribo::readers::gcode
