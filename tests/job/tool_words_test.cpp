// SPDX-License-Identifier: MIT
#include "job/words/tool_words.hpp"

#include <gtest/gtest.h>

namespace tribo::job {
namespace {

using milling::Cutter;
using milling::CutterKind;

Cutter read(const std::string& text) {
    const auto cutter = parse_tool_words(text);
    EXPECT_TRUE(cutter) << text << ": " << cutter.error().text();
    return cutter.value_or(Cutter{});
}

std::string refusal(const std::string& text) {
    const auto cutter = parse_tool_words(text);
    return cutter ? "read: " + text : cutter.error().text();
}

TEST(ToolWords, are_read_in_any_order_and_spelling) {
    const struct {
        const char* text;
        int number;
        CutterKind kind;
        double diameter_mm, corner_mm;
        int flutes;
    } cases[] = {
        {"flat 6", 0, CutterKind::flat, 6, 0, 2},
        {"6 flat", 0, CutterKind::flat, 6, 0, 2},
        {"FLAT D6 mm", 0, CutterKind::flat, 6, 0, 2},
        {"T2 ball 8 flutes 3", 2, CutterKind::ball, 8, 0, 3},
        {"ball 8 3 flutes", 0, CutterKind::ball, 8, 0, 3},
        {"ball-nose 6 flutes 2 T12", 12, CutterKind::ball, 6, 0, 2},
        {"bull 10 corner 1 flutes 4", 0, CutterKind::bull, 10, 1, 4},
        {"Bull nose end mill D=10 R=0.5, 4 flutes", 0, CutterKind::bull, 10, 0.5, 4},
        {"flat end mill 6mm", 0, CutterKind::flat, 6, 0, 2},
        {"end mill 6", 0, CutterKind::flat, 6, 0, 2},
        {"flat 1/4in", 0, CutterKind::flat, 6.35, 0, 2},
        {"flat .25\" 2 flute", 0, CutterKind::flat, 6.35, 0, 2},
        {"bull diameter_mm=12 corner_mm=2 flutes=6 helix_deg=45 length_mm=30", 0, CutterKind::bull, 12, 2, 6},
        // As CAM systems write tools into comments.
        {"T1 D=6. CR=0. - flat end mill", 1, CutterKind::flat, 6, 0, 2},
        {"T3 D=6. CR=3.", 3, CutterKind::ball, 6, 0, 2},
        {"T4 D=6. CR=1.", 4, CutterKind::bull, 6, 1, 2},
    };
    for (const auto& c : cases) {
        const Cutter cutter = read(c.text);
        EXPECT_EQ(cutter.number, c.number) << c.text;
        EXPECT_EQ(cutter.kind, c.kind) << c.text;
        EXPECT_DOUBLE_EQ(cutter.diameter_mm, c.diameter_mm) << c.text;
        EXPECT_EQ(cutter.corner_mm, c.corner_mm) << c.text;
        EXPECT_EQ(cutter.flutes, c.flutes) << c.text;
    }
    const Cutter full = read("flat 12 flutes 3 helix -15 length 1in core 2");
    EXPECT_EQ(full.helix_deg, -15);
    EXPECT_EQ(full.length_mm, 25.4);
    EXPECT_EQ(full.core_mm, 2);
}

TEST(ToolWords, that_are_wrong_are_refused_with_the_nearest) {
    const std::pair<const char*, const char*> cases[] = {
        {"flta 6", "error: 'flta' is no word of a tool; try 'flat'"},
        {"flat 6 helix", "error: 'helix' has no number behind it; write 'helix 2', for example"},
        {"flat 6 fluts 2", "error: 'fluts' is no word of a tool; try 'flutes'"},
        {"6", "error: the tool has no kind; write flat, ball or bull, as in 'flat 6'"},
        {"", "error: the tool has no diameter; write it in mm, as in 'flat 6'"},
        {"flat", "error: the tool has no diameter; write it in mm, as in 'flat 6'"},
        {"flat 6 8",
         "error: the number 8 has no word before it; write its word: diameter, flutes, corner, "
         "helix, length or core"},
        {"flat 6 flutes 2 flutes 3", "error: the number 3 says the same thing again; keep one of them"},
        {"flat ball 6", "error: a tool has one kind, and this one two; keep one"},
        {"bull 10", "error: a bull tool has no corner here; add 'corner 1'"},
        {"flat 10 corner 1", "error: a flat tool has no corner; write bull, or leave the corner out"},
        {"ball 10 corner 1",
         "error: the corner of a ball is its radius; write bull, or leave the corner out"},
        {"flat 6 flutes 2.5", "error: 2.5 is no count; write a whole number"},
        {"flat 6 flutes 0", "error: the flutes of 0 is out of range; keep the flutes within 1 to 64"},
        {"T0 flat 6",
         "error: the tool number of 0 is out of range; keep the tool number within 1 to 999999999"},
        {"flat 6 flutes 2mm", "error: the unit behind 2 does not fit; leave it out"},
        {"flat 1/0in", "error: '1/0' is no fraction; write 1/4, or 0.25"},
        {"flat 6 #2", "error: the character '#' has no meaning here; write words and numbers"},
    };
    for (const auto& [text, error] : cases) EXPECT_EQ(refusal(text), error);
    // Impossible cutters are refused as in a job.
    for (const char* text : {"flat 0", "flat -6", "bull 10 corner 5", "flat 6 flutes 100", "flat 6 helix 90",
                             "flat 6 length 0", "flat 6 core 7", "flat 1e400"}) {
        EXPECT_TRUE(refusal(text).starts_with("error: ")) << text;
    }
    EXPECT_NE(refusal("reamer 6").find("try one of flat, ball, bull"), std::string::npos)
        << refusal("reamer 6");
}

TEST(ToolWords, are_written_as_they_are_read) {
    for (const char* text : {"flat 6 flutes 2", "T7 ball 0.1 flutes 3", "bull 10 corner 1.5 flutes 4",
                             "flat 12 flutes 3 helix -15 length 25.4 core 2"}) {
        EXPECT_EQ(tool_words(read(text)), text);
    }
}

}  // namespace
}  // namespace tribo::job
