// SPDX-License-Identifier: MIT
// STL, text and binary: reading, and writing of binary files without holding the file in memory.
#pragma once

#include <array>
#include <functional>
#include <span>

#include "readers/mesh/model.hpp"

namespace tribo::readers {

inline constexpr std::size_t kStlHeaderBytes = 84;
inline constexpr std::size_t kStlFacetBytes = 50;

// True when the bytes are STL: they have the exact size of a binary file, or they are text that starts with
// `solid` and continues with facets. (Many binary files start with `solid` too; their size identifies them.)
bool looks_like_stl(std::string_view bytes);

// Merges vertices of equal position.
Result<Model> read_stl(std::string_view bytes, const ModelOptions& options);

// Receives the next bytes of a file. Returns false on failure, which ends the writing.
using ByteSink = std::function<bool(std::string_view)>;

// A binary file has a header and `triangles` facets. Positions in mm are written unchanged.
std::array<char, kStlHeaderBytes> stl_header(std::uint32_t triangles);
void put_stl_facet(const Point3f& a, const Point3f& b, const Point3f& c, std::span<char, kStlFacetBytes> out);

// Writes the mesh as binary STL through a buffer of 64 kB. Returns false if the sink failed.
bool write_stl(const TriangleMesh& mesh, const ByteSink& sink);

}  // namespace tribo::readers
