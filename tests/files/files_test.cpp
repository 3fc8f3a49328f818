// SPDX-License-Identifier: MIT
#include "files/files.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

#include "files/file_size_limit.hpp"
#include "files/scratch.hpp"

namespace tribo::files {
namespace {

using test::Scratch;

TEST(ReadFile, gives_every_byte_of_a_file) {
    const Scratch scratch;
    std::string text("a\0b\r\n\xff", 6);
    for (int doubling = 0; doubling < 12; ++doubling) text += text;
    scratch.put("f", text);
    EXPECT_EQ(read_file(scratch / "f").value(), text);
    scratch.put("empty", "");
    EXPECT_EQ(read_file(scratch / "empty").value(), "");
}

TEST(ReadFile, reads_a_file_whose_length_the_system_does_not_tell) {
    const FileResult<std::string> text = read_file("/proc/self/status");
    ASSERT_TRUE(text);
    EXPECT_NE(text->find("VmRSS"), std::string::npos);
}

TEST(ReadFile, reads_a_pipe_to_its_end) {
    const Scratch scratch;
    const std::string name = scratch / "pipe";
    ASSERT_EQ(::mkfifo(name.c_str(), 0600), 0);
    const std::string text(3'000'000, 'x');
    std::thread writer([&] { std::ofstream(name, std::ios::binary) << text; });
    EXPECT_EQ(read_file(name).value(), text);
    writer.join();
}

TEST(ReadFile, refuses_what_is_no_file_as_an_input_error) {
    const Scratch scratch;
    scratch.put("f", "12345");
    const struct {
        std::string path;
        const char* fragment;
        FileFault fault = FileFault::input;
    } cases[] = {
        {scratch / "none", "No such file", FileFault::missing},
        {scratch.path(), "is a folder"},
        {scratch / "f/g", "Not a directory"},
        {"/dev/null", "is a device"},
        {"", "empty"},
        {std::string("a\0b", 3), "zero byte"},
        {std::string(5000, 'a'), "too long"},
    };
    for (const auto& c : cases) {
        const FileResult<std::string> result = read_file(c.path);
        ASSERT_FALSE(result) << c.path;
        EXPECT_EQ(result.error().fault, c.fault) << c.path;
        EXPECT_NE(result.error().text().find(c.fragment), std::string::npos) << result.error().text();
    }
}

TEST(ReadFile, refuses_a_file_above_the_limit_before_taking_memory_for_it) {
    const Scratch scratch;
    scratch.put("f", "12345");
    EXPECT_TRUE(read_file(scratch / "f", 5));
    const FileResult<std::string> result = read_file(scratch / "f", 4);
    ASSERT_FALSE(result);
    EXPECT_NE(result.error().text().find("longer than the 4 bytes"), std::string::npos);
    std::filesystem::resize_file(scratch / "f",
                                 std::uintmax_t{1} << 40);  // sparse: a terabyte that is not there
    EXPECT_FALSE(read_file(scratch / "f"));
}

TEST(FileStamps, tell_whether_what_was_read_has_changed) {
    const Scratch scratch;
    scratch.put("f", "12345");
    ASSERT_TRUE(read_file(scratch / "f"));
    ASSERT_FALSE(read_file(scratch / "to come"));
    const auto read = [&] {
        FileStamps of_test;
        for (const auto& [name, stamp] : stamps_of_files_read())
            if (name.starts_with(scratch / "")) of_test[name] = stamp;
        return of_test;
    };
    EXPECT_FALSE(have_changed(read()));
    const FileStamps before = read();
    EXPECT_EQ(before.size(), 2u);
    const auto remake = [&] { scratch.put("f", "12345"); };
    const struct {
        const char* what;
        std::function<void()> change;
    } cases[] = {
        {"another length", [&] { scratch.put("f", "123456"); }},
        {"gone", [&] { std::filesystem::remove(scratch / "f"); }},
        {"one that was missing is there", [&] { scratch.put("to come", ""); }},
        {"another file of that name",
         [&] {
             scratch.put("g", "12345");
             std::filesystem::rename(scratch / "g", scratch / "f");
         }},
    };
    for (const auto& c : cases) {
        std::filesystem::remove(scratch / "to come");
        remake();
        ASSERT_TRUE(read_file(scratch / "f")) << c.what;
        const FileStamps stamps = read();
        ASSERT_FALSE(have_changed(stamps)) << c.what;
        c.change();
        EXPECT_TRUE(have_changed(stamps)) << c.what;
    }
}

TEST(FileWriter, writes_pieces_small_and_large_in_order) {
    const Scratch scratch;
    std::string all;
    auto writer = FileWriter::create(scratch / "out");
    ASSERT_TRUE(writer);
    for (std::size_t i = 0; i < 300; ++i) {
        const std::string piece(i * i * 11 % 700'000, static_cast<char>('a' + i % 26));
        writer->write(piece);
        all += piece;
    }
    ASSERT_TRUE(writer->finish());
    EXPECT_TRUE(scratch.get("out") == all);
}

TEST(FileWriter, leaves_nothing_when_it_is_not_finished) {
    const Scratch scratch;
    {
        auto writer = FileWriter::create(scratch / "out");
        ASSERT_TRUE(writer);
        writer->write("half");
    }
    EXPECT_EQ(scratch.entries(), 0u);
}

TEST(FileWriter, reports_a_full_disk_as_the_systems_fault) {
    const FileResult<void> result = write_file("/dev/full", "text");
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().fault, FileFault::system);
    EXPECT_NE(result.error().text().find("No space left"), std::string::npos) << result.error().text();
    EXPECT_TRUE(std::filesystem::exists("/dev/full"));
}

TEST(FileWriter, removes_a_file_that_grew_beyond_what_the_system_allows) {
    const Scratch scratch;
    const FileResult<void> result = [&] {
        const test::FileSizeLimit limit(100'000);
        return write_file(scratch / "out", std::string(200'000, 'x'));
    }();
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().fault, FileFault::system);
    EXPECT_NE(result.error().text().find("ulimit"), std::string::npos) << result.error().text();
    EXPECT_EQ(scratch.entries(), 0u);
}

TEST(FileWriter, cannot_write_where_there_is_no_folder) {
    const Scratch scratch;
    const FileResult<void> result = write_file(scratch / "no/out", "x");
    ASSERT_FALSE(result);
    EXPECT_NE(result.error().text().find("cannot write"), std::string::npos);
}

}  // namespace
}  // namespace tribo::files
