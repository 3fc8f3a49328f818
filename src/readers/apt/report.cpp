// SPDX-License-Identifier: MIT
#include "readers/apt/report.hpp"

#include <utility>

#include "base/text/limit_text.hpp"

namespace tribo::readers::apt {

std::string quoted(std::string_view text) {
    constexpr std::size_t longest = 24;
    std::string shown = "'";
    for (const char c : text.substr(0, longest)) shown += c >= ' ' && c <= '~' ? c : '?';
    return shown + (text.size() > longest ? "...'" : "'");
}

std::unexpected<Error> Report::refuse(const Item& at, std::string cause, std::string remedy) const {
    return fail_at(source_name_, at.line, at.column, std::move(cause), std::move(remedy));
}

Result<double> Report::number(const Item& item) const {
    const auto value = number_of(item.text);
    if (!value) {
        return refuse(item,
                      item.text.empty() ? "a number is missing" : quoted(item.text) + " is not a number",
                      "write a decimal number");
    }
    return *value;
}

Result<double> Report::number(const Item& item, const Range& range) const {
    const auto value = number(item);
    if (value && !range.contains(*value))
        return refuse(item, quoted(item.text) + " is out of range",
                      "give a number from " + plain_number(range.min) + " to " + plain_number(range.max));
    return value;
}

Result<double> Report::number(const Item& item, const Limit& limit, double scale) const {
    const auto value = number(item);
    if (value && !limit.range.contains(*value * scale))
        return refuse(item, quoted(item.text) + " is out of range", range_remedy(limit));
    return value;
}

bool Report::first(Note note) {
    return !std::exchange(noted_[static_cast<std::size_t>(note)], true);
}

void Report::warn(int line, std::string text) {
    warnings.push_back({source_name_, line, std::move(text)});
}

}  // namespace tribo::readers::apt
