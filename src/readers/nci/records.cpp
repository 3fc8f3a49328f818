// SPDX-License-Identifier: MIT
#include "readers/nci/records.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

#include "readers/apt/report.hpp"
#include "readers/nci/reader.hpp"

namespace tribo::readers {
namespace nci {
namespace {

constexpr std::string_view kBlanks = " \t\v\f";
constexpr int kLargestCode = 99'999;

// A whole number that stands alone in its line.
std::optional<int> code_of(std::string_view line) {
    const std::string_view text = trimmed(line);
    int code = 0;
    const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), code);
    if (failed != std::errc() || end != text.data() + text.size() || code < 0 || code > kLargestCode)
        return {};
    return code;
}

void split(std::string_view line, int number, std::vector<apt::Item>& items) {
    for (std::size_t at = 0; (at = line.find_first_not_of(kBlanks, at)) != std::string_view::npos;) {
        const std::size_t end = std::min(line.find_first_of(kBlanks, at), line.size());
        items.push_back({line.substr(at, end - at), number, static_cast<int>(at) + 1});
        at = end;
    }
}

}  // namespace

Records::Records(std::string_view bytes, std::string source_name)
    : lines_(bytes), source_name_(std::move(source_name)) {}

Result<bool> Records::next(apt::Statement& record) {
    record = {};
    std::optional<std::string_view> line = lines_.next();
    while (line && trimmed(*line).find_first_not_of('\x1a') == std::string_view::npos) line = lines_.next();
    if (!line) return false;
    const int number = lines_.number();
    const std::size_t indent = std::min(line->find_first_not_of(kBlanks), line->size());
    const std::optional<int> code = code_of(*line);
    if (!code) {
        // The next record is sought from here on, so that one wrong line is one refusal.
        return fail_at(source_name_, number, static_cast<int>(indent) + 1,
                       apt::quoted(trimmed(*line)) + " stands where the number of a record is due",
                       "check that each record is two lines: its number, then its values");
    }
    code_ = *code;
    record.word = {trimmed(*line), number, static_cast<int>(indent) + 1};
    if (const auto values = lines_.next()) split(*values, lines_.number(), record.items);
    return true;
}

}  // namespace nci

bool looks_like_nci(std::string_view bytes) {
    constexpr int most_pairs = 4;
    // What files begin with: headers, comments, tool changes and parameters.
    const auto begins = [](int code) { return (code >= 1000 && code < 1100) || (code >= 10'000); };
    TextLines lines(bytes);
    int pairs = 0;
    for (auto line = lines.next(); line && pairs < most_pairs; line = lines.next()) {
        if (trimmed(*line).empty()) continue;
        const auto code = nci::code_of(*line);
        if (!code || (pairs == 0 && !begins(*code)) || !lines.next()) return false;
        ++pairs;
    }
    return pairs > 0;
}

}  // namespace tribo::readers
