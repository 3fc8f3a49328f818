// SPDX-License-Identifier: MIT
#include "job/words/stock_words.hpp"

#include <gtest/gtest.h>

namespace tribo::job {
namespace {

std::string refusal(const std::string& text) {
    const auto stock = parse_stock_words(text);
    return stock ? "read: " + text : stock.error().text();
}

TEST(StockWords, are_a_size_two_corners_or_a_model) {
    for (const char* text : {"80 60 20", "80x60x20", "80 x 60 X 20 mm", "80,60,20", " 80mm 60mm 20mm "}) {
        const auto stock = parse_stock_words(text);
        ASSERT_TRUE(stock) << text << ": " << stock.error().text();
        ASSERT_TRUE(stock->size_mm) << text;
        EXPECT_EQ(*stock->size_mm, (Vec3{80, 60, 20})) << text;
        EXPECT_TRUE(stock->solid.box_mm.empty() && !stock->solid.model) << text;
    }
    for (const char* text : {"3 x 2 x 1/2 in", "3in 2in 0.5in", "3\" 2\" .5\""}) {
        const auto stock = parse_stock_words(text);
        ASSERT_TRUE(stock) << text << ": " << stock.error().text();
        EXPECT_NEAR(stock->size_mm->x, 76.2, 1e-12) << text;
        EXPECT_NEAR(stock->size_mm->z, 12.7, 1e-12) << text;
    }
    for (const char* text : {"-40 -30 -20 40 30 0", "40 30 0 -40 -30 -20", "-40,-30,-20,40,30,0"}) {
        const auto box = parse_stock_words(text);
        ASSERT_TRUE(box) << text << ": " << box.error().text();
        EXPECT_FALSE(box->size_mm);
        EXPECT_EQ(box->solid.box_mm.min, (Vec3{-40, -30, -20})) << text;
        EXPECT_EQ(box->solid.box_mm.max, (Vec3{40, 30, 0})) << text;
        EXPECT_EQ(stock_words(box->solid.box_mm), "-40 -30 -20 40 30 0");
    }
    for (const char* text : {"blank.stl", "3d blank.STL", "in/blank", "80.obj"}) {
        const auto model = parse_stock_words(text);
        ASSERT_TRUE(model) << text << ": " << model.error().text();
        EXPECT_EQ(model->solid.model->path, text);
    }
}

TEST(StockWords, that_are_wrong_are_refused) {
    const std::string remedy = "; write a size, as in '80 60 20', two corners, or the name of a model";
    const std::string edges = "; keep the edge of a box within 0.001 to 100000 mm";
    const std::pair<const char*, std::string> cases[] = {
        {"", "error: the stock is empty" + remedy},
        {"80 60", "error: a block has 3 numbers (its size) or 6 (two corners), and these are 2" + remedy},
        {"80 60 2o", "error: 'o' is no length" + remedy},
        {"80 60 0", "error: the edge of a box of 0 mm is out of range" + edges},
        {"80 -60 20", "error: the edge of a box of -60 mm is out of range" + edges},
        {"10000000 60 20", "error: the edge of a box of 10000000 mm is out of range" + edges},
        {"0 0 0 80 60 0", "error: the edge of a box of 0 mm is out of range" + edges},
        {"0 0 0 80 60 10000000",
         "error: the coordinate of 10000000 mm is out of range; keep the coordinate within -1000000 to "
         "1000000 mm"},
        {"1e7 60 20", "error: 'e' is no length" + remedy},
        {"first.toml",
         "error: a stock that another job leaves needs a job; write [stock] from = "
         "\"first.toml\" into a job file"},
    };
    for (const auto& [text, error] : cases) EXPECT_EQ(refusal(text), error);
}

}  // namespace
}  // namespace tribo::job
