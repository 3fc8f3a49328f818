// SPDX-License-Identifier: MIT
#include "readers/apt/words.hpp"

#include <algorithm>
#include <array>

#include "readers/apt/lexer.hpp"

namespace tribo::readers::apt {
namespace {

struct Entry {
    std::string_view word;
    Meaning meaning;
};

constexpr Meaning kNothing{Action::nothing, {}};
constexpr Meaning kSource{Action::unread, "moves that an APT processor computes"};
constexpr Meaning kForward{Action::circle_catia, "moves that an APT processor computes"};
constexpr Meaning kRotary{Action::turn, "moves of rotary axes"};
constexpr Meaning kProgram{Action::unread, "loops, macros and copies"};
constexpr Meaning kSpline{Action::unread, "curves between points"};
constexpr Meaning kTurned{Action::unread, "transformations of what was written before"};

// The most frequent first.
constexpr std::array kWords{
    Entry{"GOTO", {Action::go_to, {}}},
    Entry{"CIRCLE", {Action::circle, {}}},
    Entry{"RAPID", {Action::rapid, {}}},
    Entry{"FEDRAT", {Action::feed, {}}},
    Entry{"MOVARC", {Action::circle, {}}},
    Entry{"INDIRV", {Action::direction, {}}},
    Entry{"TLON,GOFWD", kForward},
    Entry{"GODLTA", {Action::go_by, {}}},
    Entry{"GOHOME", {Action::go_home, {}}},
    Entry{"CYCLE", {Action::cycle, {}}},
    Entry{"CLEARP", {Action::clearance, {}}},
    Entry{"RETRCT", {Action::retract, {}}},
    Entry{"FROM", {Action::from, {}}},
    Entry{"SPINDL", {Action::spindle, {}}},
    Entry{"LOADTL", {Action::load, {}}},
    Entry{"LOAD", {Action::load, {}}},
    Entry{"CUTTER", {Action::cutter, {}}},
    Entry{"TLDATA", {Action::tool_data, {}}},
    Entry{"MULTAX", {Action::multi_axis, {}}},
    Entry{"TLAXIS", {Action::tool_axis, {}}},
    Entry{"UNITS", {Action::units, {}}},
    Entry{"UNIT", {Action::units, {}}},
    Entry{"MSYS", {Action::machine_frame, {}}},
    Entry{"CSYS", {Action::frame, {}}},
    Entry{"MCSYS", {Action::work_frame, {}}},
    Entry{"MODE", {Action::mode, {}}},
    Entry{"TRNTYP", {Action::frame_type, {}}},
    Entry{"TRANS", {Action::translation, {}}},
    Entry{"ORIGIN", {Action::origin, {}}},
    Entry{"DELAY", {Action::delay, {}}},
    Entry{"CUTCOM", {Action::compensation, {}}},
    Entry{"PREFUN", {Action::machine_code, {}}},
    Entry{"AUXFUN", {Action::machine_code, {}}},
    Entry{"FINI", {Action::end, {}}},
    Entry{"MACHIN", kNothing},
    Entry{"COOLNT", kNothing},
    Entry{"INTOL", kNothing},
    Entry{"OUTTOL", kNothing},
    Entry{"TOLER", kNothing},
    Entry{"LINTOL", kNothing},
    Entry{"MCHTOL", kNothing},
    Entry{"MCHFIN", kNothing},
    Entry{"SEQNO", kNothing},
    Entry{"OPSTOP", kNothing},
    Entry{"OPSKIP", kNothing},
    Entry{"STOP", kNothing},
    Entry{"BREAK", kNothing},
    Entry{"END", kNothing},
    Entry{"REWIND", kNothing},
    Entry{"TMARK", kNothing},
    Entry{"LEADER", kNothing},
    Entry{"CLPRNT", kNothing},
    Entry{"NOPOST", kNothing},
    Entry{"DISPLY", kNothing},
    Entry{"PAINT", kNothing},
    Entry{"SELECT", kNothing},
    Entry{"SELCTL", kNothing},
    Entry{"CLAMP", kNothing},
    Entry{"TOOLNO", {Action::tool_kind, {}}},
    Entry{"AUTOPS", kNothing},
    Entry{"TOOL PATH", kNothing},
    Entry{"END-OF-PATH", kNothing},
    Entry{"CSI_SET_FLUTE_LENGTH", kNothing},
    Entry{"CSI_SET_EXTENSION_LENGTH", kNothing},
    Entry{"ARCSLP", {Action::arc_slope, {}}},
    Entry{"TRACUT", {Action::transform, {}}},
    Entry{"MODIFY", kTurned},
    Entry{"ROTATE", kRotary},
    Entry{"ROTABL", kRotary},
    Entry{"ROTHED", kRotary},
    Entry{"INDIRP", {Action::direction, {}}},
    Entry{"PSIS", {Action::surface, {}}},
    Entry{"GOFWD", kForward},
    Entry{"TLON", kNothing},
    Entry{"GOBACK", kSource},
    Entry{"GOLFT", kSource},
    Entry{"GORGT", kSource},
    Entry{"GOUP", kSource},
    Entry{"GODOWN", kSource},
    Entry{"TLLFT", kSource},
    Entry{"TLRGT", kSource},
    Entry{"TLLFT,GOLFT", kSource},
    Entry{"TLLFT,GOFWD", kSource},
    Entry{"TLRGT,GORGT", kSource},
    Entry{"TLRGT,GOFWD", kSource},
    Entry{"POCKET", kSource},
    Entry{"PMILL", kSource},
    Entry{"SMILL", kSource},
    Entry{"FMILL", kSource},
    Entry{"VMILL", kSource},
    Entry{"SCRUB", kSource},
    Entry{"SCONTR", kSource},
    Entry{"CONTUR", kSource},
    Entry{"LATHE", kSource},
    Entry{"THICK", kSource},
    Entry{"PATERN", kSource},
    Entry{"NURBS", kSpline},
    Entry{"SPLINE", kSpline},
    Entry{"BSPLIN", kSpline},
    Entry{"HELIX", kSpline},
    Entry{"COPY", kProgram},
    Entry{"INDEX", kProgram},
    Entry{"CALL", kProgram},
    Entry{"MACRO", kProgram},
    Entry{"CALSUB", kProgram},
    Entry{"DEFSUB", kProgram},
    Entry{"LOOPST", kProgram},
    Entry{"LOOPND", kProgram},
    Entry{"JUMPTO", kProgram},
    Entry{"DO", kProgram},
    Entry{"UNDO", kProgram},
    Entry{"REFSYS", kTurned},
    Entry{"MIRROR", kTurned},
    Entry{"ZSURF", kTurned},
    Entry{"THREAD", {Action::unread, "threads"}},
};

// Equal but for case and blanks beside commas.
bool is_word(std::string_view text, std::string_view word) {
    for (;;) {
        const std::size_t comma = text.find(','), other = word.find(',');
        if (!matches(trimmed(text.substr(0, comma)), word.substr(0, other))) return false;
        if (comma == std::string_view::npos || other == std::string_view::npos) return comma == other;
        text.remove_prefix(comma + 1);
        word.remove_prefix(other + 1);
    }
}

}  // namespace

Meaning meaning_of(std::string_view word) {
    if (word.ends_with(',')) word.remove_suffix(1);
    for (const Entry& entry : kWords) {
        if (is_word(word, entry.word)) return entry.meaning;
    }
    return {};
}

bool is_post_word(std::string_view word) {
    word = trimmed(word.substr(0, word.find(',')));
    if (word.size() < 2 || !is_letter(word[0]) || !is_letter(word[1])) return false;
    return std::ranges::all_of(word,
                               [](char c) { return is_letter(c) || is_digit(c) || c == '_' || c == '-'; });
}

}  // namespace tribo::readers::apt
