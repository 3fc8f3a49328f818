// SPDX-License-Identifier: MIT
#include "readers/rewrite/feed_words.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "readers/gcode/reader.hpp"

namespace tribo::readers {
namespace {

std::string changed(std::string_view text, FeedLanguage language, std::vector<LineFeed> feeds) {
    auto written = with_feeds(text, language, feeds, "p.nc");
    EXPECT_TRUE(written) << written.error().text();
    return written ? *std::move(written) : std::string();
}

TEST(FeedWords, are_written_only_where_they_change) {
    EXPECT_EQ(changed("G21 G90\nG1 X10 F500\nX20\nX30\nX40\n", FeedLanguage::gcode,
                      {{2, 1}, {3, 0.5}, {4, 0.5}, {5, 1}}),
              "G21 G90\nG1 X10 F500\nX20 F250\nX30\nX40 F500\n");
}

TEST(FeedWords, keep_the_format_of_the_number_and_of_the_line) {
    EXPECT_EQ(changed("G1X10F500.\r\nX20(cut)\r\n", FeedLanguage::gcode, {{1, 0.5}, {2, 0.25}}),
              "G1X10F250.\r\nX20F125.(cut)\r\n");
    EXPECT_EQ(changed("G1 X10 F20.00\nX20 ; cut\n", FeedLanguage::gcode, {{1, 1}, {2, 0.5}}),
              "G1 X10 F20.00\nX20 F10.00 ; cut\n");
    EXPECT_EQ(changed("G1 X1 f 100\nX2\n", FeedLanguage::gcode, {{1, 0.1234}, {2, 1}}),
              "G1 X1 f 12.34\nX2 F100\n");
}

TEST(FeedWords, are_rounded_down_to_a_third_of_a_per_cent) {
    EXPECT_EQ(changed("G1 X1 F1000\n", FeedLanguage::gcode, {{1, 0.7777}}), "G1 X1 F777\n");
    EXPECT_EQ(changed("G1 X1 F10\n", FeedLanguage::gcode, {{1, 0.7777}}), "G1 X1 F7.77\n");
    EXPECT_EQ(changed("G1 X1 F.5\n", FeedLanguage::gcode, {{1, 0.1}}), "G1 X1 F0.05\n");
}

TEST(FeedWords, stay_where_the_change_is_small_and_hold_on_where_they_are_low_enough) {
    EXPECT_EQ(changed("G1 X1 F1000\nX2\nX3\n", FeedLanguage::gcode, {{1, 1.01}, {2, 0.5}, {3, 0.504}}),
              "G1 X1 F1000\nX2 F500\nX3\n");
    // Never above the wanted one.
    EXPECT_EQ(changed("G1 X1 F1000\nX2\n", FeedLanguage::gcode, {{1, 0.5}, {2, 0.498}}),
              "G1 X1 F500\nX2 F498\n");
}

TEST(FeedWords, in_comments_and_names_are_none) {
    EXPECT_EQ(changed("(F100 for F200)\no<f1> call\n#<f5>=3\nG1 X1 F100 (F7)\nX2 ;F8\n", FeedLanguage::gcode,
                      {{4, 0.5}, {5, 0.25}}),
              "(F100 for F200)\no<f1> call\n#<f5>=3\nG1 X1 F50 (F7)\nX2 F25 ;F8\n");
}

TEST(FeedWords, of_siemens_may_have_an_equals_sign_and_stand_beside_texts) {
    EXPECT_EQ(changed("MSG(\"F9\")\nG1 X1 F=400\nX2 OFFN=3\n", FeedLanguage::siemens, {{2, 0.5}, {3, 0.25}}),
              "MSG(\"F9\")\nG1 X1 F=200\nX2 OFFN=3 F100\n");
}

TEST(FeedWords, behind_functions_of_heidenhain_are_theirs) {
    EXPECT_EQ(
        changed("1 L X+1 R0 F800\n2 L M128 F5000\n3 L X+2\n4 L X+3 M140 MB+50 F750\n5 L X+4 M103 F20 F400\n",
                FeedLanguage::heidenhain, {{1, 1}, {3, 0.5}, {4, 0.5}, {5, 0.5}}),
        "1 L X+1 R0 F800\n2 L M128 F5000\n3 L X+2 F400\n4 L X+3 M140 MB+50 F750\n5 L X+4 M103 F20 F200\n");
}

TEST(FeedWords, of_heidenhain_stand_before_m_words) {
    EXPECT_EQ(
        changed("0 BEGIN PGM A MM\n1 FN 0: Q1 = +5\n2 L X+10 R0 F1000 M3\n3 L X+20 R0 M8\n4 L Z+5 R0 FMAX\n",
                FeedLanguage::heidenhain, {{3, 1}, {4, 0.5}}),
        "0 BEGIN PGM A MM\n1 FN 0: Q1 = +5\n2 L X+10 R0 F1000 M3\n3 L X+20 R0 F500 M8\n4 L Z+5 R0 FMAX\n");
}

TEST(FeedWords, of_apt_are_statements) {
    EXPECT_EQ(changed("FEDRAT/ 500.00,MMPM\nGOTO/1,0,0\nGOTO/2,0,0\nGOTO/3,0,0\n", FeedLanguage::apt,
                      {{2, 1}, {3, 0.5}, {4, 0.5}}),
              "FEDRAT/ 500.00,MMPM\nGOTO/1,0,0\nFEDRAT/ 250.00,MMPM\nGOTO/2,0,0\nGOTO/3,0,0\n");
    EXPECT_EQ(changed("FEDRAT/500\nGOTO/1,0,0\n", FeedLanguage::apt, {{1, 0.5}, {2, 0.5}}),
              "FEDRAT/500\nFEDRAT/250\nGOTO/1,0,0\n");
}

TEST(FeedWords, that_are_computed_missing_or_absurd_are_refused_with_their_line) {
    struct Case {
        const char* text;
        FeedLanguage language;
        int line;
        const char* cause;
    };
    for (const auto& [text, language, line, cause] : {
             Case{"#1=100\nG1 X1 F#1\n", FeedLanguage::gcode, 2, "computed"},
             Case{"G1 X1 F[2*50]\n", FeedLanguage::gcode, 1, "computed"},
             Case{"G1 X1 F=R5\n", FeedLanguage::siemens, 1, "computed"},
             Case{"1 L X+1 R0 FQ3\n", FeedLanguage::heidenhain, 1, "computed"},
             Case{"1 L X+1 R0 FAUTO\n", FeedLanguage::heidenhain, 1, "computed"},
             Case{"G1 X1\n", FeedLanguage::gcode, 1, "no feed word"},
             Case{"G1 X1 F-5\n", FeedLanguage::gcode, 1, "-5"},
             Case{"G1 X1 F0\nX2\n", FeedLanguage::gcode, 2, "no control follows"},
             Case{"G1 X1 F99999999999999999999\n", FeedLanguage::gcode, 1, "no control follows"},
         }) {
        const LineFeed feed{line, 0.5};
        const auto written = with_feeds(text, language, {&feed, 1}, "p.nc");
        ASSERT_FALSE(written) << text;
        EXPECT_EQ(written.error().line, line);
        EXPECT_NE(written.error().cause.find(cause), std::string::npos) << written.error().cause;
    }
}

RC_GTEST_PROP(FeedWords, give_the_wanted_feeds_when_read_again_and_nothing_the_second_time, ()) {
    const int count = *rc::gen::inRange(1, 40);
    std::string text = "G21 G90\nG0 X0 Y0 Z0\n";
    std::vector<double> old, factors;
    for (int n = 0; n < count; ++n) {
        const bool writes = n == 0 || *rc::gen::inRange(0, 3) == 0;
        old.push_back(writes ? *rc::gen::inRange(1, 50'000) : old.back());
        text += "G1 X" + std::to_string(n + 1);
        if (writes) text += " F" + std::to_string(static_cast<int>(old.back()));
        text += "\n";
        factors.push_back(*rc::gen::inRange(1, 4000) / 1000.0);
    }
    std::vector<LineFeed> feeds;
    for (int n = 0; n < count; ++n) feeds.push_back({n + 3, factors[static_cast<std::size_t>(n)]});
    const auto written = with_feeds(text, FeedLanguage::gcode, feeds, "p.nc");
    RC_ASSERT(written.has_value());
    const auto program = read_gcode(*written);
    RC_ASSERT(program.has_value());
    std::size_t n = 0;
    std::vector<LineFeed> again;
    for (const motion::Move& move : program->moves) {
        if (move.kind != motion::MoveKind::feed) continue;
        const double wanted = old[n] * (keeps_feed(factors[n]) ? 1 : factors[n]);
        RC_ASSERT(move.feed_mm_per_min <= wanted * (1 + 1e-9));
        RC_ASSERT(move.feed_mm_per_min >= wanted * (1 - kFeedReuse - 0.004));
        // Seen from the new feed.
        again.push_back({move.line, old[n] * factors[n] / move.feed_mm_per_min});
        ++n;
    }
    RC_ASSERT(n == old.size());
    const auto same = with_feeds(*written, FeedLanguage::gcode, again, "p.nc");
    RC_ASSERT(same.has_value());
    RC_ASSERT(*same == *written);
}

}  // namespace
}  // namespace tribo::readers
