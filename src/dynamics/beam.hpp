// SPDX-License-Identifier: MIT
// Bending of a stepped round beam, as its free end feels it.
#pragma once

#include <span>
#include <vector>

namespace tribo::dynamics {

struct BeamMaterial {
    double young_n_per_mm2 = 0, poisson = 0, density_t_per_mm3 = 0;  // 1 t/mm3 = 1 N s2/mm4
};

// A solid cylinder; all values above 0.
struct BeamSection {
    double diameter_mm = 0, length_mm = 0;
    BeamMaterial material;
};

// Springs between two ends that would else be one: against moving apart, and against turning.
struct BeamJoint {
    double across_n_per_mm = 0, turn_nmm_per_rad = 0;  // > 0
};

// Sections in a row, rigidly one, and the joint with which the last one is held: on the first section of the
// next part, or on ground.
struct BeamPart {
    std::vector<BeamSection> sections;
    BeamJoint joint;
};

struct BendingMode {
    double frequency_hz = 0;
    double stiffness_n_per_mm = 0;  // modal, at the free end of the first part
};

// The lowest modes, ascending. Finite elements of Timoshenko's beam (Przemieniecki 1968; mass of Friedman and
// Kosmatka 1993; shear coefficient of Cowper 1966) with 200 elements a part or more, and inverse iteration.
// `parts`: at least one, with sections. Frequencies are good to 1e-4 for the first four modes. Any thread;
// allocates.
std::vector<BendingMode> bending_modes(std::span<const BeamPart> parts, std::size_t count);

}  // namespace tribo::dynamics
