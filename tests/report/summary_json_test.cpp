// SPDX-License-Identifier: MIT
#include "report/summary_json.hpp"

#include <gtest/gtest.h>
#include <limits>
#include <nlohmann/json.hpp>

namespace tribo::report {
namespace {

using Json = nlohmann::ordered_json;

Summary full() {
    Summary s;
    s.job = "bowl.toml";
    s.version = "1.2.3";
    s.duration_s = 10;
    s.cutting_s = 8;
    s.path_mm = 120;
    s.removed_mm3 = 3000;
    s.remaining_mm3 = 247000;
    s.mean_force_n = {100, 50, 200};
    s.peak_force_n = {400, 200, 800};
    s.peak_torque_nm = {2, 1, 4};
    s.peak_power_w = {1000, 500, 2000};
    s.tooth_passing_hz = 200;
    s.triangles = 12345;
    s.resolution_mm = 0.25;
    s.gouge_max_mm = 0.01;
    s.rest_max_mm = 0.5;
    s.rest_at_mm = Vec3{1, 2.5, -3};
    s.scallop_max_mm = 0.127;
    s.collisions = {{12, 3.5, "holder", {1, 2, 3}}};
    s.warnings = {{"p.ngc", 4, "no G20 or G21: millimetres"}};
    s.seconds = 0.7;
    s.peak_memory_mb = 80;
    return s;
}

TEST(SummaryJson, has_every_promised_key_and_begins_with_its_schema) {
    const std::string text = summary_json(full());
    const Json json = Json::parse(text);
    EXPECT_EQ(json.begin().key(), "schema");
    EXPECT_EQ(json["schema"], "tribo.summary/1");
    const std::pair<const char*, double> numbers[] = {
        {"duration_s", 10},        {"cutting_s", 8},          {"path_mm", 120},
        {"removed_mm3", 3000},     {"remaining_mm3", 247000}, {"mean_force_n", 100},
        {"peak_force_n", 400},     {"peak_torque_nm", 2},     {"peak_power_w", 1000},
        {"tooth_passing_hz", 200}, {"triangles", 12345},      {"resolution_mm", 0.25},
        {"gouge_max_mm", 0.01},    {"rest_max_mm", 0.5},      {"scallop_max_mm", 0.127},
        {"seconds", 0.7},          {"peak_memory_mb", 80}};
    for (const auto& [key, value] : numbers) {
        ASSERT_TRUE(json.contains(key)) << key;
        EXPECT_EQ(json[key].get<double>(), value) << key;
    }
    EXPECT_EQ(json["warnings"], Json::parse(R"(["p.ngc:4: warning: no G20 or G21: millimetres"])"));
    EXPECT_EQ(json["collisions"],
              Json::parse(R"([{"line": 12, "t_s": 3.5, "kind": "holder", "tip_mm": [1.0, 2.0, 3.0]}])"));
    EXPECT_TRUE(text.ends_with("}\n"));
}

TEST(SummaryJson, gives_every_force_its_band) {
    const Json json = Json::parse(summary_json(full()));
    EXPECT_EQ(json["peak_force_n_band"], Json::parse("[200.0, 800.0]"));
    EXPECT_EQ(json["mean_force_n_band"], Json::parse("[50.0, 200.0]"));
    EXPECT_EQ(json["peak_torque_nm_band"], Json::parse("[1.0, 4.0]"));
    EXPECT_EQ(json["peak_power_w_band"], Json::parse("[500.0, 2000.0]"));
    EXPECT_FALSE(json.contains("removed_mm3_band"));
    Summary exact = full();
    exact.peak_force_n = {400, 400, 400};
    EXPECT_FALSE(Json::parse(summary_json(exact)).contains("peak_force_n_band"));
}

TEST(SummaryJson, says_of_how_many_cases_a_band_is) {
    EXPECT_FALSE(Json::parse(summary_json(full())).contains("uncertain_cases"));
    Summary of_cases = full();
    of_cases.uncertain_cases = 200;
    of_cases.chatter_probability = 0.25;
    const Json json = Json::parse(summary_json(of_cases));
    EXPECT_EQ(json["uncertain_cases"], 200);
    EXPECT_EQ(json["chatter_probability"], 0.25);
}

TEST(SummaryJson, leaves_out_what_is_absent_or_not_finite_and_never_writes_null) {
    Summary s;
    s.peak_force_n.value = std::numeric_limits<double>::quiet_NaN();
    s.path_mm = std::numeric_limits<double>::infinity();
    const std::string text = summary_json(s);
    const Json json = Json::parse(text);
    for (const char* key : {"peak_force_n", "path_mm", "tooth_passing_hz", "triangles", "gouge_max_mm",
                            "rest_max_mm", "scallop_max_mm", "as_published"}) {
        EXPECT_FALSE(json.contains(key)) << key;
    }
    EXPECT_EQ(text.find("null"), std::string::npos);
    EXPECT_TRUE(json["collisions"].empty());
    EXPECT_TRUE(json["warnings"].empty());
}

TEST(SummaryJson, is_utf8_whatever_a_program_holds) {
    Summary s;
    s.warnings = {{"caf\xE9.ngc", 1, "quote \" backslash \\ newline \n"}};
    const Json json = Json::parse(summary_json(s));
    EXPECT_EQ(json["warnings"][0], "caf\\xe9.ngc:1: warning: quote \" backslash \\ newline \\n");
}

}  // namespace
}  // namespace tribo::report
