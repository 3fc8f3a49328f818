// SPDX-License-Identifier: MIT
// glTF 2.0: reading (through tinygltf) and writing.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "base/mesh.hpp"
#include "files/files.hpp"
#include "readers/mesh/model.hpp"

namespace tribo::files {

// Writes a binary glTF file directly from the mesh. Machined surface is blue (as in the milling paper, figure
// 5), untouched stock grey: `untouched` is 1 for each triangle of it. Without `untouched` all triangles are
// machined. Positions stay in mm with z up. A node converts them to the metres of glTF with y
// up, and asset.extras.unit_mm gives the length of the unit for other readers. There are no normals: viewers
// then shade each triangle flat (glTF 2.0, 3.7.2.1), which keeps cusps sharp.
FileResult<void> write_glb(const std::string& path, const TriangleMesh& mesh,
                           std::span<const std::uint8_t> untouched = {});

// Reads the triangles of all nodes of a scene, rotated so that z is up, and merges equal vertices. One unit
// is `unit_mm`, as in every model file; without it, asset.extras.unit_mm of the file (Tribo writes it); else
// 1 with a warning, because the unit of the standard is the metre but exporters differ. Only data inside the
// file is read: buffers in other files, sparse accessors and compressed meshes are refused by name; images
// are skipped. Of a file of Tribo it is known which triangles are untouched stock. Triangles are counted
// before memory is allocated for them, a mesh once for each node that uses it.
Result<readers::Model> read_gltf(std::string_view bytes, const readers::ModelOptions& options);

}  // namespace tribo::files
