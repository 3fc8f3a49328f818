// SPDX-License-Identifier: MIT
// The pages about job files and results say what the readers and writers do.
#include <cmath>
#include <cstdio>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>

#include "job/memory_source.hpp"
#include "job/toml/job_toml.hpp"
#include "milling/engagement/machining.hpp"
#include "milling/tool/materials.hpp"
#include "places.hpp"
#include "readers/tables/forces_csv.hpp"
#include "report/summary_json.hpp"

namespace tribo::report {
namespace {

std::string page(const char* name) {
    std::ifstream file(std::string(TRIBO_SOURCE_DIR) + "/docs/" + name);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

// The TOML blocks of a page.
std::vector<std::string> blocks(const std::string& text) {
    std::vector<std::string> found;
    for (std::size_t at = 0; (at = text.find("```toml\n", at)) != std::string::npos;) {
        const std::size_t end = text.find("```", at + 8);
        found.push_back(text.substr(at + 8, end - at - 8));
        at = end + 3;
    }
    return found;
}

TEST(Docs, job_page_shows_a_job_that_is_read) {
    const std::vector<std::string> shown = blocks(page("job.md"));
    ASSERT_EQ(shown.size(), 9u);
    const auto job = job::parse_job(shown[0], "job.md", job::MemorySource());
    ASSERT_TRUE(job) << job.error().text();
    EXPECT_EQ(job->cutters.size(), 2u);
    EXPECT_EQ(job->fixtures.size(), 1u);
    EXPECT_EQ(job->cutters[1].holder.size(), 2u);
    const std::string least =
        "[stock]\nbox_mm = [[0,0,0],[1,1,1]]\n[cutter]\nkind = \"ball\"\ndiameter_mm = 1\n[path]\napt = "
        "\"a\"\n[material]\nname = \"al6082-t6\"\n";
    const auto other =
        job::parse_job(least.substr(0, least.find("[material]")) + shown[1], "job.md", job::MemorySource());
    ASSERT_TRUE(other) << other.error().text();
    EXPECT_TRUE(other->engagement.has_value());
    EXPECT_TRUE(other->material.coefficients.has_value());
    EXPECT_EQ(other->material.spread, 0.2);
    const auto bends = job::parse_job(least + shown[2], "job.md", job::MemorySource());
    ASSERT_TRUE(bends) << bends.error().text();
    ASSERT_EQ(bends->modes.size(), 1u);
    EXPECT_EQ(bends->modes[0].stiffness_n_per_mm, 1340.05);
    EXPECT_EQ(bends->modes[0].spread.stiffness, 0.1);
    const auto tapped = job::parse_job(least + shown[3], "job.md", job::MemorySource());
    ASSERT_TRUE(tapped) << tapped.error().text();
    ASSERT_EQ(tapped->frfs.size(), 1u);
    EXPECT_EQ(tapped->frfs[0].unit->name, "g/N");
    std::string sticks_out = least;
    sticks_out.insert(least.find("[path]"), "stickout_mm = 50\n");
    const auto estimated = job::parse_job(sticks_out + shown[4], "job.md", job::MemorySource());
    ASSERT_TRUE(estimated) << estimated.error().text();
    EXPECT_TRUE(estimated->estimate.has_value());
    const auto limited = job::parse_job(least + shown[5], "job.md", job::MemorySource());
    ASSERT_TRUE(limited) << limited.error().text();
    EXPECT_EQ(limited->limits.force_n, 400);
    const auto felt = job::parse_job(least + shown[6], "job.md", job::MemorySource());
    ASSERT_TRUE(felt) << felt.error().text();
    EXPECT_EQ(felt->haptics.friction_static, 0.3);
    EXPECT_EQ(felt->haptics.friction_kinetic, 0.2);
    std::string turned = least;
    turned.erase(turned.find("[cutter]"), turned.find("[path]") - turned.find("[cutter]"));
    const auto profiled = job::parse_job(turned + shown[7], "job.md", job::MemorySource());
    ASSERT_TRUE(profiled) << profiled.error().text();
    EXPECT_EQ(profiled->cutters[0].profile.size(), 5u);
    const auto second = job::parse_job(shown[8], "job.md", job::MemorySource());
    ASSERT_TRUE(second) << second.error().text();
    EXPECT_EQ(second->stock_from.value().path, "top.toml");
    EXPECT_EQ(second->setup.value().y, (Vec3{0, -1, 0}));
}

TEST(Docs, job_page_lists_every_material_with_its_numbers) {
    const std::string text = page("job.md");
    for (const milling::WorkpieceMaterial& m : milling::materials()) {
        const std::size_t row = text.find("| `" + m.name + "` |");
        ASSERT_NE(row, std::string::npos) << m.name;
        std::istringstream cells(text.substr(row, text.find('\n', row) - row));
        std::vector<std::string> cell;
        for (std::string c; std::getline(cells, c, '|');) cell.push_back(c);
        ASSERT_GE(cell.size(), 10u);
        const milling::CuttingCoefficients& k = m.coefficients;
        const double values[] = {k.ktc, k.krc, k.kac, k.kte, k.kre, k.kae};
        for (std::size_t i = 0; i < 6; ++i) {
            const double shown = cell[3 + i] == " - " ? 0 : std::stod(cell[3 + i]);
            EXPECT_NEAR(shown, values[i], std::max(0.05, 0.006 * values[i])) << m.name << ", column " << i;
        }
        char band[40];
        std::snprintf(band, sizeof band, " %.2g to %.2g ", m.spread_low, m.spread_high);
        EXPECT_EQ(cell[9], band) << m.name;
    }
}

TEST(Docs, results_page_names_every_column_key_and_kind) {
    const std::string text = page("results.md");
    const auto named = [&](const std::string& name) {
        EXPECT_NE(text.find("`" + name + "`"), std::string::npos) << name;
    };
    std::istringstream header(readers::forces_csv_header(true, true));
    std::string columns;
    std::getline(header, columns);
    std::istringstream names(columns);
    for (std::string column; std::getline(names, column, ',');) named(column);
    Summary all;
    all.tooth_passing_hz = all.gouge_max_mm = all.rest_max_mm = all.scallop_max_mm = 1;
    all.triangles = 1;
    all.chatter.emplace();
    all.largest_displacement_mm = 0;
    all.uncertain_cases = 1;
    all.chatter_probability = 0.5;
    all.as_published = true;
    std::istringstream json(summary_json(all));
    for (std::string line; std::getline(json, line);) {
        if (line.starts_with("  \"")) named(line.substr(3, line.find('"', 3) - 3));
    }
    for (int kind = 0; kind <= static_cast<int>(milling::CollisionKind::holder_in_fixture); ++kind) {
        named(milling::name(static_cast<milling::CollisionKind>(kind)));
    }
}

}  // namespace
}  // namespace tribo::report
