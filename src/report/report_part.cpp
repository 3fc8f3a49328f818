// SPDX-License-Identifier: MIT
#include "report/report_part.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <limits>

#include "field/shape/quadric.hpp"

namespace tribo::report {
namespace {

constexpr std::int64_t kCellsAnAxis = 1 << 18;
// Largest distance of a vertex from its cell, in cell sides.
constexpr double kOutside = 0.3;
// Factor on the cell size if there were too many cells.
constexpr double kCoarser = 1.15;

// Index of the cell and kind of a vertex. After sorting, equal ones are adjacent.
std::int64_t cell_of(Vec3 p, std::uint8_t kind, Vec3 least, double cell_mm) {
    std::int64_t key = kind;
    for (int axis = 0; axis < 3; ++axis)
        key = key * kCellsAnAxis + static_cast<std::int64_t>((p[axis] - least[axis]) / cell_mm);
    return key;
}

// For each vertex the index of its cell among the occupied cells, and the number of these.
std::size_t number_cells(const TriangleMesh& mesh, const std::vector<std::uint8_t>& kinds, Vec3 least,
                         double cell_mm, std::vector<std::uint32_t>& of) {
    std::vector<std::pair<std::int64_t, std::uint32_t>> keys(mesh.positions.size());
    for (std::uint32_t n = 0; n < keys.size(); ++n)
        keys[n] = {cell_of(mesh.position(n), kinds[n], least, cell_mm), n};
    std::sort(keys.begin(), keys.end());
    of.resize(keys.size());
    std::size_t cells = 0;
    for (std::size_t n = 0; n < keys.size(); ++n) {
        if (n > 0 && keys[n].first != keys[n - 1].first) ++cells;
        of[keys[n].second] = static_cast<std::uint32_t>(cells);
    }
    return keys.empty() ? 0 : cells + 1;
}

struct Grid {
    Vec3 origin;
    double step_mm = 1;
};

Grid grid_of(const TriangleMesh& mesh) {
    if (mesh.positions.empty()) return {};
    const Box3 box = bounds(mesh);
    const Vec3 size = box.size();
    const double longest = std::max({size.x, size.y, size.z});
    return {box.min, longest > 0 ? longest / 65535 : 1};
}

// Range of stored deviations: twice the range of the colours.
double deviation_step_mm(const ReportPart& part) {
    return 2 * part.deviation_range_mm / 32767;
}

void append_u16(std::string& bytes, std::uint32_t value) {
    bytes += static_cast<char>(value & 0xff);
    bytes += static_cast<char>(value >> 8 & 0xff);
}

std::string json_number(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.9g", value);
    return text;
}

}  // namespace

TriangleMesh with_fewer_vertices(const TriangleMesh& mesh, std::size_t most,
                                 std::vector<std::uint8_t>& kinds) {
    assert(kinds.size() == mesh.positions.size());
    if (mesh.positions.size() <= most) return mesh;
    const Box3 box = bounds(mesh);
    const Vec3 size = box.size();
    const double longest = std::max({size.x, size.y, size.z, std::numeric_limits<double>::min()});
    // A surface of that area occupies about two cells for each square of a cell side.
    double cell = std::max(std::sqrt(area_mm2(mesh) / static_cast<double>(std::max<std::size_t>(most, 1))),
                           longest / (kCellsAnAxis - 1));
    std::vector<std::uint32_t> cell_of_vertex;
    std::size_t cells = number_cells(mesh, kinds, box.min, cell, cell_of_vertex);
    while (cells > most && cell < 2 * longest) {
        cell *= kCoarser;
        cells = number_cells(mesh, kinds, box.min, cell, cell_of_vertex);
    }

    std::vector<field::Quadric> quadrics(cells);
    TriangleMesh fewer;
    for (const Triangle& t : mesh.triangles) {
        const Triangle of{cell_of_vertex[t[0]], cell_of_vertex[t[1]], cell_of_vertex[t[2]]};
        if (!is_degenerate(of)) fewer.triangles.push_back(of);
        const Vec3 a = mesh.position(t[0]);
        const Vec3 across = cross(mesh.position(t[1]) - a, mesh.position(t[2]) - a);
        const double area = length(across);
        if (!(area > 0)) continue;
        for (std::size_t corner = 0; corner < 3; ++corner)
            quadrics[of[corner]].add(mesh.position(t[corner]), across / area);
    }
    std::vector<Vec3> corner(cells);
    std::vector<std::uint8_t> kind(cells);
    for (std::uint32_t n = 0; n < cell_of_vertex.size(); ++n) {
        const Vec3 p = (mesh.position(n) - box.min) / cell;
        kind[cell_of_vertex[n]] = kinds[n];
        corner[cell_of_vertex[n]] = box.min + cell * Vec3{std::floor(p.x), std::floor(p.y), std::floor(p.z)};
    }
    fewer.positions.resize(cells);
    for (std::size_t n = 0; n < cells; ++n) {
        Vec3 place = quadrics[n].count() > 0 ? quadrics[n].solve() : corner[n];
        for (int axis = 0; axis < 3; ++axis) {
            const double inside = (place[axis] - corner[n][axis]) / cell;
            if (!(inside >= -kOutside && inside <= 1 + kOutside)) {
                place = quadrics[n].count() > 0 ? quadrics[n].mean() : corner[n];
                break;
            }
        }
        fewer.positions[n] = to_float(place);
    }
    kinds = std::move(kind);
    return fewer;
}

std::string report_part_json(const ReportPart& part) {
    const Grid grid = grid_of(part.mesh);
    std::string json = "{\"vertices\":" + std::to_string(part.mesh.positions.size()) +
                       ",\"triangles\":" + std::to_string(part.mesh.triangles.size()) + ",\"origin\":[" +
                       json_number(grid.origin.x) + "," + json_number(grid.origin.y) + "," +
                       json_number(grid.origin.z) + "],\"step\":" + json_number(grid.step_mm);
    if (!part.deviation_mm.empty()) {
        json += ",\"deviation_step\":" + json_number(deviation_step_mm(part)) +
                ",\"deviation_range\":" + json_number(part.deviation_range_mm);
    }
    return json + "}";
}

std::string report_part_bytes(const ReportPart& part) {
    const TriangleMesh& mesh = part.mesh;
    assert(mesh.positions.size() <= 65535 && part.untouched.size() == mesh.positions.size());
    assert(part.deviation_mm.empty() ||
           (part.deviation_mm.size() == mesh.positions.size() && part.deviation_range_mm > 0));
    const Grid grid = grid_of(mesh);
    std::string bytes;
    bytes.reserve(9 * mesh.positions.size() + 6 * mesh.triangles.size());
    for (std::uint32_t n = 0; n < mesh.positions.size(); ++n) {
        const Vec3 p = (mesh.position(n) - grid.origin) / grid.step_mm;
        for (int axis = 0; axis < 3; ++axis)
            append_u16(bytes, static_cast<std::uint32_t>(std::clamp(p[axis] + 0.5, 0.0, 65535.0)));
    }
    for (const float d : part.deviation_mm) {
        const double steps = std::clamp(d / deviation_step_mm(part), -32767.0, 32767.0);
        append_u16(bytes, static_cast<std::uint16_t>(static_cast<std::int16_t>(std::lround(steps))));
    }
    for (const Triangle& t : mesh.triangles) {
        for (const std::uint32_t v : t) append_u16(bytes, v);
    }
    for (const std::uint8_t one : part.untouched) bytes += static_cast<char>(one);
    return bytes;
}

}  // namespace tribo::report
