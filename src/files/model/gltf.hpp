// SPDX-License-Identifier: MIT
// glTF 2.0 in (through tinygltf) and out.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "base/mesh.hpp"
#include "files/files.hpp"
#include "readers/mesh/model.hpp"

namespace tribo::files {

// Whether a triangle is still the face of the blank that it was before the cut.
using IsUntouched = std::function<bool(const Triangle&)>;

// A binary glTF file, straight from the mesh: nothing but a bit per triangle is held beside it. Machined
// surface is blue (as in the milling paper, figure 5), untouched stock grey; without `untouched` all of it is
// machined. Positions stay in mm with z up; a node turns them into glTF's metres with y up, and
// asset.extras.unit_mm says how long the unit is, for readers that would take it for something else. No
// normals: viewers then shade each triangle flat (glTF 2.0, 3.7.2.1), which keeps cusps sharp.
FileResult<void> write_glb(const std::string& path, const TriangleMesh& mesh,
                           const IsUntouched& untouched = {});

// The triangles of all nodes of a scene, turned so that z is up, equal vertices made one. One unit is
// `unit_mm` as in every model file; where nobody says it, the file's own asset.extras.unit_mm (Tribo writes
// it), and otherwise 1 with a warning: the standard's unit is the metre, exporters differ. Only what is
// inside the file is read: buffers in other files are refused by name, as are sparse accessors and compressed
// meshes; images are skipped. Triangles are counted before memory is taken for them, a mesh once for each
// node that shows it.
Result<readers::Model> read_gltf(std::string_view bytes, const readers::ModelOptions& options);

}  // namespace tribo::files
