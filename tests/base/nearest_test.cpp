// SPDX-License-Identifier: MIT
#include "base/text/nearest.hpp"

#include <array>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace tribo {
namespace {

TEST(EditDistance, counts_insertions_deletions_replacements_and_swaps) {
    EXPECT_EQ(edit_distance("", ""), 0);
    EXPECT_EQ(edit_distance("abc", ""), 3);
    EXPECT_EQ(edit_distance("kitten", "sitting"), 3);  // Wagner and Fischer's textbook pair
    EXPECT_EQ(edit_distance("diamter_mm", "diameter_mm"), 1);
    EXPECT_EQ(edit_distance("feed", "fede"), 1);
    EXPECT_EQ(edit_distance("Flat", "flat"), 0);
    EXPECT_EQ(edit_distance("ca", "abc"), 3);  // of the restricted form; the full one has 2
}

RC_GTEST_PROP(EditDistance, is_symmetric_and_bounded_by_the_longer_word,
              (const std::string& a, const std::string& b)) {
    const int d = edit_distance(a, b);
    RC_ASSERT(d == edit_distance(b, a));
    RC_ASSERT(d >= std::abs(static_cast<int>(a.size()) - static_cast<int>(b.size())));
    RC_ASSERT(d <= static_cast<int>(std::max(a.size(), b.size())));
}

TEST(Suggestion, names_a_near_word_and_lists_all_when_none_is_near) {
    constexpr std::array<std::string_view, 3> words{"diameter_mm", "flutes", "kind"};
    EXPECT_EQ(nearest("flute", words), "flutes");
    EXPECT_EQ(suggestion("diametre_mm", words), "try 'diameter_mm'");
    EXPECT_EQ(suggestion("zzzzzzzzzzzzz", words),
              "try one of diameter_mm, flutes, kind (nearest: 'diameter_mm')");
    EXPECT_EQ(suggestion("diam", words), "try 'diameter_mm'");
    EXPECT_EQ(suggestion("x", {}), "");
}

}  // namespace
}  // namespace tribo
