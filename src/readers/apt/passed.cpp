// SPDX-License-Identifier: MIT
#include "readers/apt/passed.hpp"

#include <algorithm>
#include <array>

#include "readers/apt/words.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers::apt {
namespace {

using namespace std::string_view_literals;

constexpr std::size_t kMostNamed = 20;

// What a part program of APT defines by `NAME=LINE/...`.
constexpr std::array kGeometry{"POINT"sv,  "LINE"sv,   "PLANE"sv,  "CIRCLE"sv, "CYLNDR"sv, "ELLIPS"sv,
                               "HYPERB"sv, "CONE"sv,   "GCONIC"sv, "LCONIC"sv, "VECTOR"sv, "MATRIX"sv,
                               "SPHERE"sv, "QADRIC"sv, "TABCYL"sv, "RLDSRF"sv, "PATERN"sv, "POLCON"sv};

bool defines_geometry(std::string_view text) {
    const std::size_t at = text.find('=');
    return at != std::string_view::npos && std::ranges::any_of(kGeometry, [&](std::string_view word) {
               return matches(trimmed(text.substr(at + 1)), word);
           });
}

std::unexpected<Error> refuse(const Item& word, const Report& report) {
    if (defines_geometry(word.text)) {
        return report.refuse(
            word, "a part program of APT, which defines geometry (LINE, CIRCLE, PATERN ...), is not read",
            "run it through an APT system, and give the CLDATA that this writes");
    }
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
