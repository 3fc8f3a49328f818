// SPDX-License-Identifier: MIT
#include "tribo/job_hearing.hpp"

#include <map>
#include <mutex>

#include "files/sound/hrir_file.hpp"
#include "files/sound/sound_file.hpp"
#include "material/material_json.hpp"

namespace tribo {

namespace {

FileResult<std::shared_ptr<const sound::Recording>> recording(const std::string& path, double rpm) {
    auto file = files::read_sound(path);
    if (!file) return std::unexpected(file.error());
    auto recording = std::make_shared<sound::Recording>();
    recording->samples.assign(file->samples.begin(), file->samples.end());
    recording->sample_rate_hz = file->sample_rate_hz;
    recording->spindle_rpm = rpm;
    if (auto ok = sound::check_recording(*recording); !ok) {
        return std::unexpected(FileFailure({path, 0, 0, ok.error().cause, ok.error().remedy}));
    }
    return recording;
}

using Heard = std::shared_ptr<const sound::Head>;

// Heads out of the built-in set, as long as somebody hears with them: two jobs of one run share one.
class BuiltinHeads {
  public:
    Heard find(double rate_hz, sound::Equalization equalization) {
        const std::lock_guard lock(mutex_);
        return heads_[{rate_hz, equalization}].lock();
    }
    void keep(const Heard& head, sound::Equalization equalization) {
        const std::lock_guard lock(mutex_);
        heads_[{head->sample_rate_hz(), equalization}] = head;
    }

  private:
    std::mutex mutex_;
    std::map<std::pair<double, sound::Equalization>, std::weak_ptr<const sound::Head>> heads_;
};

BuiltinHeads& builtin_heads() {
    static BuiltinHeads heads;
    return heads;
}

}  // namespace

FileResult<Heard> head_of(const job::JobSound& sound, int sample_rate_hz, const std::string& job_file,
                          const std::optional<SofaReader>& reader, Warnings& warnings) {
    const double rate = sample_rate_hz;
    const job::SoundMode mode = sound.mode.value_or(job::SoundMode::hrtf);
    if (mode == job::SoundMode::pan) return sound::Head::panning(rate);
    if (mode == job::SoundMode::sphere) return sound::Head::sphere(rate);
    if (!sound.hrtf.empty() && !reader) {
        return std::unexpected(FileFailure({job_file, 0, 0, "the job names head responses of its own (hrtf)",
                                            "only the program reads them: take mode = \"sphere\" here"}));
    }
    const bool builtin = sound.hrtf.empty();
    const auto equalization = sound.as_measured ? sound::Equalization::none : sound::Equalization::diffuse;
    if (builtin) {
        if (Heard head = builtin_heads().find(rate, equalization)) return head;
    }
    auto set =
        builtin ? files::builtin_hrirs() : files::read_hrirs(sound.hrtf, reader->program, reader->verb);
    if (set) {
        const std::string file = builtin ? job_file : sound.hrtf;
        switch (sound::ear_order(*set)) {
            case sound::EarOrder::right:
                break;
            case sound::EarOrder::exchanged:
                sound::exchange_ears(*set);
                warnings.push_back(
                    {file, 0,
                     "the head responses name the left ear right: a source at the side is earlier "
                     "and louder in the other ear; they are exchanged"});
                break;
            case sound::EarOrder::unclear:
                warnings.push_back(
                    {file, 0,
                     "the head responses do not tell left from right: neither ear is both earlier "
                     "and louder on the side of the source; they are taken as the file names them"});
        }
        auto head = sound::Head::measured(*set, rate, equalization);
        if (!head) return std::unexpected(FileFailure(head.error()));
        if (builtin) builtin_heads().keep(*head, equalization);
        return std::move(*head);
    }
    if (!builtin || sound.mode) return std::unexpected(set.error());
    warnings.push_back({job_file, 0,
                        "the built-in head responses cannot be read (" + set.error().text() +
                            "): a sphere stands in for the head"});
    return sound::Head::sphere(rate);
}

FileResult<void> read_voices(const job::JobSound& sound, sound::SoundtrackOptions& track) {
    track.recording_share = sound.recording_share;
    if (!sound.recording.empty()) {
        auto read = recording(sound.recording, sound.recording_rpm);
        if (!read) return std::unexpected(read.error());
        track.recording = std::move(*read);
    }
    if (!sound.idle_recording.empty()) {
        auto read = recording(sound.idle_recording, sound.idle_recording_rpm);
        if (!read) return std::unexpected(read.error());
        track.idle = std::move(*read);
    }
    if (!sound.chips.empty()) {
        auto material = material::read_material(sound.chips);
        if (!material) return std::unexpected(material.error());
        if (material->voices.models.empty()) {
            return std::unexpected(FileFailure({sound.chips, 0, 0, "the material has no voice",
                                                "learn one from a recorded cut with tribo learn"}));
        }
        const noise::VoiceModel& voice = material->voices.models.front();
        track.chips.learned = voice.spectrum;
        if (voice.bass) track.chips.learned_bass = *voice.bass;
    }
    return {};
}

}  // namespace tribo
