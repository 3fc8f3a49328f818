// SPDX-License-Identifier: MIT
// A job's files on the disk; chains of jobs through the program stand in tests/app/job_chain_test.cpp.
#include "files/disk_source.hpp"

#include <filesystem>
#include <gtest/gtest.h>

#include "files/scratch.hpp"
#include "job/toml/job_toml.hpp"

namespace tribo::files {
namespace {

using test::Scratch;

TEST(DiskSource, refuses_a_job_that_is_missing_or_a_folder) {
    const Scratch scratch;
    const DiskSource disk;
    EXPECT_NE(job::read_job(disk, scratch / "no.toml").error().text().find("No such file"),
              std::string::npos);
    EXPECT_NE(job::read_job(disk, scratch.path()).error().text().find("is a folder"), std::string::npos);
}

TEST(DiskSource, gives_one_identity_to_all_names_of_a_file) {
    const Scratch scratch;
    const DiskSource disk;
    scratch.put("jobs/a.toml", "");
    std::filesystem::create_directory_symlink(scratch / "jobs", scratch / "link");
    EXPECT_EQ(disk.identity(scratch / "link/a.toml"), scratch / "jobs/a.toml");
    EXPECT_EQ(disk.identity(scratch / "jobs/../jobs/a.toml"), scratch / "jobs/a.toml");
    // A link to a job is another job: what it names stands elsewhere.
    std::filesystem::create_symlink(scratch / "jobs/a.toml", scratch / "b.toml");
    EXPECT_EQ(disk.identity(scratch / "b.toml"), scratch / "b.toml");
    EXPECT_EQ(relative_to(scratch / "out", scratch / "link/a.toml"), "../jobs/a.toml");
}

TEST(DiskSource, takes_stock_from_jobs_and_from_folders_of_renders) {
    const Scratch scratch;
    const DiskSource disk;
    scratch.put("a.toml", "");
    scratch.put("a.stl", "");
    const std::string record =
        R"({"schema": "tribo.summary/1", "stock_record": {"job": "../a.toml", "stock": "0123456789abcdef", )"
        R"("cutters": "0123456789abcdef", "moves": "0123456789abcdef"}})";
    scratch.put("out/summary.json", record);
    const auto job = disk.stock_source(scratch / "a.toml");
    ASSERT_TRUE(job);
    EXPECT_EQ(job->job, scratch / "a.toml");
    EXPECT_FALSE(job->record);
    const auto render = disk.stock_source(scratch / "out");
    ASSERT_TRUE(render) << render.error().text();
    EXPECT_EQ(render->job, scratch / "a.toml");
    EXPECT_EQ(render->folder, scratch / "out");
    EXPECT_TRUE(render->record);
    const auto refusal = [&](const std::string& name) {
        const auto source = disk.stock_source(scratch / name);
        return source ? "" : source.error().text();
    };
    const std::string name = "name an earlier job (.toml) or the folder of its render";
    EXPECT_EQ(refusal("gone"),
              "error: '" + (scratch / "gone") + "' to take the stock from is not there; " + name);
    EXPECT_EQ(refusal("a.stl"), "error: '" + (scratch / "a.stl") +
                                    "' is no job (.toml) and no folder of a render; " + name +
                                    "; a model of the stock is mesh = \"FILE\"");
    std::filesystem::remove(scratch / "a.toml");
    EXPECT_EQ(refusal("out"), "error: '" + (scratch / "out") + "' was rendered from '" +
                                  (scratch / "a.toml") +
                                  "', which is gone; bring it back, or begin with mesh = \"machined.stl\" of "
                                  "the folder");
}

}  // namespace
}  // namespace tribo::files
