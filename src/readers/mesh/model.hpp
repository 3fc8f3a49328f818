// SPDX-License-Identifier: MIT
// Model files to triangles: STL, OBJ, PLY and VRML 2.0. From bytes, on any thread, allocating; what a reader
// does not know it refuses with file and line, it never guesses.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/mesh.hpp"
#include "base/result.hpp"

namespace tribo::readers {

enum class ModelFormat { stl, obj, ply, vrml, gltf };  // glTF is read by files/, which may open its buffers
std::string_view name(ModelFormat format);

// Triangles that a file may hold or unfold to; counted before memory is taken for them. At 48 bytes each
// (mesh and welding) the largest model takes about 1 GB.
inline constexpr std::uint64_t kMaxTriangles = 20'000'000;

// A model file (VRML, STL, OBJ, PLY, glTF). The path is ready to open: already joined with the job's folder.
struct ModelFile {
    std::string path;
    std::optional<double> unit_mm;  // millimetres per unit of the file, > 0; absent: as ModelOptions
};

// A file that a model names (VRML: Inline, EXTERNPROTO).
struct ModelNeighbour {
    std::string name;   // one file has one name, however it was asked for; stands in messages
    std::string bytes;  // unpacked
};

// Finds the file that `url` names in the file called `from`, of at most `limit_bytes` once unpacked. What it
// may open is the caller's to decide; the error's cause completes "the file '...' is not read: ".
using ModelNeighbours = std::function<Result<ModelNeighbour>(std::string_view url, const std::string& from,
                                                             std::uint64_t limit_bytes)>;

struct ModelOptions {
    std::string source_name;  // stands in messages; its extension decides where the content does not
    // Length of one unit of the file, mm; finite, > 0. Absent: what the file says of itself (only a glTF of
    // Tribo's does), else 1.
    std::optional<double> unit_mm = std::nullopt;
    ModelNeighbours neighbours = {};  // none: a model that needs another file is refused

    double unit() const { return unit_mm.value_or(1); }
};

// sRGB.
using Rgb8 = std::array<std::uint8_t, 3>;

// A run of triangles that the file draws as one shape.
struct ModelPart {
    std::uint32_t first_triangle = 0, triangles = 0;
    double crease_angle_rad = 0;  // faces that meet at less than this are meant to look smooth (VRML)
    bool solid = true;            // only the outside is meant to be seen (VRML)
};

struct Model {
    TriangleMesh mesh;  // mm; no unused and no non-finite position; no triangle with two equal corners
    std::vector<ModelPart> parts;  // VRML only: in order, together all triangles
    std::vector<Rgb8> colours =
        {};  // one per triangle, the mean of its corners; empty where the file has none
    ModelFormat format = ModelFormat::stl;
    Warnings warnings;
};

// The format, by content first and by the name's extension where the content says nothing (OBJ has no mark).
std::optional<ModelFormat> detect_model_format(std::string_view bytes, std::string_view source_name);

// Reads a model in whatever format it is in.
Result<Model> read_model(std::string_view bytes, const ModelOptions& options = {});
// Reads a model that is said to be in `format`; glTF is refused here.
Result<Model> read_model(std::string_view bytes, ModelFormat format, const ModelOptions& options = {});

}  // namespace tribo::readers
