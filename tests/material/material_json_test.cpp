// SPDX-License-Identifier: MIT
#include "material/material_json.hpp"

#include <gtest/gtest.h>
#include <string>

#include "files/scratch.hpp"

namespace tribo::material {
namespace {

using material::Material;

Material sponge() {
    Material m;
    m.name = "sponge";
    m.note = "made up";
    m.stiffness_n_per_mm = 1.4;
    m.viscosity_n_s_per_mm = 0.1;
    m.width_mm = 80;
    m.image = "sponge.png";
    m.height_map = "sponge-heights.png";
    m.relief_slope = 0.35;
    m.gloss = 0.02;
    m.roughness = 0.9;
    m.pile = 0.4;
    m.method = "burg";
    m.highpass_hz = 50;
    m.voices.models = {{30, 0.5, -41.25, {44100, {-0.9, 0.3, 1.0 / 3}}},
                       {100, 0.5, -30, {48000, {0.1}}},
                       {30, 1, -38, {44100, {}}}};
    m.voices.law = {-31, 14, 9};
    noise::TextureModel t;
    t.crossovers_hz = {400};
    t.levels_db = {std::vector<double>(17, -3.5), std::vector<double>(17, 1)};
    t.coherence = 0.75;
    t.lengths_mm = {0.5, 4};
    t.weights = {0.25, 0.75};
    t.grains = {0.8, 0.3, 0.9, {-2, 0.5, 3}, {0.6, 0.8}};
    m.voices.models[1].texture = t;
    m.sources = {
        {{"slow.wav", 4.5, 44100, 2, 24, -3.5, 0.1, 0}, {"again.flac", 2, 44100, 1, 16, -1, 0, 0.001}},
        {{"fast.wav", 3, 48000, 1, 0, -6, 0, 0}},
        {}};
    return m;
}

std::string with(const std::string& from, const std::string& to) {
    std::string text = material_json(sponge());
    const std::size_t at = text.find(from);
    EXPECT_NE(at, text.npos) << from;
    return text.replace(at, from.size(), to);
}

TEST(MaterialJson, is_read_back_as_it_was) {
    const auto read = parse_material(material_json(sponge()), "sponge.json");
    ASSERT_TRUE(read) << read.error().text();
    EXPECT_EQ(*read, sponge());
    const Material plain;
    EXPECT_EQ(parse_material(material_json(plain), "m").value(), plain);
}

// What a person may write by hand for an image alone.
TEST(MaterialJson, needs_no_more_than_schema_stiffness_and_viscosity) {
    const auto read = parse_material(
        R"({"schema": "tribo.material/1", "stiffness_n_per_mm": 7, "viscosity_n_s_per_mm": 0})", "m.json");
    ASSERT_TRUE(read) << read.error().text();
    EXPECT_EQ(read->stiffness_n_per_mm, 7);
    EXPECT_TRUE(read->voices.models.empty());
}

TEST(MaterialJson, is_refused_with_path_and_remedy_where_it_is_wrong) {
    const struct {
        std::string text, cause;
    } cases[] = {
        {"", "the text ends too early"},
        {"{\"schema\": ", "the text ends too early"},
        {"[1, 2]", "is array and not an object"},
        {"{\"schema\": tribo}", "is not JSON here"},
        {with("tribo.material/1", "tribo.material/9"), "schema is 'tribo.material/9'"},
        {with("\"name\"", "\"nmae\""), "nmae is no known key"},
        {with("\"stiffness_n_per_mm\": 1.4", "\"stiffness_n_per_mm\": 0"), "stiffness_n_per_mm is 0"},
        {with("\"stiffness_n_per_mm\": 1.4", "\"stiffness_n_per_mm\": \"1.4\""),
         "stiffness_n_per_mm is string and not a number"},
        {with("\"viscosity_n_s_per_mm\": 0.1,", ""), "viscosity_n_s_per_mm is missing"},
        {with("\"width_mm\": 80", "\"width_mm\": 1e400"), "number overflow"},
        {with("\"image\": \"sponge.png\"", "\"image\": 5"), "image is number and not a text"},
        {with("\"image\": \"sponge.png\",", ""), "height_map is given without an image"},
        {with("\"height_map\": \"sponge-heights.png\"", "\"height_map\": [1]"),
         "height_map is array and not a text"},
        {with("\"relief_slope\": 0.35", "\"relief_slope\": 1.5"), "relief_slope is 1.5"},
        {with("\"relief_slope\": 0.35", "\"relief_slope\": \"steep\""),
         "relief_slope is string and not a number"},
        {with("\"gloss\": 0.02", "\"gloss\": -0.1"), "gloss is -0.1"},
        {with("\"gloss\": 0.02", "\"gloss\": NaN"), "is not JSON here"},
        {with("\"gloss\": 0.02", "\"gloss\": null"), "gloss is null and not a number"},
        {with("\"roughness\": 0.9", "\"roughness\": 0"), "roughness is 0"},
        {with("\"speed_mm_per_s\": 30", "\"speed_mm_per_s\": -30"), "voices[0].speed_mm_per_s is -30"},
        {with("\"speed_mm_per_s\": 100", "\"speed_mm_per_s\": 10"), "voices[1].speed_mm_per_s does not rise"},
        {with("-0.9, 0.3", "-1.0, 0.3"), "voices[0].reflection[0] is -1"},
        {with("[-0.9, 0.3", "[null, 0.3"), "voices[0].reflection[0] is null and not a number"},
        {with("\"line_spectrum_hz\": [", "\"line_spectrum_hz\": [1, "),
         "voices[0].line_spectrum_hz is not one"},
        {with("\"seconds\": 4.5", "\"seconds\": [4.5]"), "voices[0].recordings[0].seconds is array"},
        {with("\"name\": \"sponge\"", "\"name\": \"sponge\", \"name\": \"twice\""), "'name' stands twice"},
        {with("\"weights\": [0.25, 0.75]", "\"weights\": [0.25, 0.5]"),
         "voices[1].texture.weights is not one"},
        {with("\"crossovers_hz\": [400.0]", "\"crossovers_hz\": []"),
         "voices[1].texture.levels_db does not fit"},
        {with("[-2.0, 0.5, 3.0]", "[2.0, 0.5, 3.0]"), "voices[1].texture.grains.sizes does not rise"},
        {with("\"levels_db\": [[", "\"levels_db\": [[true, "),
         "voices[1].texture.levels_db[0][0] is boolean"},
        {std::string(100, '[') + std::string(100, ']'), "is nested too deeply"},
        {"\xff\xfe{", "is not JSON here"},
    };
    for (const auto& c : cases) {
        const auto read = parse_material(c.text, "m.json");
        ASSERT_FALSE(read) << c.cause;
        EXPECT_NE(read.error().cause.find(c.cause), std::string::npos) << read.error().text();
        EXPECT_FALSE(read.error().remedy.empty()) << c.cause;
        EXPECT_EQ(read.error().file, "m.json");
    }
}

TEST(MaterialJson, tells_line_and_column_of_what_is_no_json) {
    const auto read =
        parse_material("{\n  \"schema\": \"tribo.material/1\",\n  \"name\": oops\n}\n", "m.json");
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().line, 3);
    EXPECT_EQ(read.error().column, 11);
}

TEST(MaterialJson, is_read_from_a_file) {
    const test::Scratch folder;
    ASSERT_TRUE(files::write_file(folder / "m.json", material_json(sponge())));
    EXPECT_EQ(read_material(folder / "m.json").value(), sponge());
    EXPECT_FALSE(read_material(folder / "none.json"));
}

}  // namespace
}  // namespace tribo::material
