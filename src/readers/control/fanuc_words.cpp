// SPDX-License-Identifier: MIT
#include "readers/control/fanuc_words.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include "readers/control/block_text.hpp"
#include "readers/control/num_words.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers {
namespace {

// Variables of Fanuc that stand for VC0 .. or P0 .., for other names, and lines that stand for labels.
constexpr int kFirstVariable = 500, kFirstLabel = 90'000, kFirstProgram = 7000;
constexpr int kMostVariables = 300, kLastLocal = 33;

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

class Translator {
  public:
    Translator(OtherControl control, std::string_view bytes)
        : is_okuma_(control == OtherControl::okuma),
          says_centres_(!is_okuma_ && has_absolute_centres(bytes)) {
        TextLines lines(bytes);
        for (auto line = lines.next(); is_okuma_ && line; line = lines.next()) {
            const std::string name = program_name(upper(trimmed(*line)));
            if (!name.empty())
                programs_.try_emplace(name, kFirstProgram + static_cast<int>(programs_.size()));
        }
        TextLines again(bytes);
        for (auto line = again.next(); is_okuma_ && line; line = again.next())
            name_arguments(without_blanks_of_formulas(upper(*line)));
    }

    std::string line(std::string_view text) {
        std::string all = upper(text);
        if (is_okuma_) all = without_blanks_of_formulas(all);
        if (is_okuma_ && trimmed(all).starts_with('$')) return {};
        if (trimmed(all).starts_with('%')) return all;
        in_ = all;
        at_ = 0;
        out_.clear();
        skip_blanks();
        while (at_ < in_.size() && in_[at_] == '/') out_ += in_[at_++];
        const bool is_word =
            is_okuma_ && (from(in_, at_).starts_with("NCYL") || from(in_, at_).starts_with("NOEX"));
        if (!is_word && at_ + 1 < in_.size() && in_[at_] == 'N' && is_name(in_[at_ + 1])) {
            ++at_;
            out_ += "N" + label() + " ";
        }
        if (const auto known = programs_.find(program_name(in_.substr(at_))); known != programs_.end()) {
            out_ += "O" + std::to_string(known->second);
            at_ += known->first.size();
        }
        const std::size_t head = out_.size();
        has_centre_ = has_absolute_centre_ = false;
        const std::string behind = is_okuma_ ? std::string() : polar_words();
        while (at_ < in_.size()) word();
        if (says_centres_ && has_centre_) out_.insert(head, has_absolute_centre_ ? "G90.1 " : "G91.1 ");
        return out_ + behind;
    }

  private:
    // G6: the centre of an arc in absolute coordinates, in its block alone.
    static bool has_absolute_centres(std::string_view bytes) {
        for (std::size_t at = bytes.find('6'); at != std::string_view::npos; at = bytes.find('6', at + 1)) {
            const std::size_t zeros = at > 0 && bytes[at - 1] == '0' ? 1 : 0;
            const bool is_code = at > zeros && to_upper(bytes[at - zeros - 1]) == 'G';
            if (is_code && (at + 1 == bytes.size() || !is_digit(bytes[at + 1]))) return true;
        }
        return false;
    }
    void skip_blanks() {
        while (at_ < in_.size() && is_blank(in_[at_])) ++at_;
    }
    std::string name_at(std::size_t at) const {
        std::size_t end = at;
        while (end < in_.size() && is_name(in_[end])) ++end;
        return in_.substr(at, end - at);
    }
    // The number of a line: digits, or one for a name.
    std::string label() {
        std::string name = name_at(at_);
        at_ += name.size();
        if (all_digits(name)) return name;
        const auto known = labels_.try_emplace(name, kFirstLabel + static_cast<int>(labels_.size())).first;
        return std::to_string(known->second);
    }
    // The variable of Fanuc for a name; empty: it is none.
    std::string variable(const std::string& name) {
        const std::string_view prefix = is_okuma_ ? "VC" : "P";
        if (name.starts_with(prefix) && all_digits(from(name, prefix.size())) && name.size() < 7) {
            const int number = std::stoi(name.substr(prefix.size()));
            if (number < kMostVariables) return "#" + std::to_string(kFirstVariable + number);
            return {};
        }
        const auto known = names_.find(name);
        return known == names_.end() ? std::string() : "#" + std::to_string(known->second);
    }
    // The variable at a place, VC5 or P5, which ends with its digits; moves behind it. Empty: none is there.
    std::string take_variable() {
        const std::string_view prefix = is_okuma_ ? "VC" : "P";
        if (!from(in_, at_).starts_with(prefix)) return {};
        const std::string name = std::string(prefix) + std::string(digits_at(in_, at_ + prefix.size()));
        const std::string known = variable(name);
        if (!known.empty()) at_ += name.size();
        return known;
    }
    // Names of local variables that CALL sets in the program that it calls: CALL O100 XX=5 YY=VC1.
    void name_arguments(const std::string& text) {
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
    std::string take_argument() {
        const std::string name = name_at(at_);
        const auto known = names_.find(name);
        if (known == names_.end()) return {};
        const auto argument = std::ranges::find(kArguments, known->second, &Argument::variable);
        if (argument == kArguments.end() || at_ + name.size() >= in_.size() || in_[at_ + name.size()] != '=')
            return {};
        at_ += name.size() + 1;
        return argument->letter + ("[" + formula(" (;") + "]");
    }
    // Each program has its own variables by name, as #1 to #33 are.
    std::string define(const std::string& name) {
        for (int number = 1; number <= kLastLocal; ++number) {
            if (std::ranges::any_of(names_, [&](const auto& known) { return known.second == number; }))
                continue;
            names_.emplace(name, number);
            break;
        }
        return variable(name);
    }
    // A formula up to `ends` outside of its brackets, with the variables of Fanuc.
    std::string formula(std::string_view ends) {
        std::string value;
        int depth = 0;
        while (at_ < in_.size()) {
            const char c = in_[at_];
            if (depth == 0 && ends.find(c) != std::string_view::npos) break;
            if (c == '[' || (c == '(' && !is_okuma_)) ++depth;
            if (c == ']' || (c == ')' && !is_okuma_)) --depth;
            if (depth < 0) break;
            if (is_letter(c)) {
                if (const std::string known = take_variable(); !known.empty()) {
                    value += known;
                    continue;
                }
                const std::string name = name_at(at_), known = variable(name);
                value += known.empty() ? name : known;
                at_ += name.size();
                continue;
            }
            value += is_okuma_ ? c : c == '(' ? '[' : c == ')' ? ']' : c;
            ++at_;
        }
        return value;
    }

    void word() {
        const char c = in_[at_];
        if (c == ';') {
            out_ += in_.substr(at_);
            at_ = in_.size();
        } else if (c == '(') {
            bracket();
        } else if (!is_letter(c)) {
            out_ += c;
            ++at_;
        } else if (is_okuma_ && okuma_statement()) {
            return;
        } else if (c == 'G' && at_ + 1 < in_.size() && is_digit(in_[at_ + 1])) {
            code();
        } else {
            address();
        }
    }

    // A comment, or a statement of Fagor.
    void bracket() {
        const std::size_t end = std::min(in_.find(')', at_), in_.size());
        if (!is_okuma_ && fagor_statement()) return;
        out_ += in_.substr(at_, end + 1 - at_);
        at_ = std::min(end + 1, in_.size());
    }

    // X=VC1+5, XP1, X10, VC1=VC2*2
    void address() {
        const std::string name = name_at(at_);
        const std::size_t after = at_ + name.size();
        const bool has_equals = after < in_.size() && in_[after] == '=';
        std::string known = variable(name);
        if (known.empty() && has_equals && name.size() > 1 && is_letter(name[1])) known = define(name);
        if (has_equals && !known.empty()) {
            at_ = after + 1;
            out_ += known + "=" + formula(" ");
            return;
        }
        const char letter = in_[at_++];
        has_centre_ = has_centre_ || letter == 'I' || letter == 'J' || letter == 'K';
        if (at_ < in_.size() && in_[at_] == '=') {
            ++at_;
            out_ += std::string(1, letter) + "[" + formula(" ") + "]";
            return;
        }
        out_ += letter;
        const bool is_negative = at_ < in_.size() && in_[at_] == '-';
        if (is_negative) ++at_;
        if (const std::string value = take_variable(); !value.empty()) {
            out_ += is_negative ? "[0-" + value + "]" : value;
            return;
        }
        if (is_negative) out_ += '-';
        while (at_ < in_.size() && (is_digit(in_[at_]) || in_[at_] == '.' || is_blank(in_[at_])))
            out_ += in_[at_++];
    }

    bool takes(std::string_view text) {
        if (!from(in_, at_).starts_with(text)) return false;
        at_ += text.size();
        return true;
    }

    // CALL, RTS, IF, GOTO and the like.
    bool okuma_statement() {
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
                    out_ += (is_modal ? "G66P" : "G65P") + program + (times.empty() ? "" : "L" + times) +
                            arguments;
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

    static bool is_of_machine(std::string_view program) { return program.size() == 4 && program >= "8000"; }
    // The number of a program that is called: O100, OCHCK of this file, OO10 of the machine's maker; else
    // empty.
    std::string program_of(const std::string& name) const {
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
    bool fixture_offset() {
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
    void work_system() {
        const std::string zero = take_word('H');
        const auto turning = turning_zeros_.find(zero);
        if (turning != turning_zeros_.end()) {
            out_ += "G254 G54.1P" + turning->second;
        } else {
            out_ += (turning_zeros_.empty() ? "G54.1P" : "G255 G54.1P") + zero;
        }
    }

    bool fagor_statement() {
        const std::size_t start = at_++;
        skip_blanks();
        const std::string name = name_at(at_);
        const std::size_t behind = at_ + name.size();
        std::string text;
        if (name == "IF") {
            at_ = behind;
            const std::size_t go = in_.find("GOTO", at_);
            if (go != std::string::npos) {
                const std::string whole = in_;
                in_ = whole.substr(0, go);
                text = "IF[" + formula("") + "]GOTO";
                in_ = whole;
                at_ = go + 4;
                skip_blanks();
                if (takes("N")) text += label();
            }
        } else if (name == "GOTO") {
            at_ = behind;
            skip_blanks();
            if (takes("N")) text = "GOTO" + label();
        } else if (name == "CALL" || name == "SUB") {
            at_ = behind;
            skip_blanks();
            const std::string number(digits_at(in_, at_));
            at_ += number.size();
            if (!number.empty()) text = (name == "CALL" ? "M98P" : "O") + number;
        } else if (name == "RET") {
            at_ = behind;
            text = "M99";
        } else if (name == "RPT" && fagor_repeat(behind)) {
            return true;
        } else if (name == "RPT" || name == "PCALL" || name == "MCALL" || name == "WHILE" ||
                   name == "ROTATE") {
            text = name;  // no word of Fanuc: refused by its name
            at_ = std::min(in_.find(')', at_), in_.size());
        } else if (behind < in_.size() && in_[behind] == '=' && !variable(name).empty()) {
            do {
                const std::string to = variable(name_at(at_));
                at_ = std::min(in_.find('=', at_), in_.size() - 1) + 1;
                text += to + "=" + formula(",)") + " ";
            } while (takes(","));
        }
        skip_blanks();
        if (text.empty() || !takes(")")) {
            at_ = start;
            return false;
        }
        out_ += text;
        return true;
    }

    // (RPT N10,N20) N3: the lines from N10 to N20, three times.
    bool fagor_repeat(std::size_t at) {
        std::array<std::string, 3> numbers;  // of the first line, of the last one, of the times
        constexpr std::array<std::string_view, 3> before{"N", ",N", ")N"};
        const auto skip = [&] {
            while (at < in_.size() && is_blank(in_[at])) ++at;
        };
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            for (const char c : before[i]) {
                skip();
                if (at < in_.size() && in_[at] == c) {
                    ++at;
                } else if (i < 2) {
                    return false;
                }
            }
            const std::string_view digits = digits_at(in_, at);
            numbers[i] = digits;
            at += digits.size();
            if (digits.empty() && i < 2) return false;
        }
        out_ += "M97P" + numbers[0] + "Q" + numbers[1] + (numbers[2].empty() ? "" : "L" + numbers[2]);
        at_ = at;
        return true;
    }

    void code() {
        ++at_;
        std::string number(digits_at(in_, at_));
        at_ += number.size();
        const bool has_part = at_ < in_.size() && in_[at_] == '.';
        while (number.size() > 1 && number[0] == '0') number.erase(0, 1);
        if (has_part) {
            out_ += "G" + number;
        } else if (is_okuma_) {
            okuma_code(number);
        } else {
            fagor_code(number);
        }
    }

    // The word of that letter in the rest of the block, taken out of it; empty: it has none.
    std::string take_word(char letter) {
        const std::size_t found = in_.find(letter, at_);
        if (found == std::string::npos) return {};
        std::size_t end = found + 1;
        while (end < in_.size() && (is_name(in_[end]) || in_[end] == '.' || in_[end] == '-')) {
            if (is_letter(in_[end]) && end > found + 1) break;
            ++end;
        }
        const std::string word = in_.substr(found + 1, end - found - 1);
        in_.erase(found, end - found);
        return word;
    }

    // The same as a formula; empty: the block has no such word.
    std::string take_value(char letter) {
        const std::size_t found = in_.find(letter, at_);
        if (from(in_, found).substr(0, 2).ends_with('=')) {
            const std::size_t start = std::exchange(at_, found + 2);
            const std::string value = formula(" ");
            in_.erase(found, std::exchange(at_, start) - found);
            return "[" + value + "]";
        }
        std::string word = take_word(letter);
        if (word.empty()) return {};
        const bool is_negative = word[0] == '-';
        if (is_negative) word.erase(0, 1);
        const std::string known = variable(word);
        return "[" + std::string(is_negative ? "0-" : "") + (known.empty() ? word : known) + "]";
    }

    // The word as a way from the start, which is at `place`; increments are that already.
    std::string take_way(char letter, const char* place) {
        // G90 and G91 of this block hold for it, and #4003 says what held before.
        const bool is_relative = in_.find("G91") != std::string::npos,
                   is_absolute = in_.find("G90") != std::string::npos;
        const std::string absolute = is_relative   ? "0"
                                     : is_absolute ? "1"
                                                   : "[#4003 EQ 90]",
                          value = take_value(letter);
        return value.empty() ? "0" : "[" + value + "-" + place + "*" + absolute + "]";
    }

    bool has_code(std::string_view code) const {
        const std::size_t end = in_.find('(');
        for (std::size_t at = in_.find('G'); at < std::min(end, in_.size()); at = in_.find('G', at + 1)) {
            const std::size_t zeros = at + 1 < in_.size() && in_[at + 1] == '0' ? 1 : 0;
            if (digits_at(in_, at + 1 + zeros) == code) return true;
        }
        return false;
    }

    // R Q: a place by radius and angle about the pole of G93, or about I J from the start of an arc. The
    // words of Fanuc, which stand for it at the end of the block: the pole is #980 #981, the last radius and
    // angle #982 #983.
    std::string polar_words() {
        for (const std::string_view code : {"0", "1", "2", "3"}) {
            if (has_code(code)) is_arc_ = code == "2" || code == "3";
        }
        if (has_code("17")) is_other_plane_ = false;
        if (has_code("18") || has_code("19")) is_other_plane_ = true;
        const auto has = [&](char letter) {
            return in_.find(letter, at_) < std::min(in_.find_first_of("(;", at_), in_.size());
        };
        const bool is_other = has_code("73") || has_code("36") || has_code("39") || has_code("8") ||
                              has_code("9") || has('X') || has('Y') || has_code("81") || has_code("82") ||
                              has_code("84") || has_code("85") || has_code("86") || has_code("89");
        if (is_other || !(has('Q') || (has('R') && !is_arc_))) return {};
        if (is_other_plane_) return "FAGORPOLAR";
        const std::string relative = has_code("91") ? "1" : has_code("90") ? "0" : "[1-[#4003 EQ 90]]";
        const auto take = [&](char letter) { return has(letter) ? take_value(letter) : std::string(); };
        std::string radius = take('R'), angle = take('Q');
        angle = angle.empty() ? "#983" : "[" + angle + "+#983*" + relative + "]";
        std::string x = "#980", y = "#981", centre;
        if (is_arc_) {
            const std::string i = take('I'), j = take('J');
            if (!i.empty() || !j.empty()) {
                x = "[#5041+" + (i.empty() ? "0" : i) + "]";
                y = "[#5042+" + (j.empty() ? "0" : j) + "]";
            }
            const std::string to_x = "[" + x + "-#5041]", to_y = "[" + y + "-#5042]";
            radius = "SQRT[" + to_x + "*" + to_x + "+" + to_y + "*" + to_y + "]";
            centre = " G91.1 I" + to_x + " J" + to_y;
        } else {
            radius = radius.empty() ? "#982" : "[" + radius + "+#982*" + relative + "]";
        }
        return " X[" + x + "+" + radius + "*COS[" + angle + "]-#5041*" + relative + "] Y[" + y + "+" +
               radius + "*SIN[" + angle + "]-#5042*" + relative + "]" + centre + " #982=" + radius +
               " #983=" + angle;
    }

    // An arc to X Y that goes on in the direction of the move before it: #99901 and on (gcode/text/
    // fanuc_variables.hpp).
    void tangent_arc() {
        const std::string in = in_;
        const std::string c = take_way('X', "#5041"), d = take_way('Y', "#5042");
        in_ = in;
        if (c == "0" && d == "0") {
            out_ += "FAGORG8";
            return;
        }
        const std::string cross = "[#99901*" + d + "-#99902*" + c + "]";
        const std::string radius = "[[" + c + "*" + c + "+" + d + "*" + d + "]/[2*" + cross + "]]";
        out_ += "G91.1 G[2+[" + cross + " GT 0]] I[0-#99902*" + radius + "] J[#99901*" + radius + "] ";
    }

    // An arc to X Y through the point I J, in the plane of X and Y: its centre follows from the three points.
    void three_points() {
        const bool is_whole =
            in_.find('X', at_) != std::string::npos && in_.find('Y', at_) != std::string::npos &&
            in_.find('I', at_) != std::string::npos && in_.find('J', at_) != std::string::npos;
        if (!is_whole) {
            out_ += "FAGORG9";
            return;
        }
        const std::string in = in_;
        const std::string a = take_way('I', "#5041"), b = take_way('J', "#5042"), c = take_way('X', "#5041"),
                          d = take_way('Y', "#5042");
        const std::string cross = "[" + a + "*" + d + "-" + b + "*" + c + "]";
        const std::string e = "[" + a + "*" + a + "+" + b + "*" + b + "]",
                          f = "[" + c + "*" + c + "+" + d + "*" + d + "]";
        // X and Y stay words of the block.
        in_ = in;
        take_word('I');
        take_word('J');
        out_ += "G91.1 G[2+[" + cross + " GT 0]] I[[" + d + "*" + e + "-" + b + "*" + f + "]/[2*" + cross +
                "]] J[[" + a + "*" + f + "-" + c + "*" + e + "]/[2*" + cross + "]] ";
    }

    void okuma_code(const std::string& number) {
        if (number == "15" || number == "16") {
            work_system();
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
            out_ += "G4" + (seconds.empty() ? std::string() : "X" + seconds);
        } else {
            const bool is_cycle = number.size() == 2 && (number[0] == '7' || number[0] == '8');
            if (is_cycle) cycle_on_ = number != "80";
            out_ += "G" + number;
        }
    }

    // G73 with an angle while one is in force: the control adds them.
    bool turns_again() const { return is_turned_ && in_.find('Q', at_) != std::string::npos; }

    void fagor_code(const std::string& number) {
        constexpr std::array<std::string_view, 23> refused{"20", "37", "38", "60", "61", "62", "63", "64",
                                                           "65", "66", "67", "68", "69", "72", "74", "75",
                                                           "76", "77", "78", "79", "83", "87", "88"};
        constexpr std::array<std::string_view, 6> cycles{"81", "82", "84", "85", "86", "89"};
        const bool is_refused = std::find(refused.begin(), refused.end(), number) != refused.end();
        if (number == "73" && !turns_again()) {  // the coordinates turn by Q about I J; alone: no longer
            const std::string angle = take_value('Q'), x = take_value('I'), y = take_value('J');
            is_turned_ = !angle.empty();
            out_ += angle.empty()
                        ? "G69"
                        : "G68X" + (x.empty() ? "0" : x) + "Y" + (y.empty() ? "0" : y) + "R" + angle;
        } else if (is_refused || number == "73") {
            out_ += "FAGORG" + number;  // means something else on a Fanuc control: refused by this name
        } else if (number == "93") {    // the pole: at I J, or where the tool is
            const std::string x = take_value('I'), y = take_value('J');
            const bool is_here = x.empty() && y.empty();
            out_ += "#980=" +
                    (is_here     ? "#5041"
                     : x.empty() ? "0"
                                 : x) +
                    " #981=" +
                    (is_here     ? "#5042"
                     : y.empty() ? "0"
                                 : y) +
                    " ";
        } else if (number == "6") {
            has_absolute_centre_ = true;
        } else if (number == "8") {
            tangent_arc();
        } else if (number == "9") {
            three_points();
        } else if (number == "5" || number == "7" || number == "50") {
            out_ += number == "7" ? "G61" : "G64";
        } else if (number == "10") {
            out_ += "G50.1";
        } else if (number == "11" || number == "12" || number == "13") {
            out_ += "G51.1" + std::string(1, "XYZ"[number[1] - '1']) + "0";
        } else if (number == "44") {
            out_ += "G49";
        } else if (std::find(cycles.begin(), cycles.end(), number) != cycles.end()) {
            const std::string reference = take_word('Z'), depth = take_word('I');
            out_ += "G" + number + (reference.empty() ? std::string() : "R" + reference) +
                    (depth.empty() ? std::string() : "Z" + depth);
        } else {
            out_ += "G" + number;
        }
    }

    bool is_okuma_, says_centres_;
    bool has_centre_ = false, has_absolute_centre_ = false;  // of the block
    bool cycle_on_ = false, is_turned_ = false;
    bool is_arc_ = false, is_other_plane_ = false;  // of the last G0 to G3, and of G17 to G19
    std::string in_, out_;
    std::size_t at_ = 0;
    std::map<std::string, int> names_, labels_, programs_;
    std::map<std::string, std::string> turning_zeros_;  // work systems of CALL OO88, and the base of each
};

}  // namespace

std::string in_fanuc_words(std::string_view bytes, OtherControl control) {
    if (control == OtherControl::num) return num_in_fanuc_words(bytes);
    Translator translator(control, bytes);
    std::string text;
    TextLines lines(bytes);
    while (const auto line = lines.next()) {
        text += translator.line(*line);
        text += '\n';
    }
    return text;
}

}  // namespace tribo::readers
