// SPDX-License-Identifier: MIT
// Makes a material from voices learned from recordings.
#pragma once

#include <vector>

#include "material/material.hpp"
#include "noise/learn/learning.hpp"

namespace tribo::material {

// Returns `known` with the learned voices, the method and the sources. `recordings`: the input of each
// learned recording (file, rate, channels and bits); its other values are computed. Numbers are rounded to
// significant digits.
Material learned_material(Material known, const noise::Learned& learned,
                          const noise::LearningOptions& options,
                          const std::vector<RecordingSource>& recordings);

}  // namespace tribo::material
