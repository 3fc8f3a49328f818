// SPDX-License-Identifier: MIT
#include "readers/tables/keyframes_csv.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "readers/refusals.hpp"

namespace tribo::readers {
namespace {

using motion::Keyframe;

TEST(KeyframesCsv, ReadsPosesWeightsAndFeeds) {
    const auto read = read_keyframes(
        "\xEF\xBB\xBF# bowl\r\n"
        "X, y ,z,i,j,k,feed_mm_per_min,weight\r\n"
        "\r\n"
        "1,2.5,-3,0,0,2,900,\r\n"
        "# half way\r\n"
        " 4 , 5 ,6e-1, 0,3,4,,0.5\r\n");
    ASSERT_TRUE(read.has_value()) << read.error().text();
    ASSERT_EQ(read->size(), 2U);
    const Keyframe& first = read->front();
    EXPECT_EQ(first.pose.tip_mm, (Vec3{1, 2.5, -3}));
    EXPECT_EQ(first.pose.axis, (Vec3{0, 0, 1}));
    EXPECT_EQ(first.weight, 1);
    EXPECT_EQ(first.feed_mm_per_min, 900);
    EXPECT_EQ(first.line, 4);
    const Keyframe& second = read->back();
    EXPECT_EQ(second.pose.tip_mm, (Vec3{4, 5, 0.6}));
    EXPECT_EQ(second.pose.axis, (Vec3{0, 0.6, 0.8}));
    EXPECT_EQ(second.weight, 0.5);
    EXPECT_EQ(second.feed_mm_per_min, 0);
    EXPECT_EQ(second.line, 6);
}

TEST(KeyframesCsv, ScalesPlacesByTheUnit) {
    KeyframeOptions options;
    options.unit_mm = 25.4;
    const auto read = read_keyframes("x,y,z,i,j,k\n1,0,0,0,0,1\n2,0,0,0,0,1\n", options);
    ASSERT_TRUE(read.has_value());
    EXPECT_EQ(read->back().pose.tip_mm.x, 50.8);
    EXPECT_EQ(read->back().pose.axis, (Vec3{0, 0, 1}));
}

TEST(KeyframesCsv, RefusesWhatIsNoMotionWithItsPlace) {
    const std::string header = "x,y,z,i,j,k,weight\n", row = "0,0,0,0,0,1,1\n";
    const Refusal refusals[] = {
        {"", 1, 0, "no keyframes"},
        {"\n#\n  \n", 3, 0, "no keyframes"},
        {"x,y,z\n", 1, 5, "too few columns"},
        {"x;y;z;i;j;k\n", 1, 1, "semicolons"},
        {"0,0,0,0,0,1\n", 1, 1, "column 1 is not x"},
        {"x,y,z,i,k,j\n", 1, 9, "column 5 is not j"},
        {"x,y,z,i,j,k,speed\n", 1, 13, "column 7 is neither"},
        {"x,y,z,i,j,k,weight,weight\n", 1, 20, "column 8 is neither"},
        {header, 1, 0, "two keyframes, this file has 0"},
        {header + row, 2, 0, "two keyframes, this file has 1"},
        {header + row + row, 3, 1, "that of the line before"},
        {header + row + "1,2,3\n", 3, 5, "3 fields, the header 7"},
        {header + row + "1,2,3,0,0,1,1,1\n", 3, 15, "8 fields"},
        {header + row + "1,2,x3,0,0,1,1\n", 3, 5, "not a number"},
        {header + row + "1,,3,0,0,1,1\n", 3, 3, "missing"},
        {header + row + "nan,0,3,0,0,1,1\n", 3, 1, "not a number"},
        {header + row + "1,0,inf,0,0,1,1\n", 3, 5, "not a number"},
        {header + row + "1,0,1e999,0,0,1,1\n", 3, 5, "not a number"},
        {header + row + "1,0,1e9,0,0,1,1\n", 3, 5, "out of range"},
        {header + row + "1,0,0, 0,0,0,1\n", 3, 8, "no length"},
        {header + row + "1,0,0,0,0,1,0\n", 3, 13, "out of range"},
        {header + row + "1,0,0,0,0,1,-1\n", 3, 13, "out of range"},
        {"x,y,z,i,j,k,feed_mm_per_min\n1,0,0,0,0,1,-5\n", 2, 13, "out of range"},
        {header + row + "1,0,0,0,0,1,1\xE4\n", 3, 13, "not a number"},
    };
    expect_refused(refusals, [](const std::string& text, const char* name) {
        KeyframeOptions options;
        options.source_name = name;
        return read_keyframes(text, options);
    });
    KeyframeOptions few;
    few.max_keyframes = 2;
    EXPECT_FALSE(read_keyframes("x,y,z,i,j,k\n1,0,0,0,0,1\n2,0,0,0,0,1\n3,0,0,0,0,1\n", few).has_value());
}

double coordinate() {
    return *rc::gen::inRange(-1'000'000, 1'000'000) / 7777.0;
}

RC_GTEST_PROP(KeyframesCsv, ReadsBackWhatWasWritten, ()) {
    std::vector<Keyframe> keyframes;
    const int count = *rc::gen::inRange(2, 40);
    const bool weights = *rc::gen::arbitrary<bool>(), feeds = *rc::gen::arbitrary<bool>();
    for (int i = 0; i < count; ++i) {
        Keyframe keyframe;
        keyframe.pose.tip_mm = {coordinate(), coordinate(), static_cast<double>(i)};
        keyframe.pose.axis = normalized({coordinate(), coordinate(), 1});
        if (weights) keyframe.weight = *rc::gen::inRange(1, 1000) / 77.0;
        if (feeds) keyframe.feed_mm_per_min = *rc::gen::inRange(0, 9000) / 7.0;
        keyframe.line = i + 2;
        keyframes.push_back(keyframe);
    }
    const auto back = read_keyframes(write_keyframes(keyframes));
    RC_ASSERT(back.has_value());
    RC_ASSERT(*back == keyframes);
}

}  // namespace
}  // namespace tribo::readers
