// SPDX-License-Identifier: MIT
// The head through which a job is heard.
#pragma once

#include <memory>
#include <string>

#include "base/result.hpp"
#include "files/files.hpp"
#include "job/job.hpp"
#include "sound/place/head.hpp"
#include "sound/play/soundtrack.hpp"

namespace tribo::app {

// The verb, not shown in the help, by which the program starts itself to read a SOFA file.
inline constexpr const char* kReadSofaVerb = "read-sofa";

// By [sound] mode and hrtf: measured responses (the file's, or libmysofa's own), a sphere, or panning. Where
// the shipped set is missing and the job did not ask for it, a sphere, and a warning.
FileResult<std::shared_ptr<const sound::Head>> head_of(const job::JobSound& sound, int sample_rate_hz,
                                                       const std::string& job_file, Warnings& warnings);

// What else [sound] names: recordings and the colour of the chips, read, checked and put into `track`.
FileResult<void> read_voices(const job::JobSound& sound, sound::SoundtrackOptions& track);

}  // namespace tribo::app
