// SPDX-License-Identifier: MIT
#include "files/output_folder.hpp"

#include <csignal>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "files/scratch.hpp"

namespace tribo::files {
namespace {

using test::Scratch;

constexpr const char* kOurs = R"({ "schema": "tribo.summary/1" })";

bool writes(const std::string& name) {
    return name == "summary.json" || name == "text" || name == "half";
}

// A run that writes a summary and one more file.
FileResult<void> run(const std::string& dir, const std::string& text) {
    FileResult<OutputFolder> folder = OutputFolder::open(dir, writes);
    if (!folder) return std::unexpected(folder.error());
    if (auto done = write_file(folder->file("summary.json"), kOurs); !done) return done;
    if (auto done = write_file(folder->file("text"), text); !done) return done;
    return folder->commit();
}

// Starts a run in a child that stops before its commit, kills the child as kill -9 does, and waits for its
// end.
void killed_run(const std::string& dir) {
    int ready[2];
    ASSERT_EQ(::pipe(ready), 0);
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        const FileResult<OutputFolder> folder = OutputFolder::open(dir, writes);
        const bool good = folder && write_file(folder->file("half"), "half");
        [[maybe_unused]] const ssize_t n = ::write(ready[1], good ? "y" : "n", 1);
        for (;;) ::pause();
    }
    char answer = 'n';
    ASSERT_EQ(::read(ready[0], &answer, 1), 1);
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    ::close(ready[0]);
    ::close(ready[1]);
    ASSERT_EQ(answer, 'y');
}

TEST(OutputFolder, appears_only_when_it_is_committed) {
    const Scratch scratch;
    auto folder = OutputFolder::open(scratch / "out", writes);
    ASSERT_TRUE(folder);
    ASSERT_TRUE(write_file(folder->file("summary.json"), kOurs));
    EXPECT_FALSE(std::filesystem::exists(scratch / "out"));
    ASSERT_TRUE(folder->commit());
    EXPECT_EQ(scratch.get("out/summary.json"), kOurs);
    EXPECT_EQ(scratch.entries(), 1u);
}

TEST(OutputFolder, leaves_nothing_without_a_commit_not_even_the_parents_it_made) {
    const Scratch scratch;
    {
        auto folder = OutputFolder::open(scratch / "a/b/out", writes);
        ASSERT_TRUE(folder);
        ASSERT_TRUE(write_file(folder->file("half"), "half"));
    }
    EXPECT_EQ(scratch.entries(), 0u);
    ASSERT_TRUE(run(scratch / "a/b/out", "x"));
    EXPECT_EQ(scratch.get("a/b/out/text"), "x");
}

TEST(OutputFolder, replaces_the_files_of_an_older_run_and_keeps_the_others) {
    const Scratch scratch;
    {
        auto folder = OutputFolder::open(scratch / "out", writes);
        ASSERT_TRUE(folder);
        std::filesystem::create_directories(folder->file("deep/er"));
        ASSERT_TRUE(write_file(folder->file("deep/er/stale"), "stale"));
        ASSERT_TRUE(write_file(folder->file("summary.json"), kOurs));
        ASSERT_TRUE(folder->commit());
    }
    scratch.put("out/notes/of mine\xe4", "dear");
    scratch.put("out/deep/note", "deep");
    std::filesystem::create_directory(scratch / "out/empty");
    std::filesystem::create_symlink("nowhere", scratch / "out/link");
    ASSERT_EQ(::mkfifo((scratch / "out/pipe").c_str(), 0600), 0);
    std::filesystem::permissions(scratch / "out", std::filesystem::perms(0750));
    for (const char* text : {"new", "newer"}) {
        ASSERT_TRUE(run(scratch / "out/", text));
        EXPECT_EQ(scratch.get("out/text"), text);
        EXPECT_EQ(scratch.get("out/notes/of mine\xe4"), "dear");
        EXPECT_EQ(scratch.get("out/deep/note"), "deep");
        EXPECT_TRUE(std::filesystem::is_directory(scratch / "out/empty"));
        EXPECT_TRUE(std::filesystem::is_symlink(scratch / "out/link"));
        EXPECT_TRUE(std::filesystem::is_fifo(scratch / "out/pipe"));
        EXPECT_FALSE(std::filesystem::exists(scratch / "out/deep/er"));
        EXPECT_EQ(std::filesystem::status(scratch / "out").permissions(), std::filesystem::perms(0750));
        EXPECT_EQ(scratch.entries(), 1u);
    }
}

TEST(OutputFolder, with_a_file_of_the_users_in_the_way_is_refused) {
    const Scratch scratch;
    ASSERT_TRUE(run(scratch / "out", "old"));
    scratch.put("out/half", "mine");
    const auto folder = OutputFolder::open(scratch / "out", writes);
    ASSERT_FALSE(folder);
    EXPECT_NE(folder.error().text().find("out/half"), std::string::npos) << folder.error().text();
    EXPECT_EQ(scratch.get("out/half"), "mine");
    // One that comes while the run goes on.
    std::filesystem::remove(scratch / "out/half");
    auto late = OutputFolder::open(scratch / "out", writes);
    ASSERT_TRUE(late);
    ASSERT_TRUE(write_file(late->file("half"), "new"));
    scratch.put("out/half", "mine");
    EXPECT_FALSE(late->commit());
    EXPECT_EQ(scratch.get("out/half"), "mine");
    EXPECT_EQ(scratch.get("out/text"), "old");
}

TEST(OutputFolder, keeps_the_older_one_when_a_run_is_given_up) {
    const Scratch scratch;
    ASSERT_TRUE(run(scratch / "out", "old"));
    {
        const auto folder = OutputFolder::open(scratch / "out", writes);
    }
    EXPECT_EQ(scratch.get("out/text"), "old");
    EXPECT_EQ(scratch.entries(), 1u);
}

TEST(OutputFolder, takes_the_place_of_an_empty_folder) {
    const Scratch scratch;
    std::filesystem::create_directory(scratch / "out");
    ASSERT_TRUE(run(scratch / "out", "x"));
    EXPECT_EQ(scratch.get("out/text"), "x");
}

TEST(OutputFolder, refuses_what_tribo_did_not_write) {
    const Scratch scratch;
    scratch.put("notes/diary.txt", "dear");
    scratch.put("foreign/summary.json", R"({"schema": "other/1"})");
    scratch.put("copied/summary.json", kOurs);
    scratch.put("copied/thesis.txt", "years");
    scratch.put("other/.tribo-files", "something else\n");
    scratch.put("file", "x");
    std::filesystem::create_directory_symlink(scratch / "notes", scratch / "link");
    const struct {
        const char* name;
        const char* fragment;
    } cases[] = {{"notes", "not one that tribo wrote"},
                 {"foreign", "not one that tribo wrote"},
                 {"copied", "not one that tribo wrote"},
                 {"other", "not one that tribo wrote"},
                 {"file", "existing file"},
                 {"link", "symbolic link"},
                 {"file/out", "Not a directory"}};
    for (const auto& c : cases) {
        const auto folder = OutputFolder::open(scratch / c.name, writes);
        ASSERT_FALSE(folder) << c.name;
        EXPECT_EQ(folder.error().fault, FileFault::input) << c.name;
        EXPECT_NE(folder.error().text().find(c.fragment), std::string::npos) << folder.error().text();
    }
    EXPECT_EQ(scratch.get("notes/diary.txt"), "dear");
    EXPECT_FALSE(OutputFolder::open("/", writes));
    EXPECT_FALSE(OutputFolder::open("", writes));
}

TEST(OutputFolder, refuses_a_foreign_folder_that_came_while_the_run_went_on) {
    const Scratch scratch;
    auto folder = OutputFolder::open(scratch / "out", writes);
    ASSERT_TRUE(folder);
    scratch.put("out/diary.txt", "dear");
    EXPECT_FALSE(folder->commit());
    EXPECT_EQ(scratch.get("out/diary.txt"), "dear");
}

TEST(OutputFolder, of_a_killed_run_leaves_the_old_one_and_the_next_run_cleans_up) {
    const Scratch scratch;
    ASSERT_TRUE(run(scratch / "out", "old"));
    ASSERT_NO_FATAL_FAILURE(killed_run(scratch / "out"));
    EXPECT_EQ(scratch.get("out/text"), "old");
    EXPECT_EQ(scratch.entries(), 2u);  // what was killed lies hidden beside it
    ASSERT_TRUE(run(scratch / "out", "new"));
    EXPECT_EQ(scratch.get("out/text"), "new");
    EXPECT_EQ(scratch.entries(), 1u);
}

TEST(OutputFolder, is_cleaned_even_when_the_next_run_is_refused) {
    const Scratch scratch;
    ASSERT_NO_FATAL_FAILURE(killed_run(scratch / "out"));
    scratch.put("out/diary.txt", "dear");
    EXPECT_FALSE(OutputFolder::open(scratch / "out", writes));
    EXPECT_EQ(scratch.entries(), 1u);
}

TEST(OutputFolder, leaves_the_work_of_living_runs_alone) {
    const Scratch scratch;
    auto first = OutputFolder::open(scratch / "out", writes);
    ASSERT_TRUE(first);
    ASSERT_TRUE(write_file(first->file("summary.json"), kOurs));
    ASSERT_TRUE(run(scratch / "out", "second"));
    EXPECT_TRUE(std::filesystem::exists(first->file("summary.json")));
    ASSERT_TRUE(first->commit());
    EXPECT_FALSE(std::filesystem::exists(scratch / "out/text"));  // the last to commit wins, whole
    EXPECT_EQ(scratch.entries(), 1u);
}

TEST(OutputFolder, brings_back_a_folder_that_a_killed_run_had_moved_aside) {
    const Scratch scratch;
    scratch.put(".out.tribo-older-1/summary.json", kOurs);
    {
        const auto folder = OutputFolder::open(scratch / "out", writes);
    }
    EXPECT_EQ(scratch.get("out/summary.json"), kOurs);
    EXPECT_EQ(scratch.entries(), 1u);
}

TEST(OutputFolder, may_be_named_with_dots_and_slashes) {
    const Scratch scratch;
    ASSERT_TRUE(run(scratch / "x/../out/./", "x"));
    EXPECT_EQ(scratch.get("out/text"), "x");
}

TEST(OutputFolder, is_gone_after_the_disk_was_full) {
    const Scratch scratch;
    struct rlimit before = {};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    struct rlimit small = before;
    small.rlim_cur = 1000;
    const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    const FileResult<void> result = run(scratch / "out", std::string(5000, 'x'));
    ::setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, old_handler);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().fault, FileFault::system);
    EXPECT_EQ(scratch.entries(), 0u);
}

}  // namespace
}  // namespace tribo::files
