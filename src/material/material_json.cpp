// SPDX-License-Identifier: MIT
#include "material/material_json.hpp"

#include <algorithm>
#include <array>

#include "base/math.hpp"
#include "files/json/json_section.hpp"

namespace tribo::material {
namespace {

using material::Material;
using material::RecordingSource;
using noise::VoiceModel;

constexpr std::array<std::string_view, 15> kMaterialKeys{
    "schema",    "name",   "note",       "stiffness_n_per_mm", "viscosity_n_s_per_mm",
    "width_mm",  "image",  "height_map", "relief_slope",       "gloss",
    "roughness", "voices", "method",     "highpass_hz",        "level_law"};
constexpr std::array<std::string_view, 3> kLawKeys{"level_db", "db_per_decade_speed", "db_per_decade_force"};
constexpr std::array<std::string_view, 9> kVoiceKeys{"speed_mm_per_s", "force_n",    "level_db",
                                                     "sample_rate_hz", "reflection", "line_spectrum_hz",
                                                     "recordings",     "texture",    "bass"};
constexpr std::array<std::string_view, 3> kBassKeys{"share", "sample_rate_hz", "reflection"};
constexpr std::array<std::string_view, 8> kSourceKeys{"file", "seconds", "sample_rate_hz", "channels",
                                                      "bits", "peak_db", "silent_share",   "clipped_share"};

constexpr std::array<std::string_view, 6> kTextureKeys{"crossovers_hz", "levels_db", "coherence",
                                                       "lengths_mm",    "weights",   "grains"};
constexpr std::array<std::string_view, 5> kGrainKeys{"per_mm", "share", "scatter", "sizes", "shape"};

constexpr std::size_t kMostVoices = 64;
constexpr std::size_t kMostSources = 256;
constexpr files::JsonRange kSpeeds{0, 1e6, true};
constexpr files::JsonRange kForces{0, 1e4, true};
constexpr files::JsonRange kLevels{-200, 60};
constexpr files::JsonRange kSlopes{-200, 200};
constexpr files::JsonRange kRates{1000, 384000};
constexpr files::JsonRange kShares{0, 1};

// One reading of a file: what it holds, and the first thing wrong.
class Reader {
  public:
    explicit Reader(const std::string& file) : file_(file) {}

    Result<Material> read(const files::Json& json) {
        files::JsonSection top(json, "", kMaterialKeys, error_, file_);
        const std::string schema = top.text("schema");
        if (!error_ && schema != kMaterialSchema) {
            top.fail("schema", "is '" + schema.substr(0, 80) + "'",
                     std::string("give a material of schema '") + kMaterialSchema + "'");
        }
        Material m;
        m.name = top.text("name", "");
        m.note = top.text("note", "");
        m.stiffness_n_per_mm = top.number("stiffness_n_per_mm", {0, 1e6, true});
        m.viscosity_n_s_per_mm = top.number("viscosity_n_s_per_mm", {0, 1e6});
        m.width_mm = top.number("width_mm", {0, 1e5}, 0);
        m.image = top.text("image", "");
        m.height_map = top.text("height_map", "");
        if (!m.height_map.empty() && m.image.empty()) {
            top.fail("height_map", "is given without an image", "name the image that it belongs to as well");
        }
        m.relief_slope = top.number("relief_slope", kShares, m.relief_slope);
        m.gloss = top.number("gloss", kShares, m.gloss);
        m.roughness = top.number("roughness", {material::kLeastRoughness, 1}, m.roughness);
        m.method = top.text("method", "");
        m.highpass_hz = top.number("highpass_hz", {0, 1e5}, 0);
        read_voices(top, m);
        if (const files::Json* law = top.object("level_law")) {
            files::JsonSection section(*law, "level_law", kLawKeys, error_, file_);
            m.voices.law.level_db = section.number("level_db", kLevels);
            m.voices.law.db_per_decade_speed = section.number("db_per_decade_speed", kSlopes);
            m.voices.law.db_per_decade_force = section.number("db_per_decade_force", kSlopes);
        } else {
            m.voices.law = noise::fit_level_law(m.voices.models);
        }
        if (error_) return std::unexpected(*error_);
        return m;
    }

  private:
    void read_voices(files::JsonSection& top, Material& m) {
        const std::vector<const files::Json*> voices = top.objects("voices", kMostVoices);
        for (std::size_t n = 0; n < voices.size() && !error_; ++n) {
            const std::string path = "voices[" + std::to_string(n) + "]";
            files::JsonSection section(*voices[n], path, kVoiceKeys, error_, file_);
            VoiceModel v;
            v.speed_mm_per_s = section.number("speed_mm_per_s", kSpeeds);
            v.force_n = section.number("force_n", kForces, 1);
            v.level_db = section.number("level_db", kLevels);
            v.spectrum.sample_rate_hz = section.number("sample_rate_hz", kRates);
            v.spectrum.reflection = section.numbers(
                "reflection", {-noise::kLargestReflection, noise::kLargestReflection}, noise::kLargestOrder);
            check_line_spectrum(section, v);
            if (const files::Json* bass = section.object("bass")) v.bass = read_bass(*bass, path + ".bass");
            if (const files::Json* texture = section.object("texture")) {
                v.texture = read_texture(*texture, path + ".texture", v.spectrum.sample_rate_hz);
            }
            if (!error_ && !m.voices.models.empty()) check_order(section, m.voices.models.back(), v);
            m.voices.models.push_back(std::move(v));
            m.sources.push_back(read_sources(section, path));
        }
    }

    noise::BassModel read_bass(const files::Json& json, const std::string& path) {
        files::JsonSection section(json, path, kBassKeys, error_, file_);
        noise::BassModel bass;
        bass.share = section.number("share", {0, 1});
        bass.spectrum.sample_rate_hz =
            section.number("sample_rate_hz", {2 * noise::kBassHz, 2 * noise::kBassRateHz});
        bass.spectrum.reflection = section.numbers(
            "reflection", {-noise::kLargestReflection, noise::kLargestReflection}, noise::kLargestOrder);
        return bass;
    }

    // The reflection coefficients count; the line spectrum is there for readers that would rather have it.
    void check_line_spectrum(files::JsonSection& section, const VoiceModel& v) {
        if (!section.has("line_spectrum_hz")) return;
        const std::vector<double> hz =
            section.numbers("line_spectrum_hz", {0, 0.5 * v.spectrum.sample_rate_hz}, noise::kLargestOrder);
        if (hz.size() != v.spectrum.reflection.size() || !std::ranges::is_sorted(hz)) {
            section.fail("line_spectrum_hz", "is not one rising frequency for each reflection coefficient",
                         "leave it out");
        }
    }

    void check_order(files::JsonSection& section, const VoiceModel& before, const VoiceModel& v) {
        const bool rises = v.force_n > before.force_n ||
                           (v.force_n == before.force_n && v.speed_mm_per_s > before.speed_mm_per_s);
        if (!rises) {
            section.fail("speed_mm_per_s", "does not rise",
                         "sort the voices by force, then speed, each pair once");
        }
    }

    noise::TextureModel read_texture(const files::Json& json, const std::string& path, double rate_hz) {
        files::JsonSection section(json, path, kTextureKeys, error_, file_);
        noise::TextureModel t;
        t.crossovers_hz = section.numbers("crossovers_hz", {0, 0.5 * rate_hz, true}, noise::kMostBands - 1);
        t.levels_db = section.tables("levels_db", {-300, 100}, noise::kMostBands);
        if (t.levels_db.size() != t.crossovers_hz.size() + 1 ||
            std::ranges::any_of(t.levels_db, [](const auto& l) { return l.size() != noise::kLevelSteps; }) ||
            !std::ranges::is_sorted(t.crossovers_hz)) {
            section.fail("levels_db", "does not fit crossovers_hz",
                         "give 17 levels for each band, one band more than rising crossovers");
        }
        t.coherence = section.number("coherence", kShares);
        t.lengths_mm = section.numbers("lengths_mm", {0, 1e6, true}, noise::kMostLengths);
        t.weights = section.numbers("weights", kShares, noise::kMostLengths);
        double sum = 0;
        for (const double w : t.weights) sum += w;
        if (t.weights.size() != t.lengths_mm.size() || (!t.weights.empty() && std::abs(sum - 1) > 1e-3)) {
            section.fail("weights", "is not one share for each length, sum 1", "let them add up to 1");
        }
        if (const files::Json* grains = section.object("grains")) {
            files::JsonSection inner(*grains, path + ".grains", kGrainKeys, error_, file_);
            t.grains.per_mm = inner.number("per_mm", {0, 1e4});
            t.grains.share = inner.number("share", kShares);
            t.grains.scatter = inner.number("scatter", kShares, 1);
            t.grains.sizes = inner.numbers("sizes", {-1e4, 1e4}, noise::kMostGrainSizes);
            t.grains.shape = inner.numbers("shape", {-1, 1}, noise::kLongestGrain);
            if (!std::ranges::is_sorted(t.grains.sizes)) {
                inner.fail("sizes", "does not rise", "sort it");
            }
        }
        return t;
    }

    std::vector<RecordingSource> read_sources(files::JsonSection& voice, const std::string& path) {
        std::vector<RecordingSource> sources;
        const std::vector<const files::Json*> items = voice.objects("recordings", kMostSources);
        for (std::size_t n = 0; n < items.size() && !error_; ++n) {
            files::JsonSection section(*items[n], path + ".recordings[" + std::to_string(n) + "]",
                                       kSourceKeys, error_, file_);
            RecordingSource s;
            s.file = section.text("file", "");
            s.seconds = section.number("seconds", {0, 1e6}, 0);
            s.sample_rate_hz = section.number("sample_rate_hz", {1, 1e7});
            s.channels = static_cast<int>(section.number("channels", {1, 1024}, 1));
            s.bits = static_cast<int>(section.number("bits", {0, 64}, 0));
            s.peak_db = section.number("peak_db", {-400, 100}, 0);
            s.silent_share = section.number("silent_share", kShares, 0);
            s.clipped_share = section.number("clipped_share", kShares, 0);
            sources.push_back(std::move(s));
        }
        return sources;
    }

    const std::string& file_;
    std::optional<Error> error_;
};

files::Json source_json(const RecordingSource& s) {
    files::Json json = files::Json::object();
    json["file"] = s.file;
    json["seconds"] = s.seconds;
    json["sample_rate_hz"] = s.sample_rate_hz;
    json["channels"] = s.channels;
    if (s.bits > 0) json["bits"] = s.bits;
    json["peak_db"] = s.peak_db;
    json["silent_share"] = s.silent_share;
    json["clipped_share"] = s.clipped_share;
    return json;
}

files::Json texture_json(const noise::TextureModel& t) {
    files::Json json = files::Json::object();
    json["crossovers_hz"] = t.crossovers_hz;
    json["levels_db"] = t.levels_db;
    json["coherence"] = t.coherence;
    json["lengths_mm"] = t.lengths_mm;
    json["weights"] = t.weights;
    if (t.grains.per_mm > 0) {
        files::Json& grains = json["grains"];
        grains["per_mm"] = t.grains.per_mm;
        grains["share"] = t.grains.share;
        grains["scatter"] = t.grains.scatter;
        grains["sizes"] = t.grains.sizes;
        grains["shape"] = t.grains.shape;
    }
    return json;
}

files::Json voice_json(const VoiceModel& v, const std::vector<RecordingSource>& sources) {
    files::Json json = files::Json::object();
    json["speed_mm_per_s"] = v.speed_mm_per_s;
    json["force_n"] = v.force_n;
    json["level_db"] = v.level_db;
    json["sample_rate_hz"] = v.spectrum.sample_rate_hz;
    json["reflection"] = v.spectrum.reflection;
    files::Json lines = files::Json::array();
    for (const double angle : noise::line_spectrum_of(v.spectrum.reflection)) {
        lines.push_back(std::round(100 * angle / math::kTwoPi * v.spectrum.sample_rate_hz) / 100);
    }
    json["line_spectrum_hz"] = std::move(lines);
    if (v.bass) {
        json["bass"] = {{"share", v.bass->share},
                        {"sample_rate_hz", v.bass->spectrum.sample_rate_hz},
                        {"reflection", v.bass->spectrum.reflection}};
    }
    if (v.texture) json["texture"] = texture_json(*v.texture);
    files::Json recordings = files::Json::array();
    for (const RecordingSource& s : sources) recordings.push_back(source_json(s));
    json["recordings"] = std::move(recordings);
    return json;
}

}  // namespace

Result<Material> parse_material(std::string_view text, const std::string& source_name) {
    if (text.size() > kLargestMaterialBytes) {
        return fail_at(source_name, 0, 0, "is too large for a material",
                       "give a file that tribo learn wrote");
    }
    const Result<files::Json> json = files::parse_json(text, source_name);
    if (!json) return std::unexpected(json.error());
    return Reader(source_name).read(*json);
}

FileResult<Material> read_material(const std::string& path) {
    const FileResult<std::string> bytes = files::read_file(path, kLargestMaterialBytes);
    if (!bytes) return std::unexpected(bytes.error());
    Result<Material> material = parse_material(*bytes, path);
    if (!material) return std::unexpected(FileFailure(material.error()));
    return *std::move(material);
}

std::string material_json(const Material& m) {
    files::Json json = files::Json::object();
    json["schema"] = kMaterialSchema;
    if (!m.name.empty()) json["name"] = m.name;
    if (!m.note.empty()) json["note"] = m.note;
    json["stiffness_n_per_mm"] = m.stiffness_n_per_mm;
    json["viscosity_n_s_per_mm"] = m.viscosity_n_s_per_mm;
    if (m.width_mm > 0) json["width_mm"] = m.width_mm;
    if (!m.image.empty()) json["image"] = m.image;
    const Material usual;
    if (!m.height_map.empty()) json["height_map"] = m.height_map;
    if (m.relief_slope != usual.relief_slope) json["relief_slope"] = m.relief_slope;
    if (m.gloss != usual.gloss) json["gloss"] = m.gloss;
    if (m.roughness != usual.roughness) json["roughness"] = m.roughness;
    if (!m.voices.models.empty()) {
        if (!m.method.empty()) json["method"] = m.method;
        if (m.highpass_hz > 0) json["highpass_hz"] = m.highpass_hz;
        json["level_law"]["level_db"] = m.voices.law.level_db;
        json["level_law"]["db_per_decade_speed"] = m.voices.law.db_per_decade_speed;
        json["level_law"]["db_per_decade_force"] = m.voices.law.db_per_decade_force;
        json["voices"] = files::Json::array();
        for (std::size_t n = 0; n < m.voices.models.size(); ++n) {
            json["voices"].push_back(voice_json(
                m.voices.models[n], n < m.sources.size() ? m.sources[n] : std::vector<RecordingSource>{}));
        }
    }
    return files::pretty(json);
}

bool looks_like_material(std::string_view text) {
    return text.substr(0, 4096).find("tribo.material") != std::string_view::npos;
}

}  // namespace tribo::material
