// SPDX-License-Identifier: MIT
#include "base/text/nearest.hpp"

#include <algorithm>
#include <vector>

namespace tribo {
namespace {

// From this share of wrong letters on, a word is more likely unknown than mistyped.
constexpr double kCloseShare = 0.5;

char lower(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

}  // namespace

int edit_distance(std::string_view a, std::string_view b) {
    const std::size_t columns = b.size() + 1;
    std::vector<int> before(columns), last(columns), row(columns);  // rows i-2, i-1, i of the table
    for (std::size_t j = 0; j < columns; ++j) last[j] = static_cast<int>(j);
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = static_cast<int>(i);
        for (std::size_t j = 1; j < columns; ++j) {
            const char ca = lower(a[i - 1]), cb = lower(b[j - 1]);
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (ca == cb ? 0 : 1)});
            if (i > 1 && j > 1 && ca == lower(b[j - 2]) && lower(a[i - 2]) == cb) {
                row[j] = std::min(row[j], before[j - 2] + 1);
            }
        }
        before.swap(last);
        last.swap(row);
    }
    return last[b.size()];
}

std::string_view nearest(std::string_view word, std::span<const std::string_view> candidates) {
    std::string_view best;
    int least = -1;
    for (const std::string_view candidate : candidates) {
        int distance = edit_distance(word, candidate);
        if (!word.empty() && candidate.starts_with(word))
            distance = std::min(distance, 1);  // abbreviated, not mistyped
        if (least < 0 || distance < least) {
            least = distance;
            best = candidate;
        }
    }
    return best;
}

bool is_close(std::string_view word, std::string_view candidate) {
    if (!word.empty() && candidate.starts_with(word)) return true;
    const double letters = static_cast<double>(std::max(word.size(), candidate.size()));
    return edit_distance(word, candidate) < kCloseShare * letters;
}

std::string suggestion(std::string_view word, std::span<const std::string_view> candidates) {
    const std::string_view best = nearest(word, candidates);
    if (best.empty()) return "";
    if (is_close(word, best)) return "try '" + std::string(best) + "'";
    std::string list;
    for (const std::string_view candidate : candidates) {
        list += (list.empty() ? "" : ", ") + std::string(candidate);
    }
    return "try one of " + list + " (nearest: '" + std::string(best) + "')";
}

}  // namespace tribo
