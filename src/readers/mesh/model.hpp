// SPDX-License-Identifier: MIT
// Model files to triangles: STL, OBJ, PLY and VRML 2.0. Reads bytes, on any thread, with allocation. Unknown
// content is refused with file and line; the readers never guess.
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

enum class ModelFormat { stl, obj, ply, vrml, gltf };  // glTF is read by files/, which can open its buffers
std::string_view name(ModelFormat format);

// Maximum number of triangles of a file, after unfolding; counted before memory is allocated. At 48 bytes
// each (mesh and welding) the largest model takes about 1 GB.
inline constexpr std::uint64_t kMaxTriangles = 20'000'000;

// A model file (VRML, STL, OBJ, PLY, glTF). `path` can be opened as it is: it is already joined with the
// folder of the job.
struct ModelFile {
    std::string path;
    std::optional<double> unit_mm;  // millimetres per unit of the file, > 0; absent: see ModelOptions
    std::uint64_t max_triangles = kMaxTriangles;  // more are refused; at most kMaxTriangles
};

// A file named by a model (VRML: Inline, EXTERNPROTO).
struct ModelNeighbour {
    std::string name;   // the same for every way to ask for the file; used in messages
    std::string bytes;  // unpacked
};

// Finds the file that `url` names in the file `from`, with at most `limit_bytes` after unpacking. The caller
// decides which files may be opened. The cause of an error completes the sentence "the file '...' is not
// read: ".
using ModelNeighbours = std::function<Result<ModelNeighbour>(std::string_view url, const std::string& from,
                                                             std::uint64_t limit_bytes)>;

struct ModelOptions {
    std::string source_name;  // used in messages; its extension decides if the content does not
    // Length of one unit of the file, mm; finite, > 0. Absent: the unit stated in the file (only the glTF of
    // Tribo states one), else 1.
    std::optional<double> unit_mm = std::nullopt;
    ModelNeighbours neighbours = {};              // absent: a model that needs another file is refused
    std::uint64_t max_triangles = kMaxTriangles;  // as in ModelFile

    double unit() const { return unit_mm.value_or(1); }
};

// sRGB.
using Rgb8 = std::array<std::uint8_t, 3>;

// Consecutive triangles that the file draws as one shape.
struct ModelPart {
    std::uint32_t first_triangle = 0, triangles = 0;
    double crease_angle_rad = 0;  // VRML: edges with a smaller angle between their faces are drawn smooth
    bool solid = true;            // VRML: only the outside is drawn
};

struct Model {
    TriangleMesh mesh;  // mm; no unused and no non-finite position; no triangle with two equal corners
    std::vector<ModelPart> parts;    // VRML only: in order; together they contain all triangles
    std::vector<Rgb8> colours = {};  // one per triangle, the mean of its corners; empty: the file has none
    // One per triangle: 1 where the part of a mill is untouched stock; empty: not known (the glTF of Tribo
    // says it).
    std::vector<std::uint8_t> untouched = {};
    ModelFormat format = ModelFormat::stl;
    Warnings warnings;
};

// The format by the ending of a file's name.
std::optional<ModelFormat> model_format_of_name(std::string_view file);
// A well known format that is not read, by the ending of a file's name: STEP, 3MF, ...; else empty.
std::string_view other_model_format(std::string_view file);

// Detects the format by content, else by the extension of the name (OBJ has no magic number).
std::optional<ModelFormat> detect_model_format(std::string_view bytes, std::string_view source_name);

// Reads a model and detects its format.
Result<Model> read_model(std::string_view bytes, const ModelOptions& options = {});
// Reads a model in the given format. glTF is refused here.
Result<Model> read_model(std::string_view bytes, ModelFormat format, const ModelOptions& options = {});

}  // namespace tribo::readers
