// SPDX-License-Identifier: MIT
#include "job/toml/toml_key_parts.hpp"

#include <algorithm>

namespace tribo::job {
namespace {

// Returns the position after the string that begins at `at` with a quote. A string on one line that is not
// closed ends with its line.
std::size_t string_end(std::string_view text, std::size_t at) {
    const char quote = text[at];
    const std::string three(3, quote);
    const bool lines = text.substr(at, 3) == three;
    for (at += lines ? 3 : 1; at < text.size(); ++at) {
        if (text[at] == '\\' && quote == '"') {
            ++at;
        } else if (lines && text.substr(at, 3) == three) {
            at += 3;
            // Up to two more quotes belong to the string.
            for (int more = 0; more < 2 && at < text.size() && text[at] == quote; ++more) ++at;
            return at;
        } else if (!lines && (text[at] == quote || text[at] == '\n')) {
            return text[at] == quote ? at + 1 : at;
        }
    }
    return text.size();
}

}  // namespace

Result<void> check_key_parts(std::string_view text, const std::string& file) {
    int parts = 1;
    for (std::size_t at = 0; at < text.size();) {
        const char c = text[at];
        if (c == '"' || c == '\'') {
            at = string_end(text, at);
            continue;
        }
        if (c == '#') {
            at = std::min(text.find('\n', at), text.size());
            continue;
        }
        if (c == '.' && ++parts > kMostKeyParts) {
            const std::size_t line_start = text.rfind('\n', at) + 1;  // npos + 1 is 0
            return fail_at(file, 1 + static_cast<int>(std::ranges::count(text.substr(0, at), '\n')),
                           static_cast<int>(at - line_start) + 1,
                           "a key has more than " + std::to_string(kMostKeyParts) + " parts",
                           "write [section] and key = value");
        }
        if (std::string_view("\n=,[]{}").find(c) != std::string_view::npos) parts = 1;
        ++at;
    }
    return {};
}

}  // namespace tribo::job
