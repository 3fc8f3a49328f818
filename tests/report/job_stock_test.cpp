// SPDX-License-Identifier: MIT
// [stock] from and [setup], and the record in summary.json that a folder is known by.
#include <cmath>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "files/json/stock_record_json.hpp"
#include "files/scratch.hpp"
#include "job/memory_source.hpp"
#include "job/toml/job_toml.hpp"
#include "report/summary_json.hpp"

namespace tribo::report {
namespace {

using job::Job;
using motion::WorkFrame;
using test::Scratch;

// [stock] from line 1 on, then a job's rest.
std::string job_text(const std::string& head) {
    return head +
           "[cutter]\nkind = \"flat\"\ndiameter_mm = 6\n[material]\nname = \"al7075-t6\"\n"
           "[path]\ngcode = \"b.nc\"\n";
}

FileResult<Job> job_of(const std::string& head) {
    return job::parse_job(job_text(head), "jobs/b.toml", job::MemorySource());
}

TEST(JobStockKeys, name_the_earlier_job_beside_this_one) {
    const auto job = job_of("[stock]\nfrom = \"first/a.toml\"\n");
    ASSERT_TRUE(job) << job.error().text();
    EXPECT_EQ(job->stock_from.value().path, "jobs/first/a.toml");
    EXPECT_EQ(job->stock_from->line, 2);
    EXPECT_EQ(job->stock_from->column, 8);
    EXPECT_FALSE(job->setup);
    EXPECT_EQ(job_of("[stock]\nfrom = \"/out\"\n")->stock_from->path, "/out");
}

TEST(JobStockKeys, give_the_frame_of_the_set_up) {
    const auto job = job_of(
        "[stock]\nfrom = \"a.toml\"\n[setup]\norigin_mm = [1, 2, 3]\nx_axis = [0, 5, 0]\nz_axis = [0, 0, "
        "-0.1]\n");
    ASSERT_TRUE(job) << job.error().text();
    const motion::WorkFrame& frame = job->setup.value();
    EXPECT_EQ(frame.origin_mm, (Vec3{1, 2, 3}));
    EXPECT_EQ(frame.x, (Vec3{0, 1, 0}));
    EXPECT_EQ(frame.y, (Vec3{1, 0, 0}));
    EXPECT_EQ(frame.z, (Vec3{0, 0, -1}));
    // Each key may be left out: the earlier job's own zero, x and z.
    const auto bare = job_of("[stock]\nfrom = \"a.toml\"\n[setup]\n");
    ASSERT_TRUE(bare) << bare.error().text();
    EXPECT_EQ(bare->setup->origin_mm, (Vec3{}));
    EXPECT_EQ(bare->setup->y, (Vec3{0, 1, 0}));
    EXPECT_EQ(job_of("[stock]\nfrom = \"a.toml\"\n[setup]\nz_axis = [0, 0, -1]\n")->setup->y,
              (Vec3{0, -1, 0}));
}

RC_GTEST_PROP(JobStockKeys, make_a_right_handed_frame_of_unit_axes, ()) {
    const auto part = [] { return 1e-3 * *rc::gen::inRange(-1'000'000, 1'000'000); };
    const Vec3 z{part(), part(), part()}, other{part(), part(), part()};
    RC_PRE(length(cross(z, other)) > 1e-2 * length(z) * length(other) && length(z) > 1);
    const Vec3 square = 7.0 / length(cross(z, other)) * cross(z, other);
    const auto text = [](Vec3 v) {
        char line[120];  // six digits: as somebody writes a direction
        std::snprintf(line, sizeof line, "[%.6f, %.6f, %.6f]\n", v.x, v.y, v.z);
        return std::string(line);
    };
    const auto job =
        job_of("[stock]\nfrom = \"a.toml\"\n[setup]\nx_axis = " + text(square) + "z_axis = " + text(z));
    RC_ASSERT(job.has_value());
    const motion::WorkFrame& f = job->setup.value();
    for (const Vec3 axis : {f.x, f.y, f.z}) RC_ASSERT(std::abs(length(axis) - 1) < 1e-15);
    RC_ASSERT(std::abs(dot(f.x, f.z)) < 1e-15);
    RC_ASSERT(distance(cross(f.x, f.y), f.z) < 1e-15);
    RC_ASSERT(distance(f.z, normalized(z)) < 1e-5);
    const Vec3 p{part(), part(), part()};
    RC_ASSERT(distance(f.in_stock(f.from_stock(p)), p) < 1e-11);
}

struct BadHead {
    const char* head;
    int line;
    const char* fragment;
};

class BadHeads : public testing::TestWithParam<BadHead> {};

TEST_P(BadHeads, are_refused_with_place_cause_and_remedy) {
    const BadHead& bad = GetParam();
    const auto job = job_of(bad.head);
    ASSERT_FALSE(job);
    EXPECT_EQ(job.error().fault, FileFault::input);
    EXPECT_EQ(job.error().line, bad.line) << job.error().text();
    EXPECT_NE(job.error().text().find(bad.fragment), std::string::npos) << job.error().text();
    EXPECT_FALSE(job.error().remedy.empty());
}

#define FROM "[stock]\nfrom = \"a.toml\"\n"
INSTANTIATE_TEST_SUITE_P(
    JobStockKeys, BadHeads,
    testing::Values(
        BadHead{FROM "box_mm = [[0,0,0],[1,1,1]]\n", 3, "has both 'from' and 'box_mm'; keep one of them"},
        BadHead{FROM "mesh = \"m.stl\"\n", 3, "has both 'from' and 'mesh'"},
        BadHead{FROM "unit_mm = 25.4\n", 3, "remove it: the earlier job is in mm"},
        BadHead{"[stock]\nfrom = \"\"\n", 2, "'from' is empty"},
        BadHead{"[stock]\nfrom = 3\n", 2, "'from' must be a string, not a number"},
        BadHead{"[stock]\nfrom = [\"a.toml\"]\n", 2, "'from' must be a string, not an array"},
        BadHead{"[stock]\nfrom = \"a\\u0000b\"\n", 2, "zero byte"},
        BadHead{"[stock]\nform = \"a.toml\"\n", 2, "unknown key 'form' in [stock]; try 'from'"},
        BadHead{"[stock]\n", 1, "or from = \"FIRST.toml\" for the stock that another job leaves"},
        BadHead{"[[fixture]]\nfrom = \"a.toml\"\n[stock]\nbox_mm = [[0,0,0],[1,1,1]]\n", 2,
                "unknown key 'from' in [[fixture]]"},
        BadHead{"[stock]\nbox_mm = [[0,0,0],[1,1,1]]\n[setup]\norigin_mm = [0,0,0]\n", 3,
                "[setup] belongs to a stock that an earlier job leaves"},
        BadHead{"[setup]\n", 1, "[setup] belongs to a stock"},
        BadHead{FROM "[setup]\norigin = [0,0,0]\n", 4, "unknown key 'origin' in [setup]; try 'origin_mm'"},
        BadHead{FROM "[setup]\ny_axis = [0,1,0]\n", 4, "unknown key 'y_axis' in [setup]"},
        BadHead{FROM "[setup]\norigin_mm = 3\n", 4, "must be three numbers"},
        BadHead{FROM "[setup]\norigin_mm = [0, 0]\n", 4, "must be three numbers"},
        BadHead{FROM "[setup]\norigin_mm = [0, 0, nan]\n", 4, "not a finite number"},
        BadHead{FROM "[setup]\norigin_mm = [0, 2e6, 0]\n", 4, "'origin_mm' is 2000000"},
        BadHead{FROM "[setup]\nx_axis = \"x\"\n", 4, "must be three numbers"},
        BadHead{FROM "[setup]\nx_axis = [0, 0, 0]\n", 4, "'x_axis' is no direction: its length is 0"},
        BadHead{FROM "[setup]\nz_axis = [1e200, 0, 0]\nx_axis = [0, 1, 0]\n", 4, "'z_axis' is 1e+200"},
        BadHead{FROM "[setup]\nz_axis = [1e-200, 0, 0]\nx_axis = [0, 1, 0]\n", 4, "'z_axis' is no direction"},
        BadHead{FROM "[setup]\nx_axis = [0, 0, 1]\n", 4, "'x_axis' is not square to 'z_axis'"},
        BadHead{FROM "[setup]\nx_axis = [1, 0, 0.01]\n", 4, "'x_axis' is not square to 'z_axis'"},
        BadHead{FROM "[setup]\nx_axis = [0, 0, -2]\nz_axis = [0, 0, 1]\n", 4, "make them square"},
        BadHead{FROM "[setup]\nz_axis = [1, 0, 0]\n", 4, "write 'x_axis' too"},
        BadHead{FROM "[[setup]]\n[[setup]]\n", 3, "there may be only one [setup]"},
        BadHead{"setup = 3\n" FROM, 1, "'setup'"}));

TEST(StockRecord, comes_back_from_the_folder_as_it_was_written) {
    const Scratch scratch;
    report::Summary summary;
    summary.version = "1.2.3";
    job::StockRecord record;
    record.job = "../a.toml";
    record.until_s = 0.1;
    record.stock = 0xfedcba9876543210;
    record.cutters = 1;
    record.moves = ~std::uint64_t{0};
    summary.stock_record = record;
    scratch.put("out/summary.json", report::summary_json(summary));
    const auto read = files::read_stock_record(scratch / "out");
    ASSERT_TRUE(read) << read.error().text();
    EXPECT_EQ(read->version, "1.2.3");
    EXPECT_EQ(read->job, "../a.toml");
    EXPECT_EQ(read->until_s, 0.1);
    EXPECT_EQ(read->stock, record.stock);
    EXPECT_EQ(read->cutters, record.cutters);
    EXPECT_EQ(read->moves, record.moves);
    summary.stock_record->until_s.reset();
    scratch.put("out/summary.json", report::summary_json(summary));
    EXPECT_FALSE(files::read_stock_record(scratch / "out")->until_s);
}

TEST(StockRecord, is_refused_wherever_the_folder_holds_something_else) {
    const Scratch scratch;
    const std::string record =
        R"({"job": "a", "stock": "0123456789abcdef", "cutters": "0123456789abcdef", "moves": "0123456789abcdef"})";
    const auto refusal = [&](const std::string& text) {
        scratch.put("out/summary.json", text);
        const auto read = files::read_stock_record(scratch / "out");
        if (read) return std::string();
        EXPECT_EQ(read.error().fault, FileFault::input);
        return read.error().cause;
    };
    const auto with = [](const std::string& value) {
        return "{\"schema\": \"tribo.summary/1\", \"stock_record\": " + value + "}";
    };
    EXPECT_EQ(refusal(with(record)), "");
    const std::string other = "is no folder that tribo render wrote (no summary.json of its own in it)";
    EXPECT_EQ(files::read_stock_record(scratch / "nowhere").error().cause, other);
    for (const char* text : {"", "{", "[]", "3", "null", "{}", R"({"schema": 3})",
                             R"({"schema": "tribo.material/1"})", "\xff\xfe"}) {
        EXPECT_EQ(refusal(text), other) << text;
    }
    for (const char* text :
         {R"({"schema": "tribo.summary/1"})", R"({"schema": "tribo.summary/1", "stock_record": [1]})"}) {
        EXPECT_NE(refusal(text).find("from a program without a job, or by an early version"),
                  std::string::npos)
            << text;
    }
    const std::pair<const char*, const char*> damages[] = {{"\"a\"", "\"\""},
                                                           {"\"a\"", "7"},
                                                           {"\"a\"", R"("a\u0000b")"},
                                                           {"0123456789abcdef", "0123456789abcde"},
                                                           {"0123456789abcdef", "0123456789abcdeg"},
                                                           {"0123456789abcdef", "-123456789abcdef"},
                                                           {"\"0123456789abcdef\"", "81985529216486895"},
                                                           {"{", R"({"until_s": "1", )"},
                                                           {"{", R"({"until_s": -1, )"},
                                                           {"{", R"({"until_s": null, )"}};
    for (const auto& [what, by] : damages) {
        std::string text = record;
        text.replace(text.find(what), std::string(what).size(), by);
        EXPECT_EQ(refusal(with(text)), "holds a summary.json whose stock_record is damaged") << text;
    }
}

}  // namespace
}  // namespace tribo::report
