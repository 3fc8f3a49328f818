// SPDX-License-Identifier: MIT
// The statements and codes of Fagor 8055.
#include <algorithm>
#include <array>

#include "readers/control/word_translator.hpp"

namespace tribo::readers {

// G6: the centre of an arc in absolute coordinates, in its block alone.
bool WordTranslator::has_absolute_centres(std::string_view bytes) {
    for (std::size_t at = bytes.find('6'); at != std::string_view::npos; at = bytes.find('6', at + 1)) {
        const std::size_t zeros = at > 0 && bytes[at - 1] == '0' ? 1 : 0;
        const bool is_code = at > zeros && to_upper(bytes[at - zeros - 1]) == 'G';
        if (is_code && (at + 1 == bytes.size() || !is_digit(bytes[at + 1]))) return true;
    }
    return false;
}

bool WordTranslator::fagor_statement() {
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
    } else if (name == "RPT" || name == "PCALL" || name == "MCALL" || name == "WHILE" || name == "ROTATE") {
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
bool WordTranslator::fagor_repeat(std::size_t at) {
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

// The word as a way from the start, which is at `place`; increments are that already.
std::string WordTranslator::take_way(char letter, const char* place) {
    // G90 and G91 of this block hold for it, and #4003 says what held before.
    const bool is_relative = in_.find("G91") != std::string::npos,
               is_absolute = in_.find("G90") != std::string::npos;
    const std::string absolute = is_relative   ? "0"
                                 : is_absolute ? "1"
                                               : "[#4003 EQ 90]",
                      value = take_value(letter);
    return value.empty() ? "0" : "[" + value + "-" + place + "*" + absolute + "]";
}

bool WordTranslator::has_code(std::string_view code) const {
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
std::string WordTranslator::polar_words() {
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
    return " X[" + x + "+" + radius + "*COS[" + angle + "]-#5041*" + relative + "] Y[" + y + "+" + radius +
           "*SIN[" + angle + "]-#5042*" + relative + "]" + centre + " #982=" + radius + " #983=" + angle;
}

// An arc to X Y that goes on in the direction of the move before it: #99901 and on (gcode/text/
// fanuc_variables.hpp).
void WordTranslator::tangent_arc() {
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
void WordTranslator::three_points() {
    const bool is_whole = in_.find('X', at_) != std::string::npos &&
                          in_.find('Y', at_) != std::string::npos &&
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

void WordTranslator::fagor_code(const std::string& number) {
    constexpr std::array<std::string_view, 23> refused{"20", "37", "38", "60", "61", "62", "63", "64",
                                                       "65", "66", "67", "68", "69", "72", "74", "75",
                                                       "76", "77", "78", "79", "83", "87", "88"};
    constexpr std::array<std::string_view, 6> cycles{"81", "82", "84", "85", "86", "89"};
    const bool is_refused = std::find(refused.begin(), refused.end(), number) != refused.end();
    if (number == "73" && !turns_again()) {  // the coordinates turn by Q about I J; alone: no longer
        const std::string angle = take_value('Q'), x = take_value('I'), y = take_value('J');
        is_turned_ = !angle.empty();
        out_ += angle.empty() ? "G69"
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
    } else if (number == "96") {
        // F is the feed where the edge cuts, not that of the tool's centre.
        out_ += "G97";
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

}  // namespace tribo::readers
