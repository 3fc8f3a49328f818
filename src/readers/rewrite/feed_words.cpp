// SPDX-License-Identifier: MIT
#include "readers/rewrite/feed_words.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/text/decimal.hpp"
#include "readers/rewrite/word_search.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers {
namespace {

constexpr std::size_t kNone = std::string_view::npos;
constexpr WordName kFeedName{'F', "FEDRAT"};
constexpr double kMostFeed = 1e6;  // in the units of the program

// Where comments begin, and words end.
std::size_t code_end(std::string_view line, FeedLanguage language) {
    std::size_t end = line.find(';');
    if (language == FeedLanguage::gcode) end = std::min(end, line.find('('));
    if (language == FeedLanguage::heidenhain) end = std::min(end, line.find('~'));
    end = std::min(end, line.size());
    while (end > 0 && (line[end - 1] == ' ' || line[end - 1] == '\t')) --end;
    return end;
}

// How the numbers of the program's feeds are written.
struct NumberStyle {
    int most_decimals = 0;
    bool even_decimals = true;  // all have as many
    bool always_point = true;
    char point = '.';
    bool any = false;

    void learn(std::string_view number) {
        const std::size_t at = number.find_first_of(".,");
        const int decimals = at == kNone ? 0 : static_cast<int>(number.size() - at - 1);
        if (any && decimals != most_decimals) even_decimals = false;
        most_decimals = std::max(most_decimals, decimals);
        always_point = always_point && at != kNone;
        if (at != kNone) point = number[at];
        any = true;
    }
    // Rounded down, to a third of a per cent or better.
    std::string text(double value) const {
        constexpr double kFine = 0.003;
        constexpr int kMostDecimals = 6;
        int decimals = std::min(most_decimals, kMostDecimals);
        double unit = 1;
        for (int n = 0; n < decimals; ++n) unit /= 10;
        for (; decimals < kMostDecimals && unit > kFine * value; ++decimals) unit /= 10;
        const double scale = std::round(1 / unit);
        auto whole = static_cast<long long>(std::floor(value * scale * (1 + 1e-12)));
        std::string digits = std::to_string(std::max(whole, 1LL));
        if (static_cast<int>(digits.size()) <= decimals)
            digits.insert(0, static_cast<std::size_t>(decimals) + 1 - digits.size(), '0');
        std::string fraction = digits.substr(digits.size() - static_cast<std::size_t>(decimals));
        digits.resize(digits.size() - static_cast<std::size_t>(decimals));
        if (!even_decimals || decimals > most_decimals)
            while (!fraction.empty() && fraction.back() == '0') fraction.pop_back();
        if (!fraction.empty() || (always_point && any)) digits += point;
        return digits + fraction;
    }
};

double value_of(const std::string& number) {
    return number_at(number, 0)->value;
}

class FeedWriter {
  public:
    FeedWriter(std::string_view text, FeedLanguage language, const std::string& source_name)
        : text_(text), language_(language), source_(source_name) {
        for_each_line([&](int, std::string_view line, std::string_view) {
            if (const auto word = feed_in(line); word && !word->computed)
                style_.learn(line.substr(word->at, word->end - word->at));
            const std::string_view code = trimmed(line.substr(0, code_end(line, language_)));
            has_blanks_ = has_blanks_ || code.find_first_of(" \t") != kNone;
            return true;
        });
    }

    Result<std::string> write(std::span<const LineFeed> feeds) {
        auto next = feeds.begin();
        for_each_line([&](int number, std::string_view line, std::string_view end) {
            while (next != feeds.end() && next->line < number) ++next;
            const bool moves = next != feeds.end() && next->line == number;
            write_line(number, line, moves ? &*next : nullptr);
            out_ += end;
            return !error_;
        });
        if (error_) return std::unexpected(*error_);
        return std::move(out_);
    }

  private:
    // Visits number, text and end of each line, until it returns false. What stands before the first line is
    // the end of a line 0.
    template <class Visit>
    void for_each_line(Visit visit) const {
        TextLines lines(text_);
        const std::size_t start = text_.size() - lines.rest().size();
        if (start > 0 && !visit(0, std::string_view(), text_.substr(0, start))) return;
        while (const auto line = lines.next()) {
            const std::size_t end = static_cast<std::size_t>(line->data() - text_.data()) + line->size();
            if (!visit(lines.number(), *line, text_.substr(end, text_.size() - lines.rest().size() - end)))
                return;
        }
    }
    std::optional<NumberWord> feed_in(std::string_view line) const {
        return word_in_line(line, language_, kFeedName);
    }
    std::string unrolled(const std::string& remedy) const {
        return language_ == FeedLanguage::gcode ? remedy + ", or add --unroll" : remedy;
    }
    void refuse(int line, std::string cause, std::string remedy) {
        error_ = Error{source_, line, 0, std::move(cause), std::move(remedy)};
    }

    void write_line(int number, std::string_view line, const LineFeed* feed) {
        const auto word = feed_in(line);
        if (word && word->computed)
            return refuse(number, "the feed of this line is computed by the program",
                          unrolled("write it as a number"));
        const bool is_statement = word && language_ == FeedLanguage::apt;
        if (word) old_ = std::string(line.substr(word->at, word->end - word->at));
        if (is_statement) statement_ = std::string(line);
        // A statement moves nothing.
        if (feed == nullptr || is_statement) {
            if (word) now_ = old_;
            out_ += line;
            return;
        }
        if (old_.empty())
            return refuse(number, "no feed word stands before this move",
                          unrolled("write the first feed into the program"));
        const double old = value_of(old_), wanted = old * feed->factor;
        if (!(old > 0 && old <= kMostFeed))
            return refuse(number, "the feed of this move is " + old_ + ", which no control follows",
                          "write a feed above 0 and up to a million");
        const bool keeps = keeps_feed(feed->factor);
        const double now = now_.empty() ? 0 : value_of(now_);
        const bool holds = keeps ? now == old : now <= wanted && now >= (1 - kFeedReuse) * wanted;
        const std::string chosen = keeps ? old_ : style_.text(wanted);
        if (language_ == FeedLanguage::apt) {
            if (!holds) {
                // The statement that holds, with another number.
                const NumberWord at = *feed_in(statement_);
                std::string statement = statement_;
                statement.replace(at.at, at.end - at.at, chosen);
                out_ += statement + "\n";
                statement_ = std::move(statement);
                now_ = chosen;
            }
            out_ += line;
            return;
        }
        if (word) {
            const std::string text = keeps ? old_ : chosen;
            out_ += line.substr(0, word->at);
            out_ += text;
            out_ += line.substr(word->end);
            now_ = text;
            return;
        }
        if (holds) {
            out_ += line;
            return;
        }
        insert(line, chosen);
        now_ = chosen;
    }

    void insert(std::string_view line, const std::string& number) {
        std::size_t at = code_end(line, language_);
        if (language_ == FeedLanguage::heidenhain) {
            // M words come last.
            for (std::size_t n = 1; n + 1 < at; ++n) {
                if (line[n - 1] != ' ' || to_upper(line[n]) != 'M' || !is_digit(line[n + 1])) continue;
                at = n - 1;
                break;
            }
        }
        out_ += line.substr(0, at);
        out_ += has_blanks_ ? " F" : "F";
        out_ += number;
        out_ += line.substr(at);
    }

    std::string_view text_;
    FeedLanguage language_;
    const std::string& source_;
    NumberStyle style_;
    bool has_blanks_ = false;  // between words
    std::string out_;
    std::string old_, now_;  // numbers that hold: in the old text, in the new one; empty: none so far
    std::string statement_;  // of APT, that holds in the new text
    std::optional<Error> error_;
};

}  // namespace

bool keeps_feed(double factor) {
    return 1 / factor >= kFeedKeptBelow && 1 / factor <= kFeedKeptAbove;
}

Result<std::string> with_feeds(std::string_view text, FeedLanguage language, std::span<const LineFeed> feeds,
                               const std::string& source_name) {
    return FeedWriter(text, language, source_name).write(feeds);
}

}  // namespace tribo::readers
