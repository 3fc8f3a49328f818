// SPDX-License-Identifier: MIT
// The part as the report shows it in 3D: few vertices, small numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/mesh.hpp"

namespace tribo::report {

// As many as its page can number in 16 bits and carry beside the sound within 5 MB.
inline constexpr std::size_t kMostPartVertices = 50'000;

struct ReportPart {
    TriangleMesh mesh;                    // at most 65,535 vertices
    std::vector<std::uint8_t> untouched;  // a vertex: 1 where it stands on the blank's own face, else 0
    std::vector<float> deviation_mm;      // a vertex: + material left, - gouge; or empty
    double deviation_range_mm = 0;        // what the colours' ends mean; above 0 with deviations
};

// A mesh of the same shape with at most `most` vertices, the same where it has no more. Vertices of one kind
// in a cell of an even grid become one, placed where the planes of their triangles meet, so that edges stay
// (Lindstrom 2000, with the mean where that point lies far from the cell); triangles that keep fewer than
// three corners go. `kinds`: one a vertex, and so again afterwards.
TriangleMesh with_fewer_vertices(const TriangleMesh& mesh, std::size_t most,
                                 std::vector<std::uint8_t>& kinds);

// How the bytes are to be read, as JSON: vertices, triangles, origin (mm), step (mm), and where there are
// deviations deviation_step and deviation_range (mm).
std::string report_part_json(const ReportPart& part);
// Little-endian: u16[3] a vertex (position = origin + step x value), i16 a vertex where there are deviations,
// u16[3] a triangle, u8 a vertex, 1 where it is untouched.
std::string report_part_bytes(const ReportPart& part);

}  // namespace tribo::report
