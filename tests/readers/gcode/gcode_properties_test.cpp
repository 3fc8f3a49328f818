// SPDX-License-Identifier: MIT
// What may be done to a G-code text without changing what it says.
#include <cmath>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <string>
#include <vector>

#include "readers/gcode/gcode_text.hpp"
#include "readers/text/decimal_text.hpp"

namespace tribo::readers {
namespace {

using motion::Move;
using motion::Program;

// Blocks of lines, arcs and mode changes in thousandths of a unit, feeds in whole units.
struct RandomProgram {
    std::vector<std::string> lines;
    std::string text() const {
        std::string all;
        for (const std::string& line : lines) all += line + "\n";
        return all;
    }
};

std::string number(int thousandths) {
    return short_decimal(thousandths / 1000.0, 3);
}

RandomProgram random_program(const char* unit_word) {
    RandomProgram program;
    program.lines = {unit_word, "M3 S1000", "G0 X0 Y0 Z5", "F100"};
    const int blocks = *rc::gen::inRange(1, 30);
    for (int i = 0; i < blocks; ++i) {
        const int x = *rc::gen::inRange(-50'000, 50'000), y = *rc::gen::inRange(-50'000, 50'000);
        const int z = *rc::gen::inRange(-9'000, 9'000), r = *rc::gen::inRange(1, 9'000);
        switch (*rc::gen::inRange(0, 6)) {
            case 0:
                program.lines.push_back("G0 X" + number(x) + " Z" + number(z));
                break;
            case 1:
                program.lines.push_back("G1 X" + number(x) + " Y" + number(y));
                break;
            case 2:
                program.lines.push_back("G3 I" + number(r) + " J" + number(-r) + " Z" + number(z));
                break;
            case 3:
                program.lines.push_back("G91 G2 X" + number(r) + " Y" + number(r) + " R" + number(r));
                program.lines.push_back("G90");
                break;
            case 4:
                program.lines.push_back("G1 Y" + number(y) + " F" + std::to_string(10 + r));
                break;
            default:
                program.lines.push_back("G1 Z" + number(z));
                break;
        }
    }
    return program;
}

bool same_but_for_lines(const Program& a, const Program& b) {
    if (a.moves.size() != b.moves.size()) return false;
    for (std::size_t i = 0; i < a.moves.size(); ++i) {
        const Move &p = a.moves[i], &q = b.moves[i];
        if (p.kind != q.kind || !(p.start == q.start) || !(p.end == q.end) ||
            p.feed_mm_per_min != q.feed_mm_per_min || p.arc.has_value() != q.arc.has_value()) {
            return false;
        }
        if (p.arc && (p.arc->centre_mm != q.arc->centre_mm || p.arc->turn_rad != q.arc->turn_rad))
            return false;
    }
    return true;
}

RC_GTEST_PROP(GcodeText, CommentsBlankLinesAndLineNumbersChangeNothing, ()) {
    const RandomProgram plain = random_program("G21");
    RandomProgram dressed;
    for (const std::string& line : plain.lines) {
        std::string out;
        if (*rc::gen::arbitrary<bool>()) out += "N" + std::to_string(*rc::gen::inRange(0, 99'999)) + " ";
        for (const char c : line) {
            const bool lower = *rc::gen::arbitrary<bool>();
            out += lower && c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
            if (*rc::gen::inRange(0, 8) == 0) out += *rc::gen::element<std::string>(" ", "\t", "  ");
        }
        out += *rc::gen::element<std::string>("", " (X99)", "; G1 X99", "\r", " ( \xE4 )\r");
        dressed.lines.push_back(out);
        if (*rc::gen::arbitrary<bool>())
            dressed.lines.push_back(*rc::gen::element<std::string>("", "  ", "(x)"));
    }
    const Program a = program_of(plain.text()), b = program_of(dressed.text());
    RC_ASSERT(same_but_for_lines(a, b));
}

RC_GTEST_PROP(GcodeText, InchesAreMillimetresTimes25_4, ()) {
    RandomProgram metric = random_program("G21");
    RandomProgram inch = metric;
    inch.lines[0] = "G20";
    const Program a = program_of(metric.text()), b = program_of(inch.text());
    RC_ASSERT(a.moves.size() == b.moves.size());
    for (std::size_t i = 0; i < a.moves.size(); ++i) {
        const Move &p = a.moves[i], &q = b.moves[i];
        RC_ASSERT(distance(25.4 * p.end.tip_mm, q.end.tip_mm) < 1e-9);
        RC_ASSERT(std::abs(25.4 * p.feed_mm_per_min - q.feed_mm_per_min) < 1e-6);
        RC_ASSERT(std::abs(25.4 * motion::path_length_mm(p) - motion::path_length_mm(q)) < 1e-6);
    }
}

RC_GTEST_PROP(GcodeText, MovesJoinAndFeedsArePositive, ()) {
    const Program program = program_of(random_program("G20").text());
    for (std::size_t i = 0; i < program.moves.size(); ++i) {
        const Move& move = program.moves[i];
        if (i > 0) RC_ASSERT(program.moves[i - 1].end == move.start);
        if (move.kind == motion::MoveKind::feed) RC_ASSERT(move.feed_mm_per_min > 0);
        RC_ASSERT(motion::path_length_mm(move) > 0);
        if (move.arc) RC_ASSERT(move.arc->turn_rad > 0);
    }
}

RC_GTEST_PROP(GcodeText, NoBytesBreakTheReader, ()) {
    const auto pieces = *rc::gen::container<std::vector<std::string>>(rc::gen::element<std::string>(
        "G0", "G1", "G2", "G3", "G18", "G20", "G28", "G53", "G91", "G92", "G93", "G10 L2 P1", "G4", "X1",
        "Y-2", "Z", "I1", "J", "R5", "F9", "S1", "T2", "M6", "M3", "M30", "(", ")", ";", "%", "/", "\n", "\n",
        "\r\n", "O1", "#", "[", "\xE4", "N1", "P2", "A1", ".", "-", "1e9", "99999999"));
    std::string text;
    for (const std::string& piece : pieces) text += piece + (*rc::gen::arbitrary<bool>() ? " " : "");
    const auto program = read_gcode(text);
    if (!program) {
        RC_ASSERT(!program.error().cause.empty());
        RC_ASSERT(!program.error().remedy.empty());
    } else {
        for (const Move& move : program->moves) RC_ASSERT(is_finite(move.end.tip_mm));
    }
}

}  // namespace
}  // namespace tribo::readers
