// SPDX-License-Identifier: MIT
// The statements and codes of Okuma OSP.
#include <algorithm>
#include <array>

#include "readers/control/word_translator.hpp"
#include "readers/gcode/text/fanuc_variables.hpp"

namespace tribo::readers {
namespace {

// The letters by which G65 sets #1 and on in the program that it calls; not I J K, whose order counts.
struct Argument {
    char letter;
    int variable;
};
constexpr std::array kArguments{Argument{'A', 1},  Argument{'B', 2},  Argument{'C', 3},  Argument{'D', 7},
                                Argument{'E', 8},  Argument{'F', 9},  Argument{'H', 11}, Argument{'M', 13},
                                Argument{'Q', 17}, Argument{'R', 18}, Argument{'S', 19}, Argument{'T', 20},
                                Argument{'U', 21}, Argument{'V', 22}, Argument{'W', 23}, Argument{'X', 24},
                                Argument{'Y', 25}, Argument{'Z', 26}};

}  // namespace

// Names of local variables that CALL sets in the program that it calls: CALL O100 XX=5 YY=VC1.
void WordTranslator::name_arguments(const std::string& text) {
    const std::size_t call = text.find("CALL"), begin_of_name = text.find('O', call);
    if (call == std::string::npos || begin_of_name == std::string::npos) return;
    std::size_t end_of_name = begin_of_name;
    while (end_of_name < text.size() && is_name(text[end_of_name])) ++end_of_name;
    const std::string program = program_of(text.substr(begin_of_name, end_of_name - begin_of_name));
    if (program.empty() || is_of_machine(program)) return;
    for (std::size_t at = text.find('=', call); at != std::string::npos; at = text.find('=', at + 1)) {
        std::size_t begin = at;
        while (begin > call && is_name(text[begin - 1])) --begin;
        const std::string name = text.substr(begin, at - begin);
        if (name.size() > 1 && is_letter(name[1]) && variable(name).empty() &&
            names_.size() < kArguments.size())
            names_.emplace(name, kArguments[names_.size()].variable);
    }
}

// The word of G65 for an argument, with the cursor at its name; empty: none is there.
std::string WordTranslator::take_argument() {
    const std::string name = name_at(at_);
    const auto known = names_.find(name);
    if (known == names_.end()) return {};
    const auto argument = std::ranges::find(kArguments, known->second, &Argument::variable);
    if (argument == kArguments.end() || at_ + name.size() >= in_.size() || in_[at_ + name.size()] != '=')
        return {};
    at_ += name.size() + 1;
    return argument->letter + ("[" + formula(" (;") + "]");
}

// CALL, RTS, IF, GOTO and the like.
bool WordTranslator::okuma_statement() {
    const std::size_t start = at_;
    if (takes("IF")) {
        skip_blanks();
        if (at_ < in_.size() && in_[at_] == '[') {
            ++at_;
            const std::string condition = formula("]");
            takes("]");
            skip_blanks();
            if (takes("GOTO")) skip_blanks();
            if (takes("N")) {
                out_ += "IF[" + condition + "]GOTO" + label();
                return true;
            }
        }
    } else if (takes("GOTO")) {
        skip_blanks();
        if (takes("N")) {
            out_ += "GOTO" + label();
            return true;
        }
    } else if (takes("CALL") || takes("MODIN")) {
        const bool is_modal = in_[at_ - 1] == 'N';
        skip_blanks();
        const std::string name = name_at(at_), program = program_of(name);
        at_ += name.size();
        if (name == "OO88" && !is_modal && fixture_offset()) return true;
        if (!program.empty()) {
            std::string times, arguments;
            const auto at_end = [&] {
                skip_blanks();
                return at_ >= in_.size() || in_[at_] == '(' || in_[at_] == ';';
            };
            // One of the machine's own is not at hand.
            if (is_of_machine(program)) at_ = std::min(in_.find_first_of("(;", at_), in_.size());
            for (bool goes_on = true; goes_on && !at_end();) {
                const std::string argument = take_argument();
                arguments += argument;
                goes_on = !argument.empty();
                if (goes_on || in_[at_] != 'Q' || digits_at(in_, at_ + 1).empty()) continue;
                ++at_;
                times = std::string(digits_at(in_, at_));
                at_ += times.size();
                goes_on = true;
            }
            if (at_end()) {
                out_ +=
                    (is_modal ? "G66P" : "G65P") + program + (times.empty() ? "" : "L" + times) + arguments;
                return true;
            }
        }
    } else if (takes("RTS")) {
        out_ += "M99";
        return true;
    } else if (takes("MODOUT")) {
        out_ += "G67";
        return true;
    } else if (takes("NOEX")) {
        return true;
    } else if (takes("VSLNO") || takes("VSLDT")) {  // the monitor of the spindle's load
        at_ = std::min(in_.find_first_of(" (;", at_), in_.size());
        return true;
    } else if (takes("DA") || takes("DB") || takes("DC")) {
        if (at_ >= in_.size() || !is_name(in_[at_])) return true;  // an offset of the tool in the spindle
    } else if (takes("BHC")) {  // holes on a circle: I its radius, J the first angle, K their number
        const std::string count = take_word('K');
        out_ += "G70" + (count.empty() ? std::string() : "L" + count);
        return true;
    } else if (takes("NCYL")) {  // the place alone: without the cycle's hole
        const bool begins =
            in_.find("G8", at_) != std::string::npos || in_.find("G7", at_) != std::string::npos;
        if (begins || cycle_on_) out_ += "L0 ";
        return true;
    }
    at_ = start;
    return false;
}

// The number of a program that is called: O100, OCHCK of this file, OO10 of the machine's maker; else
// empty.
std::string WordTranslator::program_of(const std::string& name) const {
    if (const auto known = programs_.find(name); known != programs_.end())
        return std::to_string(known->second);
    const bool is_makers = name.starts_with("OO") && name != "OO88" && name.size() < 6;
    const std::string number = name.substr(std::min<std::size_t>(is_makers ? 2 : 1, name.size()));
    if (!name.starts_with('O') || !all_digits(number)) return {};
    return is_makers ? std::to_string(9000 + std::stoi(number)) : number;
}

// CALL OO88 PC= PA= PH= PP= (Okuma 5082-E, Fixture Offset Function): the system PP has the zero of PH,
// where it stands when the part has turned to these angles. The tool goes to them before it cuts, so a
// zero that turns with the part is at the same place. A shift of it by PX PY PZ is not read.
bool WordTranslator::fixture_offset() {
    std::string base, turned;
    while (at_ < in_.size() && in_[at_] != '(' && in_[at_] != ';') {
        if (is_blank(in_[at_])) {
            ++at_;
            continue;
        }
        const std::string name = name_at(at_);
        at_ += name.size();
        if (name.size() != 2 || name[0] != 'P' || !takes("=")) return false;
        const std::string value = formula(" (;");
        const bool is_shift = name[1] == 'X' || name[1] == 'Y' || name[1] == 'Z';
        if (is_shift && value.find_first_not_of("-.0") != std::string::npos) return false;
        if (name[1] == 'H') base = value;
        if (name[1] == 'P') turned = value;
    }
    if (!all_digits(base) || !all_digits(turned)) return false;
    turning_zeros_[turned] = base;
    return true;
}

// G15 H: a work system, whose zero turns with the part after CALL OO88.
void WordTranslator::work_system() {
    const std::string zero = take_word('H');
    const auto turning = turning_zeros_.find(zero);
    if (turning != turning_zeros_.end()) {
        out_ += "G254 G54.1P" + turning->second;
    } else {
        out_ += (turning_zeros_.empty() ? "G54.1P" : "G255 G54.1P") + zero;
    }
}

// G16 H: a work system of this block alone; 0 is that of the machine.
void WordTranslator::system_of_block() {
    const std::string zero = take_word('H');
    out_ += all_digits(zero) && zero.find_first_not_of('0') == std::string::npos ? "G53" : "GOKUMA16";
}

// I: the depth of a peck. J: the depth after which the tool clears the hole; between, it breaks the chips.
void WordTranslator::pecks(const std::string& code) {
    const std::string depth = take_value('I'), clearing = take_value('J');
    if (clears_ || !clearing.empty())
        out_ += "#" + std::to_string(gcode::kClearingDepth) + "=" + (clearing.empty() ? "0" : clearing) + " ";
    clears_ = !clearing.empty();
    out_ += "G" + code + (depth.empty() ? "" : "Q" + depth);
}

// M54: cycles return to R. M52, M53: to the top, to the level of G71; where the tool stood is taken for both.
bool WordTranslator::return_level() {
    if (in_[at_] != 'M') return false;
    const std::string_view number = digits_at(in_, at_ + 1);
    if (number != "52" && number != "53" && number != "54") return false;
    out_ += number == "54" ? "G99" : "G98";
    at_ += 1 + number.size();
    return true;
}

void WordTranslator::okuma_code(const std::string& number) {
    if (number == "15") {
        work_system();
    } else if (number == "16") {
        system_of_block();
    } else if (number == "605") {  // the zero of system H goes with the part
        take_word('Q');
        take_word('R');
        out_ += "G254 G54.1P" + take_word('H');
    } else if (number == "604") {
        out_ += "G255";
    } else if (number == "53" || number == "170") {
        out_ += "G49";
    } else if (number == "54" || number == "55" || number == "56" || number == "169") {
        const std::string offset = take_word('H');
        out_ += (number == "169" ? "G43.4" : "G43") + (all_digits(offset) ? "H" + offset : std::string());
    } else if (number == "130" || number == "131") {  // Super-NURBS: how the control smooths
        for (const char word : {'F', 'J', 'E', 'D', 'P'}) take_word(word);
    } else if (number == "274" || number == "284" || number == "273" || number == "283") {
        take_word('E');  // taps with the spindle in step, which E places; Q: in pecks
        cycle_on_ = true;
        out_ += number[1] == '7' ? "G74" : "G84";
    } else if (number == "71") {
        take_word('Z');           // the level to which M53 returns
    } else if (number == "11") {  // a shift and a turn of the coordinates
        const std::string angle = take_value('P');
        out_ += "G68.2I0J0K" + (angle.empty() ? std::string("0") : angle);
    } else if (number == "10") {
        out_ += "G69";
    } else if (number == "4") {
        const std::string seconds = take_word('F');
        out_ += "G4" + (seconds.empty() ? std::string() : "X[" + seconds + "]");  // computed: in seconds
    } else {
        const bool is_cycle = number.size() == 2 && (number[0] == '7' || number[0] == '8');
        if (is_cycle) cycle_on_ = number != "80";
        if (number == "73" || number == "83") return pecks(number);
        out_ += "G" + number;
    }
}

}  // namespace tribo::readers
