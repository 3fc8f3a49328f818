// SPDX-License-Identifier: MIT
#include "files/mapped_file.hpp"

#include <gtest/gtest.h>

#include "files/scratch.hpp"

namespace tribo::files {
namespace {

TEST(MappedFile, shows_a_files_bytes_and_keeps_them_when_it_is_replaced) {
    const test::Scratch scratch;
    const std::string path = scratch.path() + "/a.bin";
    ASSERT_TRUE(replace_file(path, "first").has_value());
    const auto first = MappedFile::open(path);
    ASSERT_TRUE(first.has_value());
    ASSERT_TRUE(replace_file(path, "second one").has_value());
    EXPECT_EQ((*first)->bytes(), "first");
    const auto second = MappedFile::open(path);
    ASSERT_TRUE(second.has_value());
    EXPECT_EQ((*second)->bytes(), "second one");
    ASSERT_TRUE(replace_file(path, "").has_value());
    const auto empty = MappedFile::open(path);
    ASSERT_TRUE(empty.has_value());
    EXPECT_TRUE((*empty)->bytes().empty());
}

TEST(MappedFile, refuses_folders_and_what_is_not_there) {
    const test::Scratch scratch;
    EXPECT_FALSE(MappedFile::open(scratch.path()).has_value());
    EXPECT_FALSE(MappedFile::open(scratch.path() + "/none").has_value());
    EXPECT_FALSE(replace_file(scratch.path() + "/none/a", "x").has_value());
}

}  // namespace
}  // namespace tribo::files
