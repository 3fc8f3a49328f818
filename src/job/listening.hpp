// SPDX-License-Identifier: MIT
// Listener and acoustic environment of a cut: the sound options of a job, without recordings.
#pragma once

#include "base/vec3.hpp"
#include "job/job.hpp"
#include "sound/play/workshop.hpp"

namespace tribo::job {

struct Listening {
    Vec3 listener_mm;
    double distance_factor = 1, gain_db = 0, reference_distance_m = 1;
    sound::Body tool{};
    sound::Workshop workshop{};
};

// The options of a job. Default listener: middle of the top of the blank. The first cutter gives the body.
// The names of machine and room must exist.
Listening listening_to(const Job& job, const Box3& blank_mm);

void apply(const Listening& listening, sound::SoundtrackOptions& options);

}  // namespace tribo::job
