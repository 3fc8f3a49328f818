// SPDX-License-Identifier: MIT
// STL, text and binary: reading, and writing binary without holding the file.
#pragma once

#include <array>
#include <functional>
#include <span>

#include "readers/mesh/model.hpp"

namespace tribo::readers {

inline constexpr std::size_t kStlHeaderBytes = 84;
inline constexpr std::size_t kStlFacetBytes = 50;

// True when the bytes are STL: of a binary file's exact size, or text that starts with `solid` and goes on
// with facets. (Many binary files start with `solid` as well; their size tells.)
bool looks_like_stl(std::string_view bytes);

// Vertices of equal position are made one.
Result<Model> read_stl(std::string_view bytes, const ModelOptions& options);

// Takes the next bytes of a file; false when it cannot, which ends the writing.
using ByteSink = std::function<bool(std::string_view)>;

// A binary file is one header and `triangles` facets. Positions in mm are written as they are.
std::array<char, kStlHeaderBytes> stl_header(std::uint32_t triangles);
void put_stl_facet(const Point3f& a, const Point3f& b, const Point3f& c, std::span<char, kStlFacetBytes> out);

// Writes the mesh as binary STL through a buffer of 64 kB; false when the sink refused.
bool write_stl(const TriangleMesh& mesh, const ByteSink& sink);

}  // namespace tribo::readers
