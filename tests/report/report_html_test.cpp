// SPDX-License-Identifier: MIT
#include "report/report_html.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <numeric>
#include <rapidcheck/gtest.h>

namespace tribo::report {
namespace {

using Json = nlohmann::json;

ReportData example() {
    ReportData data;
    data.title = "bowl";
    data.summary.version = "1.2.3";
    data.summary.peak_force_n = {400, 200, 800};
    for (int i = 0; i < 10; ++i) {
        ReportRow row;
        row.t_s = 0.1 * i;
        row.duration_s = 0.1;
        row.line = 5 + i;
        row.tip_mm = {1.0 * i, 2, -3};
        row.peak_n = 100 + i;
        row.peak_low_n = 0.5 * row.peak_n;
        row.peak_high_n = 2 * row.peak_n;
        row.mean_n = 50;
        data.rows.push_back(row);
    }
    data.turn = ReportTurn{0.9, 6000, 14, {{1, 2, 3}, {4, 5, 6}}, {{0, 10}, {200, 5}}};
    data.sound =
        ReportSound{1.0, {{-0.5F, 0.5F}}, {{"loud", 48000, {0.1F, -0.2F}}}, 0, 8000, {0.5F, -0.5F, 1.5F, 0}};
    data.facts = {{"Material", "al7075-t6"}};
    return data;
}

std::string between(const std::string& text, const std::string& open, const std::string& close) {
    const std::size_t from = text.find(open);
    if (from == std::string::npos) return "";
    const std::size_t to = text.find(close, from + open.size());
    return text.substr(from + open.size(), to - from - open.size());
}

Json embedded(const std::string& html) {
    return Json::parse(between(html, "id=\"data\">", "</script>"));
}

TEST(Report, carries_the_data_of_its_plots) {
    const Json json = embedded(report_html(example()));
    EXPECT_EQ(json["schema"], "tribo.report/1");
    EXPECT_EQ(json["rows"]["low"][0], 50);
    EXPECT_EQ(json["rows"]["high"][9], 218);
    EXPECT_EQ(json["rows"]["line"], Json::parse("[5,6,7,8,9,10,11,12,13,14]"));
    EXPECT_EQ(json["rows"]["peak"][9], 109);
    EXPECT_EQ(json["rows"]["z"][0], -3);
    EXPECT_EQ(json["turn"]["y"], Json::parse("[2,5]"));
    EXPECT_EQ(json["turn"]["hz"], Json::parse("[0,200]"));
    EXPECT_EQ(json["envelope"]["high"], Json::parse("[0.5]"));
    EXPECT_EQ(json["waves"][0]["label"], "loud");
}

TEST(Report, names_the_lines_with_the_largest_forces_each_once) {
    std::vector<ReportRow> rows;
    for (int n = 0; n < 60; ++n) {
        ReportRow row;
        row.line = n % 15;  // 0: of no line
        row.t_s = n;
        row.peak_n = 7 * n % 60;
        rows.push_back(row);
    }
    const std::vector<ReportRow> worst = worst_lines(rows);
    ASSERT_EQ(worst.size(), kWorstLines);
    std::vector<int> lines;
    for (const ReportRow& row : worst) {
        lines.push_back(row.line);
        for (const ReportRow& other : rows) EXPECT_TRUE(other.line != row.line || other.peak_n <= row.peak_n);
    }
    EXPECT_TRUE(std::ranges::is_sorted(worst, std::greater(), &ReportRow::peak_n));
    std::ranges::sort(lines);
    EXPECT_EQ(std::ranges::adjacent_find(lines), lines.end());
    EXPECT_GT(lines.front(), 0);
    EXPECT_TRUE(worst_lines({}).empty());
}

TEST(Report, has_a_set_up_sheet_and_no_length_below_a_micrometre) {
    ReportData data = example();
    data.worst = worst_lines(data.rows);
    data.sheet = {{"Set-up <sheet>", "", {"File", "SHA-256"}, {{"a.toml", "ba78"}}}};
    data.summary.gouge_max_mm = 0.000012;
    data.summary.scallop_max_mm = 0.0021244;
    data.summary.rest_max_mm = 0.2786;
    data.summary.peak_power_w = {1234.6, 1234.6, 1234.6};
    const std::string html = report_html(data);
    EXPECT_NE(html.find("<h2>Set-up &lt;sheet&gt;</h2>"), std::string::npos);
    EXPECT_NE(html.find("<td>ba78</td>"), std::string::npos);
    EXPECT_NE(html.find("<td>14</td><td>0.9</td><td>9, 2, -3</td><td>109</td><td>54.5 to 218</td>"),
              std::string::npos);
    for (const char* shown :
         {"<b>&lt; 0.001 <small>mm", "<b>0.002 <small>mm", "<b>0.279 <small>mm", "<b>1230 <small>W"})
        EXPECT_NE(html.find(shown), std::string::npos) << shown;
}

TEST(Report, shows_chatter_where_the_job_says_what_bends) {
    ReportData data = example();
    const std::string rigid = report_html(data);
    EXPECT_EQ(rigid.find("chatter-plot\""), std::string::npos);
    EXPECT_FALSE(embedded(rigid)["rows"].contains("mu"));
    data.chatter = ReportChatter{
        "Turn <slower>.", "<?xml?>\n<svg width=\"9\"></svg>", "line 5", 16000, {{0.5F, -0.25F}}};
    data.rows[3].multiplier = 1.25;
    data.rows[3].displacement_mm = 0.125;
    data.summary.chatter.emplace();
    data.summary.largest_displacement_mm = 0.125;
    const std::string html = report_html(data);
    EXPECT_NE(html.find("Turn &lt;slower&gt;."), std::string::npos);
    EXPECT_NE(html.find("<figure class=\"chart\"><svg width=\"9\"></svg>"), std::string::npos);
    EXPECT_NE(html.find("moves by 0.125 mm at most"), std::string::npos);
    const Json json = embedded(html);
    EXPECT_EQ(json["rows"]["mu"][3], 1.25);
    EXPECT_EQ(json["rows"]["mu"][2], 0);
    EXPECT_EQ(json["rows"]["move"][3], 0.125);
    EXPECT_EQ(json["vibration"]["x"], Json::parse("[0.5]"));
    EXPECT_EQ(json["vibration"]["y"], Json::parse("[-0.25]"));
    EXPECT_EQ(json["vibration"]["rate"], 16000);
    data.summary.chatter->resize(1);
    EXPECT_NE(report_html(data).find("<b>1 <small>line</small></b>"), std::string::npos);
    // A place without a chart and without a vibration is a sentence.
    data.chatter = ReportChatter{"None.", "", "", 48000, {}};
    EXPECT_FALSE(embedded(report_html(data)).contains("vibration"));
}

TEST(Report, is_one_file_that_needs_no_other) {
    const std::string html = report_html(example());
    for (const char* outside : {"http:", "https:", "<link", "src=\"/", "@import", "{{"}) {
        EXPECT_EQ(html.find(outside), std::string::npos) << outside;
    }
    EXPECT_TRUE(html.starts_with("<!doctype html>"));
    EXPECT_NE(html.find("<title>bowl - Tribo report</title>"), std::string::npos);
    EXPECT_NE(html.find("400 <small>N</small></b><span class=\"band\">200 to 800"), std::string::npos);
}

TEST(Report, shows_the_part_in_3d_over_its_picture) {
    ReportData data = example();
    EXPECT_EQ(report_html(data).find("webgl2"), std::string::npos);
    data.picture_png = "png";
    data.part.emplace();
    data.part->mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    data.part->mesh.triangles = {{0, 1, 2}};
    data.part->untouched = {0, 1, 0};
    const std::string html = report_html(data);
    EXPECT_EQ(embedded(html)["part"]["triangles"], 1);
    EXPECT_EQ(between(html, "id=\"part\">", "</script>").size(), 36u);  // 27 bytes in base64
    EXPECT_NE(html.find("webgl2"), std::string::npos);
    EXPECT_NE(html.find("aria-roledescription=\"3D view\""), std::string::npos);
    for (const char* outside : {"http:", "https:", "<link", "src=\"/", "@import", "{{"})
        EXPECT_EQ(html.find(outside), std::string::npos) << outside;
}

TEST(Report, without_cut_turn_or_sound_is_still_a_page) {
    ReportData data;
    data.title = "empty";
    const std::string html = report_html(data);
    const Json json = embedded(html);
    EXPECT_TRUE(json["rows"]["t"].empty());
    EXPECT_FALSE(json.contains("turn"));
    EXPECT_FALSE(json.contains("envelope"));
    EXPECT_EQ(html.find("<audio"), std::string::npos);
    EXPECT_EQ(html.find("<img"), std::string::npos);
}

TEST(Report, shows_text_and_never_runs_it) {
    const std::string evil = "</script><script>alert(1)</script>{{style}}";
    ReportData data = example();
    data.title = data.subtitle = evil;
    data.facts = {{evil, evil}};
    data.summary.warnings = {{"f", 1, evil}};
    data.summary.collisions = {{1, 0, evil, {}}};
    data.sound->waves[0].label = evil;
    const std::string html = report_html(data);
    EXPECT_EQ(html.find("<script>alert"), std::string::npos);
    EXPECT_EQ(embedded(html)["waves"][0]["label"], evil);
    EXPECT_NE(html.find("&lt;/script&gt;&lt;script&gt;alert(1)&lt;/script&gt;{{style}}</h1>"),
              std::string::npos);
}

TEST(Report, plays_the_sound_as_a_wav_file_of_16_bits) {
    const std::string html = report_html(example());
    const std::string coded = between(html, "data:audio/wav;base64,", "\"");
    std::string bytes;
    std::uint32_t bits = 0;
    int held = 0;
    for (const char c : coded) {
        const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        const std::size_t value = letters.find(c);
        if (value == std::string::npos) break;
        bits = bits << 6 | static_cast<std::uint32_t>(value);
        held += 6;
        if (held >= 8) bytes += static_cast<char>(bits >> (held -= 8) & 0xFF);
    }
    const auto word = [&](std::size_t at, int count) {
        std::uint32_t value = 0;
        for (int i = count; i-- > 0;) {
            value = value << 8 | static_cast<unsigned char>(bytes[at + static_cast<std::size_t>(i)]);
        }
        return value;
    };
    ASSERT_EQ(bytes.size(), 44u + 8u);
    EXPECT_EQ(bytes.substr(0, 4) + bytes.substr(8, 8), "RIFFWAVEfmt ");
    EXPECT_EQ(word(4, 4), bytes.size() - 8);
    EXPECT_EQ(word(24, 4), 8000u);
    EXPECT_EQ(word(28, 4), 32000u);
    EXPECT_EQ(word(40, 4), 8u);
    EXPECT_EQ(static_cast<std::int16_t>(word(44, 2)), 16384);
    EXPECT_EQ(static_cast<std::int16_t>(word(46, 2)), -16384);
    EXPECT_EQ(static_cast<std::int16_t>(word(48, 2)), 32767);  // clipped, not wrapped
}

RC_GTEST_PROP(ThinnedRows, keep_the_time_the_largest_force_and_the_mean, ()) {
    std::vector<ReportRow> rows;
    double t = 0;
    const int count = *rc::gen::inRange(1, 400);
    for (int i = 0; i < count; ++i) {
        if (*rc::gen::inRange(0, 10) == 0) t += 5;  // a gap
        ReportRow row;
        row.t_s = t;
        row.duration_s = *rc::gen::inRange(1, 10) / 10.0;
        row.peak_n = *rc::gen::inRange(0, 1000);
        row.mean_n = *rc::gen::inRange(0, 1000);
        row.line = i;
        t += row.duration_s;
        rows.push_back(row);
    }
    const auto thin = thin_rows(rows, 100);
    const auto sum = [](const std::vector<ReportRow>& of, auto value) {
        return std::accumulate(of.begin(), of.end(), 0.0,
                               [&](double s, const ReportRow& r) { return s + value(r); });
    };
    const auto peak = [](const std::vector<ReportRow>& of) {
        return std::max_element(of.begin(), of.end(), [](auto& a, auto& b) { return a.peak_n < b.peak_n; })
            ->peak_n;
    };
    RC_ASSERT((rows.size() <= 100 ? thin.size() == rows.size() : thin.size() < rows.size()));
    RC_ASSERT(peak(thin) == peak(rows));
    const auto impulse = [](const ReportRow& r) { return r.mean_n * r.duration_s; };
    RC_ASSERT(std::abs(sum(thin, impulse) - sum(rows, impulse)) <= 1e-6 * (1 + sum(rows, impulse)));
    for (std::size_t i = 1; i < thin.size(); ++i) {
        RC_ASSERT(thin[i].t_s >= thin[i - 1].t_s + thin[i - 1].duration_s - 1e-9);
    }
    for (const ReportRow& row : thin) {  // the line shown is that of the force shown
        RC_ASSERT(rows[static_cast<std::size_t>(row.line)].peak_n == row.peak_n);
    }
}

}  // namespace
}  // namespace tribo::report
