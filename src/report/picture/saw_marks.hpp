// SPDX-License-Identifier: MIT
// The marks of a saw on untouched stock, the same as in the pages (web/mill/src/sight/metal.ts): stripes
// across the part, in two widths.
#pragma once

#include "base/vec3.hpp"

namespace tribo::report {

// The way along which the stripes follow each other, mm.
double saw_path(Vec3 place_mm);

// About -0.6 to 0.6. Stripes that are finer than a pixel fade; `pixel` is the change of saw_path() over one.
float saw_marks(Vec3 place_mm, double pixel_mm);

}  // namespace tribo::report
