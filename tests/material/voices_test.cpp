// SPDX-License-Identifier: MIT
// The sound of every shipped material and of odd ones, as hashes in voices.txt: web/touch/test/voices.test.ts
// holds touch.wasm to the same ones. And what is refused.
#include <array>
#include <cstdio>
#include <filesystem>
#include <gtest/gtest.h>
#include <map>

#include "base/hash.hpp"
#include "files/files.hpp"
#include "files/json/json.hpp"
#include "material/material_json.hpp"
#include "noise/play/friction_voice.hpp"
#include "places.hpp"

namespace tribo::material {
namespace {

const std::string kSource = std::string(TRIBO_SOURCE_DIR) + "/";

// Path by name.
std::map<std::string, std::string> material_files() {
    std::map<std::string, std::string> found;
    for (const char* folder : {"examples/materials", "tests/material/odd"}) {
        for (const auto& entry : std::filesystem::directory_iterator(kSource + folder)) {
            if (entry.path().extension() == ".json")
                found[entry.path().stem().string()] = entry.path().string();
        }
    }
    return found;
}

// Speeds between, below and beyond the recordings', and rest; 50 ms each.
void add_sound(Hash& hash, const noise::MaterialVoices& voices, bool as_published) {
    noise::FrictionOptions options;
    options.sample_rate_hz = 48000;
    options.seed = 7;
    options.as_published = as_published;
    noise::FrictionVoice voice(voices, options);
    std::array<float, 2400> block;
    constexpr std::array<std::pair<double, double>, 6> kTargets{
        {{40, 0.3}, {100, 1}, {300, 2}, {2000, 5}, {0, 0}, {5, 0.1}}};
    for (const auto& [speed, force] : kTargets) {
        voice.set_target(speed, force);
        voice.render(block);
        for (const float sample : block) hash.add(sample);
    }
}

TEST(Voices, sound_as_written_down) {
    std::string found;
    for (const auto& [name, path] : material_files()) {
        const auto material = read_material(path);
        ASSERT_TRUE(material) << material.error().text();
        Hash hash;
        add_sound(hash, material->voices, false);
        add_sound(hash, material->voices, true);
        char line[128];
        std::snprintf(line, sizeof line, "%s %016llx\n", name.c_str(),
                      static_cast<unsigned long long>(hash.value()));
        found += line;
    }
    EXPECT_EQ(found, files::read_file(kSource + "tests/material/voices.txt", 10'000).value());
}

TEST(Voices, of_shipped_materials_are_written_as_they_are_read) {
    for (const auto& [name, path] : material_files()) {
        if (path.find("examples") == path.npos) continue;
        const std::string bytes = files::read_file(path, kLargestMaterialBytes).value();
        EXPECT_EQ(material_json(parse_material(bytes, path).value()), bytes) << path;
    }
}

TEST(Voices, of_odd_materials_survive_writing) {
    for (const auto& [name, path] : material_files()) {
        const Material material = read_material(path).value();
        EXPECT_EQ(parse_material(material_json(material), name).value(), material) << path;
    }
}

// The page refuses the same (web/touch/test/voices.test.ts).
TEST(Voices, are_refused_for_what_is_wrong) {
    const auto json = [](const std::string& path) {
        return files::Json::parse(files::read_file(kSource + "tests/material/" + path, 1 << 20).value());
    };
    const files::Json whole = json("odd/whole.json");
    for (const files::Json& wrong : json("refused.json")) {
        files::Json changed = whole;
        changed[files::Json::json_pointer(wrong["at"].get<std::string>())] = wrong["value"];
        const auto read = parse_material(changed.dump(), "m.json");
        ASSERT_FALSE(read) << wrong.dump();
        EXPECT_NE(read.error().cause.find(wrong["says"].get<std::string>()), std::string::npos)
            << read.error().text() << " for " << wrong.dump();
    }
}

}  // namespace
}  // namespace tribo::material
