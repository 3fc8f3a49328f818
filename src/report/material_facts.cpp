// SPDX-License-Identifier: MIT
// Facts of a material for `tribo inspect`.
#include <algorithm>
#include <cstdio>

#include "files/json/json.hpp"
#include "report/facts.hpp"

namespace tribo::report {
namespace {

std::string text_of(const char* format, double value) {
    char text[64];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

files::Json voice_facts(const noise::VoiceModel& v) {
    files::Json json;
    json["speed_mm_per_s"] = v.speed_mm_per_s;
    json["force_n"] = v.force_n;
    json["level_db"] = v.level_db;
    json["sample_rate_hz"] = v.spectrum.sample_rate_hz;
    json["order"] = v.spectrum.reflection.size();
    json["textured"] = v.texture.has_value();
    if (v.texture) json["grains_per_mm"] = v.texture->grains.per_mm;
    return json;
}

std::string voice_text(const noise::VoiceModel& v) {
    std::string text = text_of("%.4g mm/s", v.speed_mm_per_s) + text_of(", %.3g N", v.force_n) +
                       text_of(": %.1f dB", v.level_db) + ", order " +
                       std::to_string(v.spectrum.reflection.size()) +
                       text_of(" at %.0f Hz", v.spectrum.sample_rate_hz);
    if (!v.texture) return text + ", Gaussian";
    text += ", textured";
    if (v.texture->grains.per_mm > 0) text += text_of(", %.3g grains per mm", v.texture->grains.per_mm);
    return text;
}

// Warnings about doubtful voices.
Warnings doubts(const material::Material& m) {
    Warnings warnings;
    if (m.voices.models.empty()) warnings.push_back({"", 0, "no voices: rubbing it makes no sound"});
    if (m.voices.models.size() == 1) {
        warnings.push_back({"", 0, "one recording alone: level over speed is an assumption"});
    }
    if (m.image.empty()) warnings.push_back({"", 0, "no image: pressing it shows nothing"});
    if (m.voices.law.db_per_decade_speed < 0) {
        warnings.push_back({"", 0, "the recordings get quieter as the finger gets faster"});
    }
    for (const auto& sources : m.sources) {
        for (const material::RecordingSource& s : sources) {
            if (s.clipped_share > 1e-4) warnings.push_back({"", 0, s.file + " was clipped"});
        }
    }
    return warnings;
}

}  // namespace

Facts describe(const material::Material& m) {
    Facts facts;
    files::Json json;
    json["schema"] = "tribo.inspect/1";
    json["kind"] = "material";
    facts.lines = {{"format", "material"}};
    if (!m.name.empty()) {
        json["name"] = m.name;
        facts.lines.emplace_back("name", m.name);
    }
    if (!m.note.empty()) {
        json["note"] = m.note;
        facts.lines.emplace_back("note", m.note);
    }
    json["stiffness_n_per_mm"] = m.stiffness_n_per_mm;
    json["viscosity_n_s_per_mm"] = m.viscosity_n_s_per_mm;
    facts.lines.emplace_back("stiffness", text_of("%.4g N/mm", m.stiffness_n_per_mm));
    facts.lines.emplace_back(
        "viscosity", text_of("%.4g N s/mm", m.viscosity_n_s_per_mm) +
                         text_of(", yields within %.3g s", m.viscosity_n_s_per_mm / m.stiffness_n_per_mm));
    if (m.width_mm > 0) {
        json["width_mm"] = m.width_mm;
        facts.lines.emplace_back("width", text_of("%.4g mm", m.width_mm));
    }
    if (!m.image.empty()) {
        json["image"] = m.image;
        facts.lines.emplace_back("image", m.image);
    }
    if (!m.height_map.empty()) {
        json["height_map"] = m.height_map;
        facts.lines.emplace_back("height map", m.height_map);
    }
    json["relief_slope"] = m.relief_slope;
    json["gloss"] = m.gloss;
    json["roughness"] = m.roughness;
    facts.lines.emplace_back("finish", text_of("gloss %.3g", m.gloss) +
                                           text_of(", roughness %.3g", m.roughness) +
                                           text_of(", relief of slope %.3g", m.relief_slope));
    json["pile"] = m.pile;
    if (m.pile > 0) facts.lines.emplace_back("pile", text_of("leans by a slope of %.3g", m.pile));
    json["voices"] = files::Json::array();
    for (const noise::VoiceModel& v : m.voices.models) {
        json["voices"].push_back(voice_facts(v));
        facts.lines.emplace_back("voice", voice_text(v));
    }
    if (!m.voices.models.empty()) {
        json["db_per_decade_speed"] = m.voices.law.db_per_decade_speed;
        json["db_per_decade_force"] = m.voices.law.db_per_decade_force;
        facts.lines.emplace_back("level",
                                 text_of("%+.1f dB per decade of speed", m.voices.law.db_per_decade_speed) +
                                     text_of(", %+.1f of force", m.voices.law.db_per_decade_force));
    }
    facts.warnings = doubts(m);
    json["warnings"] = files::Json::array();
    for (const Warning& w : facts.warnings) json["warnings"].push_back(w.message());
    facts.json = files::pretty(json);
    return facts;
}

}  // namespace tribo::report
