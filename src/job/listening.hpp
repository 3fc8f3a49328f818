// SPDX-License-Identifier: MIT
// Who listens to a cut, and what stands around it: what a job says of its sound but for recordings.
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

// As the job says; without `listener_mm`, from the middle of the blank's top. The first cutter's bar rings.
// Machine and room have names that exist.
Listening listening_to(const Job& job, const Box3& blank_mm);

void apply(const Listening& listening, sound::SoundtrackOptions& options);

}  // namespace tribo::job
