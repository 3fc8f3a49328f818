// SPDX-License-Identifier: MIT
// Lines that Fortran programs write: fields of fixed widths, numbers with D for E. Private to
// readers/response/.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace tribo::readers {

// Words between blanks.
std::vector<std::string_view> words_of(std::string_view line);
// The part of a line from a column, from 0; shorter or empty at its end.
std::string_view columns(std::string_view line, std::size_t from, std::size_t width);

// Reads a number at the start of the text: 1.5E+00, 1.5D+00, 1.5-101. Another may follow at once. Returns
// the number of characters, 0 for none.
std::size_t next_fortran_number(std::string_view text, double& value);
// The number that the whole text is, without blanks around it; 0 for blanks; finite.
std::optional<double> fortran_number(std::string_view text);

// The numbers of a line: as many words, else the fields of these widths.
template <std::size_t N>
std::optional<std::array<double, N>> fortran_numbers(std::string_view line, std::array<int, N> widths) {
    std::array<double, N> values{};
    const auto words = words_of(line);
    bool good = words.size() >= N;
    for (std::size_t n = 0; n < N && good; ++n) {
        const auto value = fortran_number(words[n]);
        good = value.has_value();
        if (good) values[n] = *value;
    }
    if (good) return values;
    std::size_t at = 0;
    for (std::size_t n = 0; n < N; ++n) {
        const auto width = static_cast<std::size_t>(widths[n]);
        const auto value = fortran_number(columns(line, at, width));
        if (!value) return std::nullopt;
        values[n] = *value;
        at += width;
    }
    return values;
}

}  // namespace tribo::readers
