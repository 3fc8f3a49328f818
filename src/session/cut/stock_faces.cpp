// SPDX-License-Identifier: MIT
#include "session/cut/stock_faces.hpp"

#include <algorithm>
#include <cmath>

namespace tribo::session {

std::vector<std::uint8_t> vertices_on_blank(const TriangleMesh& mesh, const field::Shape& blank,
                                            const ParallelFor& parallel) {
    constexpr std::size_t kAtOnce = 4096;
    constexpr double kOnBlankMm = 1e-3;
    const std::size_t count = mesh.positions.size();
    std::vector<std::uint8_t> on_blank(count);
    parallel((count + kAtOnce - 1) / kAtOnce, [&](std::size_t piece) {
        const std::size_t end = std::min(count, (piece + 1) * kAtOnce);
        for (std::size_t n = piece * kAtOnce; n < end; ++n) {
            const double off = blank.distance_mm(mesh.position(static_cast<std::uint32_t>(n)));
            on_blank[n] = std::abs(off) <= kOnBlankMm ? 1 : 0;
        }
    });
    return on_blank;
}

std::vector<std::uint8_t> untouched_triangles(const TriangleMesh& mesh,
                                              std::span<const std::uint8_t> on_blank) {
    std::vector<std::uint8_t> untouched;
    untouched.reserve(mesh.triangles.size());
    for (const Triangle& t : mesh.triangles)
        untouched.push_back(std::ranges::all_of(t, [&](std::uint32_t n) { return on_blank[n] != 0; }));
    return untouched;
}

}  // namespace tribo::session
