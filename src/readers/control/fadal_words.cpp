// SPDX-License-Identifier: MIT
#include "readers/control/fadal_words.hpp"

#include <algorithm>
#include <vector>

#include "readers/control/block_text.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers {
namespace {

constexpr int kMainProgram = 7000;  // the subroutines are those behind it
constexpr int kLastSystem = 48;

struct FadalWord {
    char letter = 0;
    std::string value;  // a number, with its sign
};

struct FadalBlock {
    bool is_deletable = false;
    bool is_whole = true;  // else there is text that is no word
    std::vector<FadalWord> words;
    std::string comment;

    // The value of the first word of a letter; null: the block has none.
    const std::string* value(char letter) const {
        const auto found = std::ranges::find(words, letter, &FadalWord::letter);
        return found == words.end() ? nullptr : &found->value;
    }
    bool has_any(std::string_view letters) const {
        return std::ranges::any_of(words, [&](const FadalWord& word) {
            return letters.find(word.letter) != std::string_view::npos;
        });
    }
    bool has(char letter, std::string_view wanted) const {
        return std::ranges::any_of(
            words, [&](const FadalWord& word) { return word.letter == letter && word.value == wanted; });
    }
    bool has_cycle() const {
        return std::ranges::any_of(words, [](const FadalWord& word) {
            const bool is_cycle = word.value.starts_with('7') || word.value.starts_with('8');
            return word.letter == 'G' && word.value.size() > 1 && is_cycle && word.value != "80";
        });
    }
};

bool is_system(const std::string& number) {
    return all_digits(number) && number.size() < 3 && std::stoi(number) <= kLastSystem;
}

// A number without the zeros before it and behind its point, so that it can be compared.
std::string shortened(std::string_view number) {
    const bool is_negative = number.starts_with('-');
    std::string digits(number.substr(number.starts_with('+') || is_negative ? 1 : 0));
    if (digits.find('.') != std::string::npos) {
        digits.erase(digits.find_last_not_of('0') + 1);
        if (digits.ends_with('.')) digits.pop_back();
    }
    digits.erase(0, std::min(digits.find_first_not_of('0'), digits.size()));
    if (digits.empty()) return "0";
    if (digits[0] == '.') digits.insert(0, "0");
    return (is_negative ? "-" : "") + digits;
}

// R0+.1: the level R of a cycle is 0.1.
FadalBlock read_block(std::string_view line) {
    FadalBlock block;
    const std::size_t end = std::min(line.find_first_of("(*;"), line.size());
    if (end < line.size() && line[end] != '*') block.comment = line.substr(end);
    const std::string text = upper(line.substr(0, end));
    for (std::size_t at = 0; at < text.size();) {
        const char letter = text[at++];
        if (is_blank(letter)) continue;
        if (letter == '/' && block.words.empty()) {
            block.is_deletable = true;
            continue;
        }
        std::size_t to = at;
        if (to < text.size() && (text[to] == '-' || text[to] == '+')) ++to;
        while (to < text.size() && (is_digit(text[to]) || text[to] == '.')) ++to;
        std::string_view number(text.data() + at, to - at);
        const bool is_level =
            letter == 'R' && number == "0" && to < text.size() && (text[to] == '+' || text[to] == '-');
        if (is_level) {
            at = to++;
            while (to < text.size() && (is_digit(text[to]) || text[to] == '.')) ++to;
            number = std::string_view(text.data() + at, to - at);
        }
        at = to;
        const bool is_number =
            number.find_first_of("0123456789") != number.npos && std::ranges::count(number, '.') < 2;
        block.is_whole = block.is_whole && is_letter(letter) && is_number;
        if (letter != 'N') block.words.push_back({letter, shortened(number)});
    }
    return block;
}

class FadalWords {
  public:
    std::string line(std::string_view text) {
        if (trimmed(text).starts_with('%')) return std::string(text);
        block_ = read_block(text);
        if (!block_.is_whole) return std::string(text);  // refused as it is written
        return (block_.is_deletable ? "/" : "") + words() + block_.comment;
    }
    // True if the last line was the beginning of a subroutine.
    bool defines() const { return defines_; }

  private:
    std::string words() {
        defines_ = false;
        const std::string* loop = block_.value('L');
        if (loop != nullptr && block_.words.size() == 1) return subroutine(*loop);
        if (has_subroutines_ && !is_main_ && block_.has('M', "30")) {
            is_main_ = true;
            return program(0);
        }
        mode();
        const bool has_place = block_.has_any("XYZ");
        system();
        const bool is_repeated = loop != nullptr && !block_.has_cycle() && *loop != "1";
        const bool is_helix = is_repeated && turns(*loop);
        std::string out;
        for (const FadalWord& word : block_.words) out += in_fanuc(word, is_helix ? *loop : "");
        if (is_helix) {
            out += "P" + *loop;
        } else if (is_repeated) {
            out += "GFADALL";
        }
        const std::string* length = block_.value('H');
        const bool goes_home = length != nullptr && *length == "0" && block_.value('Z') != nullptr;
        return (has_place && (of_machine_ || goes_home) ? "G53 " : "") + out;
    }

    static std::string program(int subroutine) { return "O" + std::to_string(kMainProgram + subroutine); }

    // L200 begins subroutine 2, L203 runs it three times.
    std::string subroutine(const std::string& number) {
        if (!all_digits(number) || number.size() < 3 || number.size() > 4) return "GFADALL";
        const int code = std::stoi(number);
        std::string name = program(code / 100);
        mode_ = Mode::unknown;
        if (code % 100 > 0) return "M98P" + name.substr(1) + "L" + std::to_string(code % 100);
        defines_ = has_subroutines_ = true;
        return name;
    }

    void mode() {
        if (block_.has('G', "90")) mode_ = Mode::absolute;
        if (block_.has('G', "91")) mode_ = Mode::incremental;
    }

    // E0: places are those of the machine until the next E.
    void system() {
        const std::string* number = block_.value('E');
        if (number != nullptr) of_machine_ = *number == "0";
    }

    // A whole circle that is repeated is one of more turns, to the end of all of them.
    bool turns(const std::string& loop) const {
        const bool is_circle = block_.has_any("IJ") && !block_.has_any("XYK");
        const bool ends_known = block_.value('Z') == nullptr || mode_ == Mode::incremental;
        return is_circle && ends_known && all_digits(loop) && loop != "0";
    }

    std::string in_fanuc(const FadalWord& word, const std::string& turns) const {
        std::string plain = word.letter + word.value;
        switch (word.letter) {
            case 'E':
                if (word.value == "0") return "";
                return is_system(word.value) ? "G54.1P" + word.value : "GFADALE";
            case 'H':
                return word.value == "0" ? "G49" : "G43" + plain;
            case 'L':
                return block_.has_cycle() ? plain : "";
            case 'P':  // of a deep hole: where the feed begins again
                return block_.has('G', "83") || block_.has('G', "73") ? "" : plain;
            case 'Z':
                return turns.empty() ? plain : "Z[" + word.value + "*" + turns + "]";
            case 'M':
                return word.value == "17" ? "M99" : plain;
            case 'G':
                if (word.value == "8" || word.value == "9") return "";  // how the feed rises
                if (word.value == "84.1" || word.value == "74.1") return "G" + word.value.substr(0, 2);
                if (word.value == "84.2" || word.value == "74.2") return "";  // the next taps are rigid
                return plain;
            default:
                return plain;
        }
    }

    enum class Mode { unknown, absolute, incremental };

    FadalBlock block_;
    Mode mode_ = Mode::unknown;
    bool of_machine_ = false, has_subroutines_ = false, is_main_ = false, defines_ = false;
};

}  // namespace

bool looks_like_fadal(std::string_view bytes) {
    bool has_length = false, has_system = false;
    TextLines lines(bytes);
    while (const auto line = lines.next()) {
        const FadalBlock block = read_block(*line);
        if (!block.is_whole) continue;
        if (block.has('G', "43")) return false;
        has_length = has_length || (block.value('H') != nullptr && block.value('Z') != nullptr);
        const std::string* system = block.value('E');
        const bool may_name_system = block.has_any("XYH") || block.words.size() == 1;
        has_system = has_system || (system != nullptr && is_system(*system) && may_name_system);
    }
    return has_length && has_system;
}

std::string fadal_in_fanuc_words(std::string_view bytes) {
    FadalWords fadal;
    std::vector<std::string> translated;
    bool calls_main = false;
    TextLines lines(bytes);
    while (const auto line = lines.next()) {
        std::string text = fadal.line(*line);
        // The main program stands behind its subroutines: what is before them calls it.
        if (fadal.defines() && !calls_main && !translated.empty()) {
            std::string& before = translated.back();
            const std::size_t comment = std::min(before.find('('), before.size());
            const std::string_view words = trimmed(std::string_view(before).substr(0, comment));
            if (words.empty() || words.starts_with('O'))
                before = "M98P" + std::to_string(kMainProgram) + before.substr(comment);
            calls_main = true;
        }
        translated.push_back(std::move(text));
    }
    std::string all;
    for (const std::string& line : translated) all += line + '\n';
    return all;
}

}  // namespace tribo::readers
