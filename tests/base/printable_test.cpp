// SPDX-License-Identifier: MIT
// Text of others on a terminal: nothing in it moves the cursor, recolours or reverses what stands there.
#include "base/text/printable.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "base/result.hpp"

namespace tribo {
namespace {

TEST(Printable, leaves_what_is_plain) {
    EXPECT_EQ(printable(""), "");
    EXPECT_EQ(printable("C:\\parts\\50%.nc"), "C:\\parts\\50%.nc");
    EXPECT_EQ(printable("Fr\u00e4steil \u00d810 \u2192 \u7c73 \U0001f600"),
              "Fr\u00e4steil \u00d810 \u2192 \u7c73 \U0001f600");
}

TEST(Printable, escapes_what_a_terminal_obeys) {
    EXPECT_EQ(printable("a\x1b[2Jb\x07\x7f"), "a\\x1b[2Jb\\x07\\x7f");
    EXPECT_EQ(printable("one\r\ntwo\t"), "one\\x0d\\ntwo\\t");
    EXPECT_EQ(printable(std::string_view("\0", 1)), "\\x00");
    EXPECT_EQ(printable("\u009b31m"), "\\x9b31m");  // CSI as one character
    EXPECT_EQ(printable("\u202etxt.exe\u2066\u200f\u061c"), "\\u202etxt.exe\\u2066\\u200f\\u061c");
    EXPECT_EQ(printable("a\u2028b"), "a\\u2028b");
}

TEST(Printable, shows_bytes_that_are_no_character) {
    EXPECT_EQ(printable("Fr\xe4steil"), "Fr\\xe4steil");      // Latin-1
    EXPECT_EQ(printable("\xc0\xaf\xff"), "\\xc0\\xaf\\xff");  // an overlong slash
    EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80");  // a surrogate
    EXPECT_EQ(printable("\xe2\x82"), "\\xe2\\x82");           // cut short
}

RC_GTEST_PROP(Printable, is_printable_and_stays, (const std::string& text)) {
    const std::string shown = printable(text);
    for (const char c : shown) RC_ASSERT(static_cast<unsigned char>(c) >= 0x20 && c != 0x7f);
    RC_ASSERT(printable(shown) == shown);
}

TEST(Printable, is_what_errors_and_warnings_are) {
    EXPECT_EQ((Error{"a\x1b.nc", 3, 1, "no '\n'", "b\x08"}.text()), "a\\x1b.nc:3:1: error: no '\\n'; b\\x08");
    EXPECT_EQ((Warning{"a\x1b.nc", 3, "what\x9d"}.message()), "a\\x1b.nc:3: warning: what\\x9d");
}

}  // namespace
}  // namespace tribo
