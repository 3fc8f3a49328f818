// SPDX-License-Identifier: MIT
#include "readers/gcode/calls.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

namespace tribo::readers::gcode {
namespace {

bool is_whole(const Word& word, double least) {
    return word.value >= least && word.value <= kLargestLabel && word.value == std::floor(word.value);
}

// Variable of each argument of G65, A to Z; 0: no argument.
constexpr std::array<int, 26> kVariables{1, 2, 3, 7,  8,  9,  0,  11, 4,  5,  6,  0,  13,
                                         0, 0, 0, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26};
constexpr int kFirstCentre = 4, kLastCentre = 33;  // I J K, repeated

Result<std::int64_t> times_of(const Word* word, int line, const char* code, const Output& output) {
    if (word == nullptr) return 1;
    if (is_whole(*word, 0)) return static_cast<std::int64_t>(word->value);
    return output.refuse(line, word->column, std::string("L of ") + code + " is no number of times",
                         "write a whole number");
}

// Programs of the builder of the machine: probing, tool changes.
constexpr double kFirstOfMachine = 8000, kLastOfMachine = 9999;

// Leaves out a program of the machine that the text lacks. Returns false for another one.
Result<bool> leave_out(const Word& number, int line, State& state, Flow& flow, Output& output) {
    const bool is_of_machine = number.value >= kFirstOfMachine && number.value <= kLastOfMachine;
    if (!is_of_machine || output.options.missing_programs != nullptr) return false;
    const auto has = flow.has_program(number);
    if (!has) return std::unexpected(has.error());
    if (*has) return false;
    for (Known& known : state.known) {
        if (known == Known::yes) known = Known::lost;
    }
    state.lost_line = line;
    const int name = static_cast<int>(number.value);
    if (output.first(Note::program_of_machine, name)) {
        output.warn(line,
                    "O" + std::to_string(name) +
                        " is a program of the machine's own (O8000 to O9999) and not at hand: its moves are "
                        "left out, and the tool's place is unknown after it");
    }
    return true;
}

}  // namespace

Result<bool> call_or_return(Command& command, State& state, Flow& flow, Output& output) {
    const Code code = *command.m(MGroup::subprogram);
    const Word* number = command.use('P');
    const int line = command.line();
    if (code.tenths == 990) {
        if (number != nullptr && !is_whole(*number, 0)) {
            return output.refuse(line, number->column, "M99 P is not the number of a line", "correct P");
        }
        const auto returned = flow.return_from_program(line, code.column, number);
        if (returned && !*returned) {
            output.warn(line, "M99 in the main program would run it again: it ends here");
        }
        return returned;
    }
    bool is_local = code.tenths == 970;
    // Fanuc 30i: M98 Q100 runs lines of this program from N100 on, M98 P1000 Q100 begins there in O1000.
    // Mitsubishi and Syntec write H in place of Q.
    const bool has_line = !is_local && output.options.dialect == GcodeDialect::fanuc;
    const Word* from = has_line ? command.use('Q') : nullptr;
    if (has_line && from == nullptr && !command.g(GGroup::tool_length)) from = command.use('H');
    if (from != nullptr && from->letter == 'H' && from->value == 0) from = nullptr;
    if (from != nullptr && !is_whole(*from, 1)) {
        const std::string letter(1, from->letter);
        return output.refuse(line, from->column, "M98 " + letter + " is not the number of a line",
                             "correct " + letter);
    }
    if (number == nullptr && from != nullptr) {
        is_local = true;
        number = std::exchange(from, nullptr);
    }
    const std::string& name = command.block().called;
    if (number == nullptr && !is_local && !name.empty()) {
        const auto times = times_of(command.use('L'), line, "M98", output);
        if (!times) return std::unexpected(times.error());
        if (*times == 0) return true;
        const auto called = flow.call_named_program(name, *times, line, code.column, nullptr, from);
        if (!called) return std::unexpected(called.error());
        return true;
    }
    if (number == nullptr || !is_whole(*number, 1)) {
        return output.refuse(line, number == nullptr ? code.column : number->column,
                             code_text('M', code.tenths) + " needs the number of a " +
                                 (is_local ? "line" : "program") + " as P",
                             is_local ? "write M97 P100 for N100" : "write M98 P1000 for O1000");
    }
    const auto times = times_of(command.use('L'), line, code_text('M', code.tenths).c_str(), output);
    if (!times) return std::unexpected(times.error());
    if (*times == 0) return true;
    if (!is_local) {
        const auto left_out = leave_out(*number, line, state, flow, output);
        if (!left_out || *left_out) return left_out;
    }
    const Word* last = code.tenths == 970 ? command.use('Q') : nullptr;
    if (last != nullptr && !is_whole(*last, 1))
        return output.refuse(line, last->column, "M97 Q is not the number of a line", "correct Q");
    const auto called = is_local ? flow.call_lines(*number, last, *times, line, code_text('M', code.tenths))
                                 : flow.call_program(*number, *times, line, nullptr, from);
    if (!called) return std::unexpected(called.error());
    return true;
}

Result<MacroCall> read_macro_call(const Block& block, const Word& code, const Output& output) {
    const std::string name = code_text('G', static_cast<int>(code.value) * 10);
    MacroCall call;
    Flow::Arguments& arguments = call.arguments;
    arguments.fill(std::numeric_limits<double>::quiet_NaN());
    const Word* number = nullptr;
    const Word* times_word = nullptr;
    int set = 0, last = -1;  // of I J K
    for (const Word& word : block.words) {
        if (&word == &code) continue;
        if (&word < &code) {
            return output.refuse(block.line, word.column, name + " is not the first word of its block",
                                 "move what is before it to the line above");
        }
        if (word.letter == 'P') {
            number = &word;
        } else if (word.letter == 'L') {
            times_word = &word;
        } else if (word.letter >= 'I' && word.letter <= 'K') {
            const int letter = word.letter - 'I';
            if (letter <= last) ++set;
            last = letter;
            const int variable = kFirstCentre + 3 * set + letter;
            if (variable > kLastCentre) {
                return output.refuse(block.line, word.column, name + " has more than ten sets of I J K",
                                     "pass the rest in common variables");
            }
            arguments[static_cast<std::size_t>(variable - 1)] = word.value;
        } else if (const int variable = kVariables[static_cast<std::size_t>(word.letter - 'A')];
                   variable != 0) {
            arguments[static_cast<std::size_t>(variable - 1)] = word.value;
        } else {
            return output.refuse(block.line, word.column,
                                 std::string(1, word.letter) + " is no argument of " + name,
                                 "use another letter");
        }
    }
    const bool has_name = number == nullptr && !block.called.empty();
    if (!has_name && (number == nullptr || !is_whole(*number, 1))) {
        return output.refuse(block.line, number == nullptr ? code.column : number->column,
                             name + " needs the number of a program as P",
                             "write " + name + " P1000 for O1000");
    }
    const auto times = times_of(times_word, block.line, name.c_str(), output);
    if (!times) return std::unexpected(times.error());
    call.number = has_name ? code : *number;
    if (has_name) call.name = block.called;
    call.times = *times;
    return call;
}

Result<void> call_macro(const MacroCall& call, int line, State& state, Flow& flow, Output& output) {
    if (call.times == 0) return {};
    if (!call.name.empty())
        return flow.call_named_program(call.name, call.times, line, call.number.column, &call.arguments);
    const auto left_out = leave_out(call.number, line, state, flow, output);
    if (!left_out) return std::unexpected(left_out.error());
    if (*left_out) return {};
    return flow.call_program(call.number, call.times, line, &call.arguments);
}

}  // namespace tribo::readers::gcode
