// SPDX-License-Identifier: MIT
// `tribo rub M.json --stroke CSV --out F.wav`: the friction sound of a stroke.
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "app/exit.hpp"
#include "app/interrupt.hpp"
#include "app/options.hpp"
#include "app/outputs.hpp"
#include "app/verbs/verbs.hpp"
#include "files/sound/wav.hpp"
#include "material/material_json.hpp"
#include "session/touch/rubbing.hpp"

namespace tribo::app {
namespace {

struct RubCall {
    std::string material, stroke, out, interpolate = "mix";
    int sample_rate_hz = 0, bits = 24;
    std::uint64_t seed = 1;
    bool as_published = false, gaussian = false;
};

// Returns the sample rate of the learned models if all have the same one and a file can have it.
int rate_of(const noise::MaterialVoices& voices) {
    const double rate = voices.models[0].spectrum.sample_rate_hz;
    const bool one = std::ranges::all_of(
        voices.models, [&](const noise::VoiceModel& m) { return m.spectrum.sample_rate_hz == rate; });
    return one && rate == std::floor(rate) && rate >= 8000 && rate <= 192000 ? static_cast<int>(rate) : 48000;
}

FileResult<void> write_sound(const RubCall& call, const noise::MaterialVoices& voices,
                             const std::vector<readers::FingerPoint>& points) {
    noise::FrictionOptions options;
    options.sample_rate_hz = call.sample_rate_hz > 0 ? call.sample_rate_hz : rate_of(voices);
    options.seed = call.seed;
    options.as_published = call.as_published;
    options.gaussian = call.gaussian;
    if (call.interpolate == "lsf") options.interpolation = noise::Interpolation::line_spectrum;
    session::Rubbing rubbing(voices, points, options);
    files::WavFormat format;
    format.sample_rate_hz = static_cast<int>(options.sample_rate_hz);
    format.channels = 1;
    format.bits = call.bits;
    auto wav = files::WavWriter::create(call.out, format);
    if (!wav) return std::unexpected(wav.error());
    if (rubbing.frames() > files::longest_wav_frames(format)) {
        return std::unexpected(FileFailure({call.stroke, 0, 0, "is longer than a WAV file holds",
                                            "shorten it, or try a lower --sample-rate"}));
    }
    std::vector<float> block(4096);
    for (std::int64_t done = 0; done < rubbing.frames() && !interrupted();) {
        const auto count = std::min<std::int64_t>(rubbing.frames() - done, 4096);
        const std::span<float> part(block.data(), static_cast<std::size_t>(count));
        rubbing.render(part);
        wav->write(part);
        done += count;
    }
    if (interrupted()) return {};  // the unfinished file is removed
    return wav->finish();
}

int rub(const RubCall& call) {
    const FileResult<material::Material> material = material::read_material(call.material);
    if (!material) return report(material.error());
    if (material->voices.models.empty()) {
        return report(Error{call.material, 0, 0, "has no voices, so rubbing it makes no sound",
                            "learn some with 'tribo learn'"});
    }
    const FileResult<std::string> bytes = files::read_file(call.stroke);
    if (!bytes) return report(bytes.error());
    readers::StrokeOptions options;
    options.source_name = call.stroke;
    const auto points = readers::read_finger_stroke(*bytes, options);
    if (!points) return report(points.error());
    if (const auto checked = check_outputs({call.out}); !checked) return report(checked.error());
    const auto written = write_sound(call, material->voices, *points);
    if (!written) return report(written.error());
    return interrupted() ? interrupted_exit_code() : kDone;
}

}  // namespace

void add_rub(CLI::App& program, int& exit_code) {
    const auto call = std::make_shared<RubCall>();
    CLI::App* verb = program.add_subcommand("rub", "Friction sound of a stroke over a material");
    verb->add_option("MATERIAL", call->material, "Material file (JSON) with voices")->required();
    verb->add_option("--stroke", call->stroke, "Where the finger goes: t_s,x_mm,y_mm,force_n")
        ->required()
        ->type_name("CSV");
    verb->add_option("--out", call->out, "Sound file, mono")->required()->type_name("F.wav");
    verb->add_option(
            "--interpolate", call->interpolate,
            "Between recorded speeds: 'mix' two filters' outputs, or move one filter's line spectrum "
            "('lsf')")
        ->check(one_of({"mix", "lsf"}))
        ->type_name("HOW");
    verb->add_flag("--as-published", call->as_published,
                   "The paper's generation step as printed: linear mix, mean power for gain");
    verb->add_flag("--gaussian", call->gaussian, "Without textures: coloured noise alone, to compare");
    verb->add_option("--sample-rate", call->sample_rate_hz, "That of the material if absent")
        ->check(within(kLimits.sample_rate))
        ->type_name("HZ");
    verb->add_option("--bits", call->bits, "16, 24 or 32")
        ->check(CLI::IsMember({16, 24, 32}))
        ->type_name("N");
    verb->add_option("--seed", call->seed, "Another number, another noise")->type_name("N");
    verb->callback([call, &exit_code] { exit_code = rub(*call); });
}

}  // namespace tribo::app
