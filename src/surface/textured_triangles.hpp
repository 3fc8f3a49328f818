// SPDX-License-Identifier: MIT
// Textured triangles from the real grooves: heights and wavelengths are measured on the machined surface.
#pragma once

#include <optional>

#include "contact/distance_field.hpp"
#include "contact/texture_record.hpp"

namespace tribo::surface {

// Where a cutter made its surface.
struct CutterPlace {
    Vec3 tip_mm;
    Vec3 normal{0, 0, 1};  // of the smooth surface, unit; the tool's axis serves on gentle surfaces
    Vec3 feed{1, 0, 0};    // direction, need not be unit nor at right angles to the normal
};

struct TextureOptions {
    // From the job where it is known: sidestep, and feed per tooth (or per turn, with run-out). 0: measured.
    double pitch_across_mm = 0, pitch_along_mm = 0;
    double reach_mm = 6;  // how far to each side is looked for grooves; > 0
};

// The eight triangles at a place: half a pitch to each side, heights over the mean plane of one pitch each
// way. None where there is no surface within reach. Some hundred queries of the field; allocates.
std::optional<contact::TextureRecord> textured_triangles(const contact::DistanceField& machined,
                                                         const CutterPlace& place,
                                                         const TextureOptions& options = {});

// Pitch and height of the grooves across and along the feed, from profiles through the place: the pitch is
// where the profile, less its form (a parabola), is most like itself shifted (autocorrelation above one
// half); the height is the mean range of a pitch. A pitch that is given is kept, its height measured. Nothing
// regular: 0.
contact::GrooveGeometry measure_grooves(const contact::DistanceField& machined, const CutterPlace& place,
                                        const TextureOptions& options = {});

}  // namespace tribo::surface
