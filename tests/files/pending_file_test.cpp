// SPDX-License-Identifier: MIT
// Files of others stay as they are, and a file is always the whole work of one writer.
#include "files/pending_file.hpp"

#include <array>
#include <fcntl.h>
#include <filesystem>
#include <gtest/gtest.h>
#include <optional>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include "files/scratch.hpp"
#include "files/sibling.hpp"

namespace tribo::files {
namespace {

namespace fs = std::filesystem;
using test::Scratch;

TEST(PendingFile, leaves_files_of_similar_names_alone) {
    const Scratch scratch;
    scratch.put("notes", "mine");
    fs::create_symlink(scratch / "notes", scratch / "r.wav.part");
    ASSERT_EQ(::mkfifo((scratch / "r.wav.tribo-part").c_str(), 0600), 0);
    ASSERT_EQ(::mkfifo((scratch / ".r.wav.tribo-part-0").c_str(), 0600), 0);
    fs::create_symlink(scratch / "notes", scratch / ".r.wav.tribo-part-1");
    ASSERT_TRUE(write_file(scratch / "r.wav", "sound"));
    EXPECT_EQ(scratch.get("r.wav"), "sound");
    EXPECT_EQ(scratch.get("notes"), "mine");
    EXPECT_EQ(scratch.entries(), 6u);
}

TEST(PendingFile, replaces_the_file_that_a_link_names_and_keeps_the_link) {
    const Scratch scratch;
    scratch.put("there/old", "old");
    fs::create_symlink("there/old", scratch / "link");
    {
        auto file = FileWriter::create(scratch / "link");
        ASSERT_TRUE(file);
        file->write("half");
        EXPECT_EQ(scratch.get("there/old"), "old");
    }
    EXPECT_EQ(scratch.get("there/old"), "old");
    ASSERT_TRUE(write_file(scratch / "link", "new"));
    EXPECT_TRUE(fs::is_symlink(scratch / "link"));
    EXPECT_EQ(scratch.get("there/old"), "new");
    fs::create_symlink("there/none", scratch / "dangling");
    ASSERT_TRUE(write_file(scratch / "dangling", "made"));
    EXPECT_EQ(scratch.get("there/none"), "made");
}

TEST(PendingFile, keeps_the_permissions_of_the_file_that_it_replaces) {
    const Scratch scratch;
    scratch.put("f", "old");
    fs::permissions(scratch / "f", fs::perms(0640));
    ASSERT_TRUE(write_file(scratch / "f", "new"));
    EXPECT_EQ(fs::status(scratch / "f").permissions(), fs::perms(0640));
}

TEST(PendingFile, of_a_killed_writer_is_removed_and_of_a_living_one_kept) {
    const Scratch scratch;
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        const auto file = PendingFile::open(scratch / "f");
        ::_exit(file ? 0 : 1);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_EQ(status, 0);
    EXPECT_EQ(scratch.entries(), 1u);
    auto living = FileWriter::create(scratch / "f");
    ASSERT_TRUE(living);
    EXPECT_EQ(scratch.entries(), 1u);
    ASSERT_TRUE(write_file(scratch / "f", "second"));
    EXPECT_EQ(scratch.entries(), 2u);
    living->write("first");
    ASSERT_TRUE(living->finish());
    EXPECT_EQ(scratch.get("f"), "first");
    EXPECT_EQ(scratch.entries(), 1u);
}

// Who removes what a killed run left holds it: a process that made it a moment ago and was not yet quick
// enough to lock it must see that it is lost.
TEST(AbandonedSiblings, cannot_be_taken_while_they_are_removed) {
    const Scratch scratch;
    scratch.put(".f.tribo-part-1", "left");
    const int made = ::open((scratch / ".f.tribo-part-1").c_str(), O_WRONLY | O_CLOEXEC);
    ASSERT_GE(made, 0);
    int visited = 0;
    visit_abandoned(scratch.path(), ".f.tribo-part-", [&](const std::string& path) {
        EXPECT_FALSE(hold_sibling(made, path));
        ++visited;
        ASSERT_EQ(::unlink(path.c_str()), 0);
    });
    EXPECT_EQ(visited, 1);
    EXPECT_FALSE(hold_sibling(made, scratch / ".f.tribo-part-1"));
    ::close(made);
}

// Two writers of one file: it is the whole work of one of them, whichever ends last, and nothing is left.
void write_twice_at_once(int rounds) {
    const Scratch scratch;
    const std::array<std::string, 2> texts{std::string(700'000, 'a'), std::string(500'000, 'b')};
    for (int round = 0; round < rounds; ++round) {
        std::array<bool, 2> done{};
        {
            std::array<std::jthread, 2> writers;
            for (std::size_t n = 0; n < 2; ++n)
                writers[n] =
                    std::jthread([&, n] { done[n] = write_file(scratch / "f", texts[n]).has_value(); });
        }
        ASSERT_TRUE(done[0] && done[1]);
        const std::string found = scratch.get("f");
        ASSERT_TRUE(found == texts[0] || found == texts[1]) << round;
        ASSERT_EQ(scratch.entries(), 1u);
    }
}

TEST(PendingFile, of_two_writers_at_once_is_whole) {
    write_twice_at_once(100);
}
TEST(PendingFile, DISABLED_of_two_writers_at_once_is_whole_ten_thousand_times) {
    write_twice_at_once(10'000);
}

}  // namespace
}  // namespace tribo::files
