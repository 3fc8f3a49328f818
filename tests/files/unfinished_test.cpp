// SPDX-License-Identifier: MIT
// What an end without destructors removes. Each case runs in a child, since afterwards only its end is left.
#include "files/unfinished.hpp"

#include <filesystem>
#include <functional>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "files/files.hpp"
#include "files/output_folder.hpp"
#include "files/scratch.hpp"

namespace tribo::files {
namespace {

namespace fs = std::filesystem;

void in_child(const std::function<void()>& work) {
    const pid_t child = ::fork();
    if (child == 0) {
        work();
        ::_exit(1);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

// Before the destructors of the case run.
void end() {
    remove_unfinished();
    ::_exit(0);
}

bool any_name(const std::string&) {
    return true;
}

TEST(Unfinished, file_is_removed_and_the_old_one_stays) {
    const test::Scratch scratch;
    scratch.put("a.csv", "old");
    in_child([&] {
        auto file = FileWriter::create(scratch / "a.csv");
        auto other = FileWriter::create(scratch / "b.csv");
        file->write("new");
        if (scratch.entries() != 3) ::_exit(2);  // both have siblings
        end();
    });
    EXPECT_EQ(scratch.entries(), 1u);
    EXPECT_EQ(scratch.get("a.csv"), "old");
}

TEST(Unfinished, folder_is_removed_with_the_parents_made_for_it) {
    const test::Scratch scratch;
    in_child([&] {
        auto folder = OutputFolder::open(scratch / "new/parents/out", any_name);
        (void)write_file(folder->file("a"), "1");
        auto half = FileWriter::create(folder->file("b"));
        end();
    });
    EXPECT_EQ(scratch.entries(), 0u);
}

TEST(Unfinished, parent_with_something_else_in_it_stays) {
    const test::Scratch scratch;
    in_child([&] {
        auto folder = OutputFolder::open(scratch / "parent/out", any_name);
        scratch.put("parent/notes.txt", "mine");
        end();
    });
    EXPECT_EQ(scratch.get("parent/notes.txt"), "mine");
    EXPECT_EQ(std::distance(fs::directory_iterator(scratch / "parent"), fs::directory_iterator()), 1);
}

TEST(Unfinished, what_has_its_name_stays) {
    const test::Scratch scratch;
    in_child([&] {
        (void)write_file(scratch / "a.csv", "whole");
        for (const char* round : {"1", "2"}) {
            auto folder = OutputFolder::open(scratch / "made/out", any_name);
            (void)write_file(folder->file("a"), round);
            (void)folder->commit();
        }
        end();
    });
    EXPECT_EQ(scratch.get("a.csv"), "whole");
    EXPECT_EQ(scratch.get("made/out/a"), "2");
    EXPECT_EQ(scratch.entries(), 2u);
}

TEST(Unfinished, list_forgets_what_is_given_up) {
    const test::Scratch scratch;
    in_child([&] {
        {
            auto given_up = FileWriter::create(scratch / "a.csv");
        }
        {
            auto folder = OutputFolder::open(scratch / "out", any_name);
        }
        // Something of the same kind, later, by others.
        scratch.put("out/notes.txt", "mine");
        end();
    });
    EXPECT_EQ(scratch.get("out/notes.txt"), "mine");
}

}  // namespace
}  // namespace tribo::files
