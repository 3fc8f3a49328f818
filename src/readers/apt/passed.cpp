// SPDX-License-Identifier: MIT
#include "readers/apt/passed.hpp"

#include <algorithm>

#include "readers/apt/words.hpp"

namespace tribo::readers::apt {
namespace {

constexpr std::size_t kMostNamed = 20;

std::unexpected<Error> refuse(const Item& word, const Report& report) {
    return report.refuse(word, "statement " + quoted(word.text) + " is not known",
                         "check that the file is APT CLDATA; delete the line where it moves no tool");
}

}  // namespace

Result<void> PassedWords::add(const Item& word, const Report& report) {
    if (!is_post_word(word.text) || matches(word.text.substr(0, 2), "GO")) return refuse(word, report);
    if (std::ranges::any_of(words_, [&](const Item& w) { return matches(w.text, word.text); })) return {};
    if (words_.size() < kMostNamed) {
        words_.push_back(word);
    } else {
        ++more_;
    }
    return {};
}

Result<void> PassedWords::refuse_first(const Report& report) const {
    if (words_.empty()) return {};
    return refuse(words_.front(), report);
}

void PassedWords::warn(Report& report) const {
    for (const Item& word : words_) {
        report.warn(word.line, quoted(word.text) + " is a word for a post-processor: it is passed over");
    }
    if (more_ > 0) {
        report.warn(0, std::to_string(more_) + " statements with other such words are passed over");
    }
}

}  // namespace tribo::readers::apt
