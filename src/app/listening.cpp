// SPDX-License-Identifier: MIT
#include "app/listening.hpp"

#include "io/hrir_file.hpp"

namespace tribo::app {

using Heard = std::shared_ptr<const sound::Head>;

io::FileResult<Heard> head_of(const formats::JobSound& sound, int sample_rate_hz, const std::string& job_file,
                              Warnings& warnings) {
    const double rate = sample_rate_hz;
    const formats::SoundMode mode = sound.mode.value_or(formats::SoundMode::hrtf);
    if (mode == formats::SoundMode::pan) return sound::Head::panning(rate);
    if (mode == formats::SoundMode::sphere) return sound::Head::sphere(rate);
    auto set = sound.hrtf.empty() ? io::builtin_hrirs()
                                  : io::read_hrirs(sound.hrtf, "/proc/self/exe", kReadSofaVerb);
    if (set) {
        auto head = sound::Head::measured(*set, rate);
        if (head) return std::move(*head);
        return std::unexpected(io::Failure(head.error()));
    }
    if (!sound.hrtf.empty() || sound.mode) return std::unexpected(set.error());
    warnings.push_back({job_file, 0,
                        "the built-in head responses cannot be read (" + set.error().text() +
                            "): a sphere stands in for the head"});
    return sound::Head::sphere(rate);
}

}  // namespace tribo::app
