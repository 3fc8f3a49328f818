// SPDX-License-Identifier: MIT
// How a job is heard: the head, and the recordings that the job names.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "base/result.hpp"
#include "files/files.hpp"
#include "job/job.hpp"
#include "sound/place/head.hpp"
#include "sound/play/soundtrack.hpp"

namespace tribo {

// Reads a SOFA file as `program verb FILE` (files/sound/hrir_file.hpp): a broken file may end the reader.
struct SofaReader {
    std::string program, verb;
};

// By [sound] mode and hrtf: measured responses (the file's, or libmysofa's own), a sphere, or panning. Where
// the shipped set is missing and the job did not ask for it, a sphere, and a warning.
// A file of responses is refused without `reader`.
FileResult<std::shared_ptr<const sound::Head>> head_of(const job::JobSound& sound, int sample_rate_hz,
                                                       const std::string& job_file,
                                                       const std::optional<SofaReader>& reader,
                                                       Warnings& warnings);

// What else [sound] names: recordings and the colour of the chips, read, checked and put into `track`.
FileResult<void> read_voices(const job::JobSound& sound, sound::SoundtrackOptions& track);

}  // namespace tribo
