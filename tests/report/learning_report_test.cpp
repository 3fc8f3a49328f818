// SPDX-License-Identifier: MIT
#include "report/learning_report.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace tribo::report {
namespace {

struct Page {
    material::Material material;
    noise::Learned learned;
    std::vector<ReportedVoice> voices;
    std::string html() const { return learning_report(material, learned, voices); }
};

Page page() {
    Page p;
    p.material.name = "cork & <felt>";
    p.material.note = "synthetic \"note\"";
    p.material.method = "yule-walker";
    p.material.highpass_hz = 50;
    ReportedVoice v;
    v.recording = "a<b>.wav";
    v.model.speed_mm_per_s = 120;
    v.model.force_n = 0.5;
    v.model.level_db = -31.25;
    noise::VoiceQuality& q = v.quality;
    q.sample_rate_hz = 8000;
    q.held_out_db = 1.234;
    q.held_out_plain_db = 1.5;
    q.level_error_db = -0.07;
    q.kurtosis = {48.6, 3.0, 41.2};
    q.deviation_db = {7.61, 0.92, 7.43};
    for (int n = 1; n <= 40; ++n) {
        q.hz.push_back(100.0 * n);
        q.original_db.push_back(-40 - n);
        q.model_db.push_back(-41 - n);
    }
    q.modulation = {{10, 20, 40, 80}, {-3, -6, -9, -12}, {-20, -20, -20, -20}, {-4, -7, -10, -13}};
    q.original.assign(800, 0.25f);
    q.gaussian.assign(400, -0.25f);
    q.voice.assign(200, 0.5f);
    p.material.voices.models.push_back(v.model);
    p.voices.push_back(v);
    p.learned.order = 32;
    p.learned.held_out_db = {-10, -12, -12.5, -12.6};
    return p;
}

std::size_t count(const std::string& text, std::string_view what) {
    std::size_t n = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
    return n;
}

TEST(LearningReport, shows_each_figure_plot_and_sound) {
    const std::string html = page().html();
    for (const char* figure :
         {"48.6", "41.2", "7.61", "7.43", "1.23", "1.50", "-0.07", "120 mm/s", "0.5 N"}) {
        EXPECT_GE(count(html, figure), 1u) << figure;
    }
    EXPECT_EQ(count(html, "<svg"), 3u);  // order, spectrum, modulation
    EXPECT_EQ(count(html, "<polyline"), 1u + 2u + 3u);
    EXPECT_EQ(count(html, "<audio"), 3u);
    EXPECT_EQ(count(html, "NaN") + count(html, "nan\"") + count(html, "inf"), 0u);
    // The sounds themselves: 16 bits, so 44 bytes and two each, in base64.
    for (const std::size_t frames : {800u, 400u, 200u}) {
        const std::size_t bytes = 44 + 2 * frames, coded = (bytes + 2) / 3 * 4;
        bool found = false;
        for (std::size_t at = html.find("base64,"); at != std::string::npos;
             at = html.find("base64,", at + 1)) {
            found = found || html.find('"', at) - (at + 7) == coded;
        }
        EXPECT_TRUE(found) << frames;
    }
}

TEST(LearningReport, keeps_names_from_being_markup_and_fetches_nothing) {
    const std::string html = page().html();
    EXPECT_EQ(count(html, "<felt>") + count(html, "a<b>"), 0u);
    EXPECT_GE(count(html, "cork &amp; &lt;felt&gt;"), 1u);
    EXPECT_EQ(count(html, "http://") + count(html, "https://") + count(html, "@import"), 0u);
}

TEST(LearningReport, of_a_material_without_voices_or_orders_is_still_a_page) {
    Page p = page();
    p.voices.clear();
    p.learned.held_out_db.clear();
    const std::string html = p.html();
    EXPECT_EQ(count(html, "<svg"), 0u);
    EXPECT_TRUE(html.ends_with("</body></html>\n"));
    // Levels that are all the same cannot be drawn, and that is said.
    p = page();
    p.voices[0].quality.original_db.assign(40, -300);
    p.voices[0].quality.model_db.assign(40, -300);
    EXPECT_EQ(count(p.html(), "Nothing to draw"), 1u);
}

}  // namespace
}  // namespace tribo::report
