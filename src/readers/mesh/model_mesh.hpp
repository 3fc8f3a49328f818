// SPDX-License-Identifier: MIT
// What all model readers do with their triangles once they have them.
#pragma once

#include "base/mesh.hpp"
#include "readers/mesh/model.hpp"

namespace tribo::readers {

// Files in which a vertex is written once per triangle have their equal vertices made one; files with an
// index keep the one they have: solids that touch there stay apart.
enum class Weld { no, exact };

// The point in mm; none when it is not finite or beyond single precision.
std::optional<Point3f> to_position(double x, double y, double z, double unit_mm);

// Warns where faces cross themselves or have no area.
void warn_of_crossing_faces(Model& model, const ModelOptions& options, std::uint64_t faces);

// The model of the triangles read: welds, drops triangles that use a vertex twice (counted in a warning; a
// triangle without area but with three different corners may be what closes a mesh, and stays), drops unused
// positions. A model without triangles is an error.
Result<Model> finish_model(Model model, const ModelOptions& options, Weld weld);

}  // namespace tribo::readers
