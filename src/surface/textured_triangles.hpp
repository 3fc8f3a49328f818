// SPDX-License-Identifier: MIT
// Textured triangles from the real grooves: heights and wavelengths are measured on the machined surface.
#pragma once

#include <optional>

#include "contact/distance_field.hpp"
#include "contact/texture_record.hpp"

namespace tribo::surface {

// The place where a cutter made its surface.
struct CutterPlace {
    Vec3 tip_mm;
    Vec3 normal{0, 0, 1};  // of the smooth surface, unit; the tool axis is good enough on gentle surfaces
    Vec3 feed{1, 0, 0};    // direction; any length, any angle to the normal
};

struct TextureOptions {
    // From the job if known: sidestep, and feed per tooth (or per turn, with run-out). 0: measured.
    double pitch_across_mm = 0, pitch_along_mm = 0;
    double reach_mm = 6;  // distance to each side in which grooves are searched; > 0
};

// Returns the eight triangles at a place: half a pitch to each side, heights over the mean plane of one pitch
// each way. Returns nothing if there is no surface within reach. Pitch and height of the grooves across and
// along the feed come from profiles through the place: the pitch is the shift at which the profile without
// its form (a parabola) is most like itself (autocorrelation above one half), the height the mean range of a
// pitch. A given pitch is kept and only its height is measured. 0 if nothing is regular. A few hundred
// queries of the field; allocates.
std::optional<contact::TextureRecord> textured_triangles(const contact::DistanceField& machined,
                                                         const CutterPlace& place,
                                                         const TextureOptions& options = {});

}  // namespace tribo::surface
