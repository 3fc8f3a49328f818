// SPDX-License-Identifier: MIT
// What was learned from recordings as a material.
#pragma once

#include <vector>

#include "material/material.hpp"
#include "noise/learn/learning.hpp"

namespace tribo::material {

// `known` with the voices that were learned, how, and from what. `recordings`: of each that was learned from,
// as they came: file, rate, channels and bits; the rest was found. Numbers keep as many digits as matter.
Material learned_material(Material known, const noise::Learned& learned,
                          const noise::LearningOptions& options,
                          const std::vector<RecordingSource>& recordings);

}  // namespace tribo::material
