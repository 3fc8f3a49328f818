// SPDX-License-Identifier: MIT
// Words: TNC 426, TNC 530 and TNC 640 User's Manuals, DIN/ISO Programming.
#include "readers/heidenhain/din_iso.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "readers/control/block_text.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers {
namespace {

constexpr std::size_t kLookedAt = 4096;  // characters from the start

// A block without number, comment and '*'.
std::string block_of(std::string_view line) {
    std::string_view text = trimmed(line.substr(0, line.find(';')));
    if (text.ends_with('*')) text = trimmed(text.substr(0, text.size() - 1));
    const bool has_number = text.size() > 1 && to_upper(text[0]) == 'N' && is_digit(text[1]);
    if (has_number) {
        const std::size_t end = text.find_first_not_of("0123456789", 1);
        text = end == std::string_view::npos ? std::string_view() : trimmed(text.substr(end));
    }
    return upper(text);
}

// A letter and what follows it: a number with its sign, or a Q parameter.
struct IsoWord {
    char letter = ' ';
    std::string value;
};

// The words of a block; none if it has other text.
std::optional<std::vector<IsoWord>> words_of(std::string_view block) {
    std::vector<IsoWord> words;
    for (std::size_t i = 0; i < block.size();) {
        if (is_blank(block[i])) {
            ++i;
            continue;
        }
        if (!is_letter(block[i])) return std::nullopt;
        IsoWord word{block[i], ""};
        std::size_t end = i + 1;
        while (end < block.size() && is_blank(block[end])) ++end;
        const std::size_t begin = end;
        if (end < block.size() && (block[end] == '+' || block[end] == '-')) ++end;
        if (end < block.size() && block[end] == 'Q') ++end;
        while (end < block.size() && (is_digit(block[end]) || block[end] == '.')) ++end;
        word.value = std::string(block.substr(begin, end - begin));
        const bool is_axis = word.letter >= 'X' && word.letter <= 'Z';  // alone in G28
        if (word.value.empty() && !is_axis) return std::nullopt;
        words.push_back(word);
        i = end;
    }
    return words;
}

class Translator {
  public:
    explicit Translator(std::string_view bytes) {
        TextLines lines(bytes);
        while (const auto line = lines.next()) lines_.push_back(*line);
        for (const std::string_view line : lines_) ends_with_star_ = ends_with_star_ || ends(line);
    }

    std::string run() {
        std::string all;
        for (at_ = 0; at_ < lines_.size(); ++at_) {
            all += line();
            all += '\n';
        }
        return all;
    }

  private:
    static bool ends(std::string_view line) { return trimmed(line.substr(0, line.find(';'))).ends_with('*'); }

    // The comment of the line, which may describe a tool.
    std::string comment() const {
        const std::size_t at = lines_[at_].find(';');
        return at == std::string_view::npos ? std::string() : " " + std::string(lines_[at_].substr(at));
    }

    std::string line() {
        std::string block = block_of(lines_[at_]);
        if (in_cycle_) {
            const bool goes_on = cycle_goes_on();
            in_cycle_ = goes_on;
            return block + (goes_on ? " ~" : "");
        }
        if (block.empty()) return comment();
        if (block[0] == '%') return program(block);
        if (block[0] == 'Q' && block.find('=') != std::string::npos) return block;
        if (block.starts_with("PLANE") || block.starts_with("FUNCTION") || block.starts_with("TRANS"))
            return block;
        if (block.starts_with("G98")) return "LBL " + std::string(trimmed(label_text(block)));
        if (block[0] == 'L' && block.size() > 1 && (is_digit(block[1]) || block[1] == '"'))
            return label_call(block);
        if (block[0] == 'D' && block.size() > 2 && is_digit(block[1])) return function(block);
        if (const auto cycle = cycle_call(block)) return *cycle + comment();
        const auto words = words_of(block);
        return (words ? path(*words) : block) + comment();
    }

    // %NAME G71 begins, and ends the program the second time; %NAME alone calls.
    std::string program(const std::string& block) {
        const std::size_t end = block.find_first_of(" \t");
        const std::string name = block.substr(1, end == std::string::npos ? end : end - 1);
        const bool is_frame = block.find(" G7") != std::string::npos;
        if (!is_frame) return "CALL PGM " + name.substr(name.starts_with(':') ? 1 : 0);
        const bool begins = !begun_;
        begun_ = true;
        return std::string(begins ? "BEGIN PGM " : "END PGM ") + name +
               (block.find("G70") != std::string::npos ? " INCH" : " MM");
    }

    static std::string label_text(const std::string& block) {
        const std::size_t at = block.find('L');
        return at == std::string::npos ? std::string() : block.substr(at + 1);
    }

    // L1,3 or L1.3: label 1, three more times.
    static std::string label_call(const std::string& block) {
        const std::size_t comma = block[1] == '"' ? block.find(',') : block.find_first_of(",.");
        std::string text = "CALL LBL " + block.substr(1, comma == std::string::npos ? comma : comma - 1);
        if (comma == std::string::npos) return text;
        const std::string times = block.substr(comma + 1);
        return times == "0" || times.empty() ? text : text + " REP " + times;
    }

    // D01 Q2 P01 +Q1 P02 +3: the functions FN 0 to FN 13 under another letter.
    static std::string function(const std::string& block) {
        constexpr std::array<std::string_view, 8> operators{"",      " + ",   " - ",  " * ",
                                                            " DIV ", "SQRT ", "SIN ", "COS "};
        const std::size_t number = static_cast<std::size_t>(std::stoul(block.substr(1, 2)));
        const std::size_t result = block.find('Q');
        std::array<std::string, 4> values;
        for (std::size_t k = 1; k < 4; ++k) {
            const std::size_t at = block.find("P0" + std::to_string(k));
            if (at == std::string::npos) continue;
            const std::size_t next = block.find("P0" + std::to_string(k + 1), at);
            values[k] =
                std::string(trimmed(block.substr(at + 3, next == std::string::npos ? next : next - at - 3)));
        }
        const std::string begin = "FN " + std::to_string(number) + ": ";
        if (number >= 9 && number <= 12) {
            constexpr std::array<std::string_view, 4> compare{" EQU ", " NE ", " GT ", " LT "};
            return begin + "IF " + values[1] + std::string(compare[number - 9]) + values[2] + " GOTO LBL " +
                   values[3];
        }
        const bool computes = number <= 8 || number == 13;
        if (!computes || result == std::string::npos) return begin + block.substr(3);
        const std::size_t end = block.find_first_of(" \tP", result + 1);
        const std::string assign =
            begin + block.substr(result, end == std::string::npos ? end : end - result) + " = ";
        if (number == 0) return assign + values[1];
        if (number <= 4) return assign + values[1] + std::string(operators[number]) + values[2];
        if (number <= 7) return assign + std::string(operators[number]) + values[1];
        return assign + values[1] + (number == 8 ? " LEN " : " ANG ") + values[2];
    }

    // G200 and on with Q parameters, on one line or on several up to '*'; G83, G84, G85 with P01, P02 and on.
    std::optional<std::string> cycle_call(const std::string& block) {
        if (block[0] != 'G') return std::nullopt;
        const std::size_t end = std::min(block.find_first_not_of("0123456789", 1), block.size());
        const std::string number = block.substr(1, end - 1);
        if (number.size() == 3 && number[0] >= '2') {
            const bool goes_on = ends_with_star_ && cycle_goes_on();
            in_cycle_ = goes_on;
            const std::size_t q = block.find(" Q", end);
            const std::string parameters = q == std::string::npos ? std::string() : block.substr(q);
            return "CYCL DEF " + number + parameters + (goes_on ? " ~" : "");
        }
        if (number == "79") return "CYCL CALL" + block.substr(end);
        return old_cycle(number, block);
    }

    static std::optional<std::string> old_cycle(const std::string& number, const std::string& block) {
        struct Old {
            std::string_view number, conversational;
            std::array<std::string_view, 5> lines;  // of P01 and on
        };
        constexpr std::array<Old, 3> cycles{{{"83", "1", {"SET UP ", "DEPTH ", "PECKG ", "DWELL ", "F"}},
                                             {"84", "2", {"SET UP ", "DEPTH ", "DWELL ", "F", ""}},
                                             {"85", "17", {"SET UP ", "DEPTH ", "PITCH ", "", ""}}}};
        for (const Old& old : cycles) {
            if (number != old.number || block.find("P01") == std::string::npos) continue;
            const std::string begin = "CYCL DEF " + std::string(old.conversational) + ".";
            std::string text = begin + "0";
            for (std::size_t k = 0; k < old.lines.size() && !old.lines[k].empty(); ++k) {
                const std::size_t at = block.find("P0" + std::to_string(k + 1));
                if (at == std::string::npos) continue;
                const std::string value(trimmed(block.substr(at + 3, block.find(" P", at + 3) - at - 3)));
                // The set-up clearance of DIN/ISO has the sign of the way down.
                const std::size_t sign = k == 0 ? value.find_first_not_of("+-") : 0;
                text += kNextBlock + begin + std::to_string(k + 1) + " " + std::string(old.lines[k]) +
                        value.substr(std::min(sign, value.size()));
            }
            return text;
        }
        return std::nullopt;
    }

    // The text of a word that moves an axis, with I in front of it after G91.
    std::string axis(const IsoWord& word) const {
        return std::string(incremental_ ? " I" : " ") + word.letter + word.value;
    }

    std::string path(const std::vector<IsoWord>& words) {
        std::vector<int> codes;
        Parts parts;
        for (const IsoWord& word : words) {
            if (word.letter == 'G' && std::all_of(word.value.begin(), word.value.end(), is_digit)) {
                codes.push_back(std::stoi(word.value.substr(0, 6)));
            } else {
                parts.words.push_back(word);
            }
        }
        for (const int code : codes) {
            if (code == 90 || code == 91) incremental_ = code == 91;
            if (code >= 40 && code <= 42) parts.side = code == 40 ? " R0" : code == 41 ? " RL" : " RR";
            const bool is_path = code <= 3 || (code >= 5 && code <= 7) || (code >= 10 && code <= 13) ||
                                 code == 15 || code == 16;
            if (is_path) path_ = code;
            const bool is_mode = is_path || code == 90 || code == 91 || (code >= 40 && code <= 42) ||
                                 (code >= 17 && code <= 20) || code == 70 || code == 71;
            if (!is_mode) parts.special = code;
            if (code >= 18 && code <= 20) parts.plane = "YX?"[code - 18];  // tool axes of G18 and G19
        }
        if (parts.special >= 0) return special(parts);
        return parts.has('T') ? tool(parts) : move(parts);
    }

    struct Parts {
        std::vector<IsoWord> words;
        std::string side;
        int special = -1;
        char plane = ' ';

        bool has(char letter) const {
            return std::any_of(words.begin(), words.end(),
                               [&](const IsoWord& w) { return w.letter == letter; });
        }
        // The words of these letters, each behind a blank.
        std::string of(std::string_view letters) const {
            std::string text;
            for (const IsoWord& word : words) {
                if (letters.find(word.letter) != std::string_view::npos)
                    text += std::string(" ") + word.letter + word.value;
            }
            return text;
        }
        std::string value(char letter) const {
            for (const IsoWord& word : words) {
                if (word.letter == letter) return word.value;
            }
            return {};
        }
    };

    std::string axes(const Parts& parts) const {
        std::string text;
        for (const IsoWord& word : parts.words) {
            if (std::string_view("XYZABC").find(word.letter) != std::string_view::npos) text += axis(word);
        }
        return text;
    }

    std::string tool(const Parts& parts) const {
        return "TOOL CALL " + parts.value('T') + " " + (parts.plane == ' ' ? 'Z' : parts.plane) +
               parts.of("SF") + (parts.has('M') ? kNextBlock + parts.of("M").substr(1) : std::string());
    }

    std::string special(const Parts& parts) {
        switch (parts.special) {
            case 30:
                return std::string("BLK FORM 0.1 ") + (parts.plane == ' ' ? 'Z' : parts.plane) +
                       parts.of("XYZ");
            case 31:
                return "BLK FORM 0.2" + parts.of("XYZ");
            case 99:
                return "TOOL DEF " + parts.value('T') + parts.of("LR");
            case 51:
                return "TOOL DEF " + parts.value('T');
            case 4:
                return "CYCL DEF 9.0 DWELL" + std::string(1, kNextBlock) + "CYCL DEF 9.1 DWELL " +
                       parts.value('F');
            case 24:
                return "CHF " + parts.value('R') + parts.of("F");
            case 25:
                return "RND R" + parts.value('R') + parts.of("F");
            case 26:  // taken with the block before it
                return {};
            case 27:
                departure_ = parts.value('R');
                return {};
            case 29:
                return "CC";
            case 38:
                return "STOP" + parts.of("M");
            case 28:
                return "CYCL DEF 8.0" + std::string(1, kNextBlock) + "CYCL DEF 8.1" + letters_of(parts);
            case 54:
                return "TRANS DATUM AXIS" + axes(parts);
            case 72:
                return "TRANS SCALE SCL" + parts.value('F');
            case 73:
                return std::string("TRANS ROTATION ") + (incremental_ ? "IROT" : "ROT") + parts.value('H');
            default:
                return "G" + std::to_string(parts.special) + parts.of("XYZABCPTIJKRHFSM");
        }
    }

    static std::string letters_of(const Parts& parts) {
        std::string text;
        for (const IsoWord& word : parts.words) text += std::string(" ") + word.letter;
        return text;
    }

    // A cycle ends with '*', which may be missing behind its last parameter, Q or P.
    bool cycle_goes_on() const {
        if (ends(lines_[at_])) return false;
        for (std::size_t i = at_ + 1; i < lines_.size(); ++i) {
            const std::string block = block_of(lines_[i]);
            if (!block.empty()) return block[0] == 'Q' || block[0] == 'P';
        }
        return false;
    }

    // Radius of the next block if it is G26, else nothing.
    std::string next_approach() const {
        for (std::size_t i = at_ + 1; i < lines_.size(); ++i) {
            const std::string block = block_of(lines_[i]);
            if (block.empty()) continue;
            const auto words = words_of(block);
            const bool is_approach =
                words && words->size() >= 2 && (*words)[0].letter == 'G' && (*words)[0].value == "26";
            return is_approach && (*words)[1].letter == 'R' ? (*words)[1].value : std::string();
        }
        return {};
    }

    std::string move(const Parts& parts) {
        std::string before;
        const bool is_polar = path_ >= 10;
        if (parts.has('I') || parts.has('J')) {
            before = "CC";
            for (const auto& [centre, letter] : {std::pair{'I', 'X'}, {'J', 'Y'}}) {
                if (parts.has(centre))
                    before += std::string(incremental_ ? " I" : " ") + letter + parts.value(centre);
            }
        }
        std::string to = axes(parts);
        if (is_polar && parts.has('R')) to += std::string(incremental_ ? " IPR" : " PR") + parts.value('R');
        if (is_polar && parts.has('H')) to += std::string(incremental_ ? " IPA" : " PA") + parts.value('H');
        const std::string rest =
            parts.side + (path_ == 0 || path_ == 10 ? " FMAX" : parts.of("F")) + parts.of("M");
        const bool moves = !to.empty() || (!parts.side.empty() && path_ <= 1);
        if (!moves) {
            const std::string alone = parts.of("M");
            // A feed alone holds for what follows.
            std::string text = before;
            if (!alone.empty()) text += (text.empty() ? "" : std::string(1, kNextBlock)) + alone.substr(1);
            if (text.empty() && parts.has('F')) text = "L" + parts.of("F");
            return text;
        }
        if (!before.empty()) before += kNextBlock;
        return before + path_block(parts, to, rest);
    }

    std::string path_block(const Parts& parts, const std::string& to, const std::string& rest) {
        const bool is_line = path_ <= 1 || path_ == 7;
        if (is_line && (parts.side == " RL" || parts.side == " RR")) {
            if (const std::string radius = next_approach(); !radius.empty())
                return "APPR LCT" + to + " R" + radius + rest;
        }
        if (is_line && parts.side == " R0" && !departure_.empty() && !to.empty())
            return "DEP LCT" + to + " R" + std::exchange(departure_, {}) + rest.substr(3);
        if (path_ == 2 || path_ == 3 || path_ == 12 || path_ == 13) turn_ = path_ % 2 == 0 ? " DR-" : " DR+";
        switch (path_) {
            case 2:
            case 3:
            case 5:
                return (parts.has('R') ? "CR" + to + " R" + parts.value('R') : "C" + to) + turn_ + rest;
            case 6:
                return "CT" + to + rest;
            case 10:
            case 11:
                return "LP" + to + rest;
            case 12:
            case 13:
            case 15:
                return "CP" + to + turn_ + rest;
            case 16:
                return "CTP" + to + rest;
            default:
                return "L" + to + rest;
        }
    }

    std::vector<std::string_view> lines_;
    std::size_t at_ = 0;
    bool ends_with_star_ = false, begun_ = false, in_cycle_ = false, incremental_ = false;
    int path_ = 1;
    std::string turn_ = " DR+", departure_;  // of G27
};

}  // namespace

bool looks_like_din_iso(std::string_view bytes) {
    TextLines lines(bytes.substr(0, kLookedAt));
    while (const auto line = lines.next()) {
        const std::string block = block_of(*line);
        if (block.empty()) continue;
        return block[0] == '%' && block.size() > 1 &&
               (block.find(" G70") != std::string::npos || block.find(" G71") != std::string::npos);
    }
    return false;
}

std::string in_conversational_words(std::string_view bytes) {
    return Translator(bytes).run();
}

}  // namespace tribo::readers
