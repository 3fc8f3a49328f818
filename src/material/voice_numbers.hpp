// SPDX-License-Identifier: MIT
// The voices of a material as one row of numbers, for the audio module: the fields of `level_law` and
// `voices` in the order of the file, without the unheard ones. A number is stored as it is, a list after its
// length, an object after a 1; a 0 means an absent object.
#pragma once

#include <optional>
#include <span>

#include "noise/model/material_voices.hpp"

namespace tribo::material {

// An error in the numbers. The texts live as long as the program.
struct Refusal {
    const char* key = "";
    const char* cause = "";
};

// Returns at least one voice, with ranges and rules as in a material file; an absent level law is fitted.
// Returns none if the numbers are not valid voices.
std::optional<noise::MaterialVoices> voices_of(std::span<const double> numbers, Refusal& refusal);

}  // namespace tribo::material
