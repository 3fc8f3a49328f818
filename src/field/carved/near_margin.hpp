// SPDX-License-Identifier: MIT
// What a hint proves of the surface around a point that moves: how long its nearest place stays the nearest.
#pragma once

#include "contact/distance_field.hpp"

namespace tribo::field {

// Forgets nothing of what was proven for the known places when another one than that of the hint is found:
// that becomes one of the others or, if there are too many, of all the rest.
void keep_margin(const contact::Foot& foot, Vec3 point_mm, contact::NearHint& hint);

// Whether a place is one of those of the hint and nearer than all that may be left. Material only ever
// disappears: surface that was farther away a short time ago still is.
bool is_nearer_than_rest(const contact::Foot& foot, Vec3 point_mm, const contact::NearHint& hint);

// Whether none of the other places of the hint can be nearer.
bool is_nearer_than_others(const contact::Foot& foot, Vec3 point_mm, const contact::NearHint& hint);

}  // namespace tribo::field
