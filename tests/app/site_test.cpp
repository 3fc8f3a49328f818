// SPDX-License-Identifier: MIT
// `tribo site` from outside.
#include <filesystem>
#include <gtest/gtest.h>

#include "app/run/program.hpp"

namespace tribo::test {
namespace {

TEST(Site, is_the_built_pages_and_replaces_the_pages_of_an_older_one) {
    Scratch scratch;
    scratch.put("pages/index.html", "<p>page");
    scratch.put("pages/materials/a.json", "{}");
    scratch.put("pages/old.html", "old");
    const auto site = [&] {
        return run_tribo({"site", "--out", "out", "--web-root", "pages"}, scratch.path());
    };
    ASSERT_EQ(site().code, 0);
    EXPECT_EQ(scratch.get("out/index.html"), "<p>page");
    EXPECT_EQ(scratch.get("out/materials/a.json"), "{}");
    EXPECT_EQ(scratch.get("out/old.html"), "old");
    scratch.put("out/mine.txt", "dear");
    std::filesystem::remove(scratch / "pages/old.html");
    ASSERT_EQ(site().code, 0);
    EXPECT_FALSE(std::filesystem::exists(scratch / "out/old.html"));
    EXPECT_EQ(scratch.get("out/mine.txt"), "dear");
    std::filesystem::remove_all(scratch / "out");
    scratch.put("out/mine.txt", "not a site");
    EXPECT_EQ(site().code, 2);
    EXPECT_EQ(scratch.get("out/mine.txt"), "not a site");
}

TEST(Site, says_what_to_do_where_the_pages_are_not_built) {
    Scratch scratch;
    const Outcome run = run_tribo({"site", "--out", "out", "--web-root", "nowhere"}, scratch.path());
    EXPECT_EQ(run.code, 2);
    EXPECT_NE(run.err.find("make build"), std::string::npos) << run.err;
    EXPECT_FALSE(std::filesystem::exists(scratch / "out"));
}

}  // namespace
}  // namespace tribo::test
