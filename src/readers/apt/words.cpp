// SPDX-License-Identifier: MIT
#include "readers/apt/words.hpp"

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
constexpr Meaning kRotary{Action::unread, "moves of rotary axes"};
constexpr Meaning kProgram{Action::unread, "loops, macros and copies"};
constexpr Meaning kTurned{Action::unread, "transformations of what was written before"};

// The most frequent first.
constexpr std::array kWords{
    Entry{"GOTO", {Action::go_to, {}}},
    Entry{"CIRCLE", {Action::circle, {}}},
    Entry{"RAPID", {Action::rapid, {}}},
    Entry{"FEDRAT", {Action::feed, {}}},
    Entry{"MOVARC", {Action::circle, {}}},
    Entry{"INDIRV", {Action::direction, {}}},
    Entry{"TLON,GOFWD", {Action::circle_catia, {}}},
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
    Entry{"TOOLNO", kNothing},
    Entry{"AUTOPS", kNothing},
    Entry{"TOOL PATH", kNothing},
    Entry{"END-OF-PATH", kNothing},
    Entry{"CSI_SET_FLUTE_LENGTH", kNothing},
    Entry{"CSI_SET_EXTENSION_LENGTH", kNothing},
    Entry{"ARCSLP", {Action::unread, "slopes of helices"}},
    Entry{"TRACUT", kTurned},
    Entry{"MODIFY", kTurned},
    Entry{"ROTATE", kRotary},
    Entry{"ROTABL", kRotary},
    Entry{"ROTHED", kRotary},
    Entry{"INDIRP", kSource},
    Entry{"GOFWD", kSource},
    Entry{"GOBACK", kSource},
    Entry{"GOLFT", kSource},
    Entry{"GORGT", kSource},
    Entry{"GOUP", kSource},
    Entry{"GODOWN", kSource},
    Entry{"PSIS", kSource},
    Entry{"COPY", kProgram},
    Entry{"INDEX", kProgram},
    Entry{"CALL", kProgram},
    Entry{"MACRO", kProgram},
    Entry{"THREAD", {Action::unread, "threads"}},
    Entry{"TURRET", {Action::unread, "turrets"}},
};

}  // namespace

Meaning meaning_of(std::string_view word) {
    for (const Entry& entry : kWords) {
        if (matches(word, entry.word)) return entry.meaning;
    }
    return {};
}

}  // namespace tribo::readers::apt
