// SPDX-License-Identifier: MIT
// `tribo learn --recording MM_PER_S:FILE ... --out M.json`: makes a material from recordings of friction.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/exit.hpp"
#include "app/options.hpp"
#include "app/outputs.hpp"
#include "app/verbs/verbs.hpp"
#include "base/text/decimal.hpp"
#include "base/text/limit_text.hpp"
#include "base/text/printable.hpp"
#include "files/image/image_file.hpp"
#include "files/sound/sound_file.hpp"
#include "material/learned_material.hpp"
#include "material/material_json.hpp"
#include "noise/learn/learning.hpp"
#include "report/learning_report.hpp"

namespace tribo::app {
namespace {

struct LearnCall {
    std::vector<std::string> recordings;
    std::string out, method = "yule-walker";
    material::Material known;  // values that are not learned; image paths as given
    double highpass_hz = noise::LearningOptions{}.highpass_hz;
    int order = 0;
    bool report = false;
};

struct Source {
    double speed_mm_per_s = 0, force_n = 1;
    std::string file;
};

// SPEED[@FORCE]:FILE
Result<Source> parse_source(const std::string& text) {
    const auto refuse = [&](std::string cause) {
        return fail("--recording '" + text + "': " + std::move(cause),
                    "write SPEED:FILE or SPEED@FORCE:FILE, such as 120:slow.wav or 120@0.5:light.wav");
    };
    Source source;
    std::string_view rest = text;
    const auto number = [&](double& value) {
        const std::size_t length = parse_decimal(rest, value);
        rest.remove_prefix(length);
        return length > 0;
    };
    if (!number(source.speed_mm_per_s)) return refuse("the speed is not a number");
    if (rest.starts_with('@')) {
        rest.remove_prefix(1);
        if (!number(source.force_n)) return refuse("the force is not a number");
    }
    const auto in_range = [&](const Limit& limit, double value) -> Result<void> {
        if (limit.range.contains(value)) return {};
        return fail("--recording '" + text + "': " + out_of_range(limit, value), range_remedy(limit));
    };
    if (auto good = in_range(kLimits.finger_speed, source.speed_mm_per_s); !good)
        return std::unexpected(good.error());
    if (auto good = in_range(kLimits.finger_force, source.force_n); !good)
        return std::unexpected(good.error());
    if (!rest.starts_with(':') || rest.size() < 2) return refuse("no file is named");
    source.file = rest.substr(1);
    return source;
}

struct Sounds {
    std::vector<noise::Recording> recordings;
    std::vector<material::RecordingSource> sources;
    Warnings warnings;
};

FileResult<Sounds> read_sounds(const LearnCall& call) {
    Sounds sounds;
    for (const std::string& text : call.recordings) {
        const Result<Source> source = parse_source(text);
        if (!source) return std::unexpected(FileFailure(source.error()));
        FileResult<files::SoundFile> file = files::read_sound(source->file);
        if (!file) return std::unexpected(file.error());
        sounds.warnings.insert(sounds.warnings.end(), file->warnings.begin(), file->warnings.end());
        material::RecordingSource from;
        from.file = std::filesystem::path(source->file).filename().string();
        from.sample_rate_hz = file->sample_rate_hz;
        from.channels = file->channels;
        from.bits = file->bits;
        sounds.sources.push_back(std::move(from));
        sounds.recordings.push_back({source->file, source->speed_mm_per_s, source->force_n,
                                     file->sample_rate_hz, std::move(file->samples)});
    }
    return sounds;
}

// Returns `image` relative to the material file.
std::string image_beside(const std::string& image, const std::string& out) {
    std::error_code error;
    const auto folder = std::filesystem::absolute(out, error).parent_path();
    const auto relative = std::filesystem::relative(std::filesystem::absolute(image, error), folder, error);
    return relative.empty() ? image : relative.generic_string();
}

material::Material material_of(const LearnCall& call, const noise::Learned& learned,
                               const noise::LearningOptions& options, const Sounds& sounds) {
    material::Material m = material::learned_material(call.known, learned, options, sounds.sources);
    if (m.name.empty()) m.name = std::filesystem::path(call.out).stem().string();
    for (std::string* image : {&m.image, &m.height_map}) {
        if (!image->empty()) *image = image_beside(*image, call.out);
    }
    return m;
}

void print(const material::Material& m, const noise::Learned& learned) {
    std::printf("%s: %zu voice%s of order %d\n", printable(m.name).c_str(), m.voices.models.size(),
                m.voices.models.size() == 1 ? "" : "s", learned.order);
    for (const noise::VoiceModel& v : m.voices.models) {
        std::printf("  %8.4g mm/s  %5.3g N  %6.1f dB\n", v.speed_mm_per_s, v.force_n, v.level_db);
    }
    std::printf("  level law %.1f dB at 100 mm/s and 1 N, %+.1f dB per decade of speed, %+.1f of force\n",
                m.voices.law.level_db, m.voices.law.db_per_decade_speed, m.voices.law.db_per_decade_force);
}

std::string report_file(const LearnCall& call) {
    return std::filesystem::path(call.out).replace_extension(".html").string();
}

// Reports one voice per model, with the first recording of this model.
FileResult<void> write_report(const LearnCall& call, const material::Material& m,
                              const noise::Learned& learned, const Sounds& sounds) {
    std::vector<report::ReportedVoice> voices(m.voices.models.size());
    for (std::size_t n = learned.recordings.size(); n-- > 0;) {
        const auto model = static_cast<std::size_t>(learned.recordings[n].model);
        const auto prepared = noise::prepare(sounds.recordings[n], call.highpass_hz);
        if (!prepared) return std::unexpected(FileFailure(prepared.error()));
        if (prepared->sample_rate_hz != m.voices.models[model].spectrum.sample_rate_hz) continue;
        voices[model] = {sounds.recordings[n].name, m.voices.models[model],
                         noise::quality_of(m.voices.models[model], *prepared, call.highpass_hz)};
    }
    return files::write_file(report_file(call), report::learning_report(m, learned, voices));
}

FileResult<void> check_pictures(const LearnCall& call) {
    if (call.known.image.empty()) return {};
    const FileResult<files::Image> image = files::read_image(call.known.image);
    if (!image) return std::unexpected(image.error());
    if (call.known.height_map.empty()) return {};
    const auto map = files::read_height_map(call.known.height_map, *image);
    if (!map) return std::unexpected(map.error());
    return {};
}

int learn(const LearnCall& call) {
    FileResult<Sounds> sounds = read_sounds(call);
    if (!sounds) return report(sounds.error());
    if (const auto checked = check_pictures(call); !checked) return report(checked.error());
    if (const auto checked =
            check_outputs({call.out, call.report ? report_file(call) : ""}, {call.known.image});
        !checked) {
        return report(checked.error());
    }
    noise::LearningOptions options;
    options.method = call.method == "burg" ? noise::Method::burg : noise::Method::yule_walker;
    options.highpass_hz = call.highpass_hz;
    if (call.order > 0) options.order = call.order;
    const Result<noise::Learned> learned = noise::learn(sounds->recordings, options);
    if (!learned) return report(learned.error());
    report(sounds->warnings);
    report(learned->warnings);
    const material::Material material = material_of(call, *learned, options, *sounds);
    if (const auto written = files::write_file(call.out, material::material_json(material)); !written) {
        return report(written.error());
    }
    if (call.report) {
        if (const auto written = write_report(call, material, *learned, *sounds); !written) {
            return report(written.error());
        }
    }
    print(material, *learned);
    return kDone;
}

}  // namespace

void add_learn(CLI::App& program, int& exit_code) {
    const auto call = std::make_shared<LearnCall>();
    CLI::App* verb = program.add_subcommand("learn", "Learn a material from recordings of friction");
    verb->add_option("--recording", call->recordings,
                     "Speed of the finger in mm/s, force in N (1 if absent), WAV or FLAC file; once for each")
        ->required()
        ->type_name("SPEED[@FORCE]:FILE");
    verb->add_option("--out", call->out, "Material file")->required()->type_name("M.json");
    CLI::Option* image =
        verb->add_option("--image", call->known.image, "Picture of the material")->type_name("F");
    verb->add_option("--height-map", call->known.height_map,
                     "Its heights, white is high; its own brightness stands for them if absent")
        ->needs(image)
        ->type_name("F");
    verb->add_option("--relief-slope", call->known.relief_slope,
                     "Root mean square slope of its small relief: 0.2 if absent, 0 for a smooth one")
        ->check(within(kLimits.optical_share))
        ->type_name("S");
    verb->add_option("--gloss", call->known.gloss, "Share of light that it mirrors: 0.04 if absent")
        ->check(within(kLimits.optical_share))
        ->type_name("G");
    verb->add_option("--roughness", call->known.roughness, "0.05 polished to 1 matt: 0.5 if absent")
        ->check(within(kLimits.roughness))
        ->type_name("R");
    verb->add_option("--pile", call->known.pile,
                     "Slope of its hairs where a finger has brushed over them: 0 if absent, no hairs")
        ->check(within(kLimits.optical_share))
        ->type_name("P");
    verb->add_option("--width-mm", call->known.width_mm, "Width of the image as the finger feels it")
        ->check(within(kLimits.material_width))
        ->type_name("W");
    verb->add_option("--stiffness", call->known.stiffness_n_per_mm, "K in N/mm: 4 if absent")
        ->check(within(kLimits.sheet_stiffness))
        ->type_name("K");
    verb->add_option("--viscosity", call->known.viscosity_n_s_per_mm, "nu in N s/mm: 0.3 if absent")
        ->check(within(kLimits.sheet_viscosity))
        ->type_name("NU");
    verb->add_option("--method", call->method, "How the models are fitted: yule-walker or burg")
        ->check(one_of({"yule-walker", "burg"}))
        ->type_name("HOW");
    verb->add_option("--order", call->order, "Poles of a model; chosen by held-out sound if absent")
        ->check(CLI::Range(1, noise::kLargestOrder))
        ->type_name("N");
    verb->add_option("--highpass", call->highpass_hz,
                     "Remove sound below: 50 Hz if absent, 0 for the mean alone")
        ->check(within(kLimits.learned_highpass))
        ->type_name("HZ");
    verb->add_flag("--report", call->report,
                   "Write a page beside the material (M.html): spectra, measures, both sounds to compare");
    verb->add_option("--name", call->known.name, "The file's name if absent")->type_name("TEXT");
    verb->add_option("--note", call->known.note, "Anything that readers of the file should know")
        ->type_name("TEXT");
    verb->callback([call, &exit_code] { exit_code = learn(*call); });
}

}  // namespace tribo::app
