// SPDX-License-Identifier: MIT
// Head and recordings of a job, for its sound.
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

// Reads a SOFA file in a separate process, as `program verb FILE` (files/sound/hrir_file.hpp): a broken file
// may crash the reader.
struct SofaReader {
    std::string program, verb;
};

// The head for [sound] mode and hrtf: measured responses (file or libmysofa), a sphere, or panning.
// If the shipped set is missing and the job did not request it: a sphere, with a warning.
// Without `reader` a file of responses is refused.
FileResult<std::shared_ptr<const sound::Head>> head_of(const job::JobSound& sound, int sample_rate_hz,
                                                       const std::string& job_file,
                                                       const std::optional<SofaReader>& reader,
                                                       Warnings& warnings);

// Reads and checks recordings and the spectrum of chips from [sound], and sets them in `track`.
FileResult<void> read_voices(const job::JobSound& sound, sound::SoundtrackOptions& track);

}  // namespace tribo
