// SPDX-License-Identifier: MIT
// The part for the 3D view of the report, with few vertices and small numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/mesh.hpp"

namespace tribo::report {

// Limit: 16-bit indices, and a page of 5 MB together with the sound.
inline constexpr std::size_t kMostPartVertices = 50'000;

struct ReportPart {
    TriangleMesh mesh;                    // at most 65,535 vertices
    std::vector<std::uint8_t> untouched;  // per vertex: 1 on a face of the blank, else 0
    std::vector<float> deviation_mm;      // per vertex: + material left, - gouge; or empty
    double deviation_range_mm = 0;        // value at the ends of the colour scale; > 0 with deviations
    std::string deviation_from = "deviation from the designed surface";
};

// Returns a mesh of the same shape with at most `most` vertices, or the same mesh if it has no more. Vertices
// of one kind in a cell of a uniform grid are merged at the intersection of the planes of their triangles, so
// that edges stay (Lindstrom 2000; the mean is used if that point is far from the cell). Triangles with fewer
// than three different corners are dropped. `kinds`: one per vertex, before and after.
TriangleMesh with_fewer_vertices(const TriangleMesh& mesh, std::size_t most,
                                 std::vector<std::uint8_t>& kinds);

// Returns the description of the bytes as JSON: vertices, triangles, origin (mm), step (mm), and with
// deviations deviation_step and deviation_range (mm).
std::string report_part_json(const ReportPart& part);
// Little-endian: u16[3] per vertex (position = origin + step * value), i16 per vertex if there are
// deviations, u16[3] per triangle, u8 per vertex (1: untouched).
std::string report_part_bytes(const ReportPart& part);

}  // namespace tribo::report
