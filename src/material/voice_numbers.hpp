// SPDX-License-Identifier: MIT
// The voices of a material as one row of numbers, for the audio module: the fields of `level_law` and
// `voices` in the order of the file, without those that are not heard. A number stands as it is, a list after
// its length, an object after a 1; a 0 stands for an object that is absent.
#pragma once

#include <optional>
#include <span>

#include "noise/model/material_voices.hpp"

namespace tribo::material {

// What is wrong with numbers; texts that live as long as the program.
struct Refusal {
    const char* key = "";
    const char* cause = "";
};

// At least one voice, ranges and rules as in a material file, the level law fitted where it is absent;
// nothing where the numbers are no such voices.
std::optional<noise::MaterialVoices> voices_of(std::span<const double> numbers, Refusal& refusal);

}  // namespace tribo::material
