// SPDX-License-Identifier: MIT
#include "formats/apt_words.hpp"

#include <array>

#include "formats/apt_lexer.hpp"

namespace tribo::formats::apt {
namespace {

struct Entry {
    std::string_view word;
    Meaning meaning;
};

constexpr Meaning kNothing{Action::nothing, {}};
constexpr Meaning kCircle{Action::unread, "circular moves"};
constexpr Meaning kFrame{Action::unread, "coordinate systems"};
constexpr Meaning kComputed{Action::unread, "moves that an APT processor computes"};
constexpr Meaning kRotary{Action::unread, "moves of rotary axes"};
constexpr Meaning kProgram{Action::unread, "loops, macros and copies"};

// The most frequent first.
constexpr std::array kWords{
    Entry{"GOTO", {Action::go_to, {}}},
    Entry{"RAPID", {Action::rapid, {}}},
    Entry{"FEDRAT", {Action::feed, {}}},
    Entry{"FROM", {Action::from, {}}},
    Entry{"SPINDL", {Action::spindle, {}}},
    Entry{"LOADTL", {Action::load, {}}},
    Entry{"LOAD", {Action::load, {}}},
    Entry{"CUTTER", {Action::cutter, {}}},
    Entry{"MULTAX", {Action::multi_axis, {}}},
    Entry{"UNITS", {Action::units, {}}},
    Entry{"UNIT", {Action::units, {}}},
    Entry{"DELAY", {Action::delay, {}}},
    Entry{"CUTCOM", {Action::compensation, {}}},
    Entry{"FINI", {Action::end, {}}},
    Entry{"MACHIN", kNothing},
    Entry{"COOLNT", kNothing},
    Entry{"INTOL", kNothing},
    Entry{"OUTTOL", kNothing},
    Entry{"TOLER", kNothing},
    Entry{"SEQNO", kNothing},
    Entry{"OPSTOP", kNothing},
    Entry{"STOP", kNothing},
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
    Entry{"CIRCLE", kCircle},
    Entry{"MOVARC", kCircle},
    Entry{"ARCSLP", kCircle},
    Entry{"CYCLE", {Action::unread, "canned cycles"}},
    Entry{"GODLTA", {Action::unread, "incremental moves"}},
    Entry{"GOHOME", {Action::unread, "moves to the machine's home"}},
    Entry{"RETRCT", {Action::unread, "retractions to a plane"}},
    Entry{"CLEARP", {Action::unread, "clearance planes"}},
    Entry{"CSYS", kFrame},
    Entry{"MSYS", kFrame},
    Entry{"TRNTYP", kFrame},
    Entry{"TRANS", kFrame},
    Entry{"ORIGIN", kFrame},
    Entry{"TRACUT", kFrame},
    Entry{"MODIFY", kFrame},
    Entry{"ROTATE", kRotary},
    Entry{"ROTABL", kRotary},
    Entry{"ROTHED", kRotary},
    Entry{"TLAXIS", kComputed},
    Entry{"GOFWD", kComputed},
    Entry{"GOBACK", kComputed},
    Entry{"GOLFT", kComputed},
    Entry{"GORGT", kComputed},
    Entry{"GOUP", kComputed},
    Entry{"GODOWN", kComputed},
    Entry{"COPY", kProgram},
    Entry{"INDEX", kProgram},
    Entry{"CALL", kProgram},
    Entry{"MACRO", kProgram},
    Entry{"TURRET", {Action::unread, "turrets"}},
    Entry{"TOOLNO", {Action::unread, "tool tables"}},
    Entry{"TLDATA", {Action::unread, "tool tables"}},
    Entry{"TOOL PATH", {Action::unread, "tool path headers of NX"}},
};

}  // namespace

Meaning meaning_of(std::string_view word) {
    for (const Entry& entry : kWords) {
        if (matches(word, entry.word)) return entry.meaning;
    }
    return {};
}

}  // namespace tribo::formats::apt
