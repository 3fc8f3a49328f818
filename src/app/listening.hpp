// SPDX-License-Identifier: MIT
// The head through which a job is heard.
#pragma once

#include <memory>
#include <string>

#include "base/result.hpp"
#include "formats/job.hpp"
#include "io/files.hpp"
#include "sound/head.hpp"
#include "sound/soundtrack.hpp"

namespace tribo::app {

// The verb, not shown in the help, by which the program starts itself to read a SOFA file.
inline constexpr const char* kReadSofaVerb = "read-sofa";

// By [sound] mode and hrtf: measured responses (the file's, or libmysofa's own), a sphere, or panning. Where
// the shipped set is missing and the job did not ask for it, a sphere, and a warning.
io::FileResult<std::shared_ptr<const sound::Head>> head_of(const formats::JobSound& sound, int sample_rate_hz,
                                                           const std::string& job_file, Warnings& warnings);

// What else [sound] names: recordings and the colour of the chips, read, checked and put into `track`.
io::FileResult<void> read_voices(const formats::JobSound& sound, sound::SoundtrackOptions& track);

}  // namespace tribo::app
