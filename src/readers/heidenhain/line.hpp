// SPDX-License-Identifier: MIT
// One block of Heidenhain conversational text as items: words with a number (X+10, IZ-2, R0), words with a
// sign (DR+), words alone (FMAX, TCPM). The line reader does not know their meaning.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/limits.hpp"
#include "base/result.hpp"
#include "readers/heidenhain/parameters.hpp"

namespace tribo::readers::heidenhain {

// A line without its block number and comment.
struct Line {
    std::string_view text;
    int number = 0;                // from 1
    int column = 1;                // of the first character of `text`
    bool goes_on = false;          // ends with '~': the next line belongs to it
    bool comment_goes_on = false;  // this '~' stands in a comment
};

// Returns the line as a block.
Line line_of(std::string_view text, int number);

struct Item {
    std::string name;  // upper case; empty: a number without a word
    std::optional<double> value;
    int sign = 0;        // of a word with a sign but no number: +1 or -1
    int parameter = -1;  // 200 for Q200=2
    std::string word;    // FAUTO, FMAX, MAX or PREDEF as the value of a parameter
    int line = 0, column = 0;
};

// Reads a line from left to right.
class LineReader {
  public:
    // `line` and the other references must outlive the object.
    LineReader(const Line& line, const std::string& source_name, const Parameters& parameters)
        : line_(line), source_name_(source_name), parameters_(parameters) {}

    bool at_end();
    int column();
    // Takes the word (upper case) if it is next and no letter or digit follows it directly.
    bool take(std::string_view word);
    // The same if the name of a parameter follows directly: REPQ5.
    bool take_before_parameter(std::string_view word);
    bool take(char character);
    // Reads a number with an optional sign, or a Q parameter.
    Result<std::optional<double>> number();
    Result<double> formula();
    // Reads the index of a parameter after its Q, QL or QR.
    Result<std::optional<int>> parameter();
    // Reads the number of a text after its QS.
    std::optional<int> text_parameter();
    // Reads texts in quotes and QS parameters joined by '||'; none if there is no text next.
    Result<std::optional<std::string>> text();
    // Reads the name of a label: a number, a text in quotes or a QS parameter.
    Result<std::string> label();
    // Skips words up to the last number of the line, and returns it: DIST 2, V.ZEIT 0.5, F250.
    Result<std::optional<double>> last_number();
    // Returns the next item; absent at the end.
    Result<std::optional<Item>> item();
    // Appends all items up to the end of the line.
    Result<void> items(std::vector<Item>& items);

    std::unexpected<Error> refuse(int column, std::string cause, std::string remedy) const;
    // Refuses a value out of its range. `value` is in the unit of the limit.
    Result<void> in_range(const Limit& limit, double value, int column) const;

  private:
    void skip_blanks();
    char peek() const { return at_ < line_.text.size() ? line_.text[at_] : '\0'; }
    Result<double> sum(int depth);
    Result<double> product(int depth);
    Result<double> power(int depth);
    Result<double> factor(int depth);

    const Line& line_;
    const std::string& source_name_;
    const Parameters& parameters_;
    std::size_t at_ = 0;
};

}  // namespace tribo::readers::heidenhain
