// SPDX-License-Identifier: MIT
// glTF 2.0 in and out, through tinygltf.
#pragma once

#include <string>
#include <string_view>

#include "base/mesh.hpp"
#include "formats/model.hpp"
#include "io/files.hpp"

namespace tribo::io {

// A binary glTF file of one mesh. Positions stay in mm with z up; a node turns them into glTF's metres with y
// up. Without normals, as here, viewers shade each triangle flat, which is what sharp cusps want.
FileResult<void> write_glb(const std::string& path, const TriangleMesh& mesh);

// The triangles of all nodes of a scene, turned so that z is up. One unit is `unit_mm` like in every model
// file: 1000 for files that keep to glTF's metres. Only what is inside the file is read: buffers in other
// files are refused by name, as are sparse accessors and compressed meshes; images are skipped.
Result<formats::Model> read_gltf(std::string_view bytes, const formats::ModelOptions& options);

}  // namespace tribo::io
