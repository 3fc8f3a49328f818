// SPDX-License-Identifier: MIT
// Common last steps of all model readers.
#pragma once

#include <string>

#include "base/mesh.hpp"
#include "readers/mesh/model.hpp"

namespace tribo::readers {

// `exact` merges equal vertices, for files that repeat a vertex in each triangle. Files with an index keep
// their vertices, so that solids that touch stay separate.
enum class Weld { no, exact };

// Returns the point in mm; none if it is not finite or beyond single precision.
std::optional<Point3f> to_position(double x, double y, double z, double unit_mm);

// Cause and remedy of the refusal of a model with too many triangles.
std::string too_many_triangles(const ModelOptions& options);
std::string fewer_triangles(const ModelOptions& options);

// Warns of faces that intersect themselves or have no area.
void warn_of_crossing_faces(Model& model, const ModelOptions& options, std::uint64_t faces);

// Completes a model: merges vertices, drops triangles that use a vertex twice (counted in a warning), and
// drops unused positions. A triangle with three different corners but no area stays, because it may close a
// mesh. A model without triangles is an error.
Result<Model> finish_model(Model model, const ModelOptions& options, Weld weld);

}  // namespace tribo::readers
