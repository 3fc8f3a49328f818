// SPDX-License-Identifier: MIT
// Meshes that are drawn at random: bumpy balls and stars with flat, grooved and thin arms, and bent sheets.
#pragma once

#include <cmath>
#include <cstdint>

#include "base/draw.hpp"
#include "base/math.hpp"
#include "base/mesh.hpp"
#include "field/mesh/mesh_parts.hpp"

namespace tribo::field::test {

using tribo::test::Draw;

inline void add_quad(TriangleMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
}

// About the origin, 4 to 10 mm wide.
inline TriangleMesh any_bumpy_ball(Draw& draw) {
    TriangleMesh mesh;
    const int around = static_cast<int>(draw.between(6, 40)), down = static_cast<int>(draw.between(4, 30));
    const double radius = draw.between(4, 10), bump = draw.between(0, 0.5);
    const double u_waves = std::floor(draw.between(1, 8)), v_waves = std::floor(draw.between(1, 8));
    mesh.positions.push_back(to_float({0, 0, radius}));
    for (int j = 1; j < down; ++j) {
        for (int i = 0; i < around; ++i) {
            const double u = math::kTwoPi * i / around, v = 0.5 * math::kTwoPi * j / down;
            const double r =
                radius * (1 + bump * math::sin(u_waves * u) * math::sin(v_waves * v) * math::sin(v));
            mesh.positions.push_back(
                to_float(r * Vec3{math::sin(v) * math::cos(u), math::sin(v) * math::sin(u), math::cos(v)}));
        }
    }
    mesh.positions.push_back(to_float({0, 0, -radius}));
    const auto at = [&](int i, int j) {
        return static_cast<std::uint32_t>(1 + (j - 1) * around + i % around);
    };
    const auto last = static_cast<std::uint32_t>(mesh.positions.size() - 1);
    for (int i = 0; i < around; ++i) {
        mesh.triangles.push_back({0, at(i, 1), at(i + 1, 1)});
        for (int j = 1; j + 1 < down; ++j)
            add_quad(mesh, at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j));
        mesh.triangles.push_back({last, at(i + 1, down - 1), at(i, down - 1)});
    }
    return mesh;
}

// The same with each of its corners moved: folded, and through itself.
inline TriangleMesh any_crumpled_ball(Draw& draw) {
    TriangleMesh mesh = any_bumpy_ball(draw);
    const double most = draw.between(0.2, 2.5);
    for (Point3f& p : mesh.positions) {
        const double way = draw.between(0, most);
        p = to_float(to_double(p) + way * draw.direction());
    }
    return mesh;
}

// About the origin, up to 15 mm wide: a tube round a closed curve that mostly passes through itself.
inline TriangleMesh any_tube(Draw& draw) {
    constexpr int kAlong = 60, kWaves = 3;
    TriangleMesh mesh;
    const int around = static_cast<int>(draw.between(5, 14));
    const double radius = draw.between(0.8, 2.5);
    Vec3 cosines[kWaves], sines[kWaves];
    for (int k = 0; k < kWaves; ++k) {
        const double most = 5.0 / (k + 1);
        cosines[k] = draw.aside(most, -most, most);
        sines[k] = draw.aside(most, -most, most);
    }
    const auto place = [&](double t) {
        Vec3 p;
        for (int k = 0; k < kWaves; ++k)
            p += math::cos((k + 1) * t) * cosines[k] + math::sin((k + 1) * t) * sines[k];
        return p;
    };
    // The first ring's directions, carried along; the last ring meets it where they are alike.
    struct Ring {
        Vec3 u, v;
        Vec3 at(double angle) const { return math::cos(angle) * u + math::sin(angle) * v; }
    };
    Ring first, ring{{1, 0, 0}, {}};
    for (int n = 0; n < kAlong; ++n) {
        const double t = math::kTwoPi * n / kAlong;
        const Vec3 along = normalized(place(t + 1e-4) - place(t));
        ring.u = normalized(ring.u - dot(ring.u, along) * along, any_perpendicular(along));
        ring.v = cross(along, ring.u);
        if (n == 0) first = ring;
        for (int m = 0; m < around; ++m)
            mesh.positions.push_back(to_float(place(t) + radius * ring.at(math::kTwoPi * m / around)));
    }
    int shift = 0;
    for (int m = 0; m < around; ++m) {
        if (dot(ring.u, first.at(math::kTwoPi * m / around)) >
            dot(ring.u, first.at(math::kTwoPi * shift / around)))
            shift = m;
    }
    const auto at = [&](int n, int m) {
        if (n == kAlong) m += shift;
        return static_cast<std::uint32_t>(n % kAlong * around + m % around);
    };
    for (int n = 0; n < kAlong; ++n) {
        for (int m = 0; m < around; ++m)
            add_quad(mesh, at(n, m), at(n + 1, m), at(n + 1, m + 1), at(n, m + 1));
    }
    return mesh;
}

// Upright, about the origin, 5 to 10 mm wide. `wide_arms`: as wide at their ends as grooves are at their
// mouths.
inline TriangleMesh any_star(Draw& draw, bool wide_arms) {
    TriangleMesh mesh;
    const int corners = 2 * static_cast<int>(draw.between(3, wide_arms ? 6 : 12));
    const double radius = draw.between(5, 10),
                 inner = wide_arms ? draw.between(0.2, 0.4) : draw.between(0.15, 0.8),
                 half_height = draw.between(1, 6), lean = wide_arms ? draw.between(0.1, 0.35) : 0;
    for (const double z : {-half_height, half_height}) {
        mesh.positions.push_back(to_float({0, 0, z}));
        for (int i = 0; i < corners; ++i) {
            const double u = math::kTwoPi * (i + (i % 2 == 0 ? -lean : lean)) / corners,
                         r = i % 2 == 0 ? radius : inner * radius;
            mesh.positions.push_back(to_float({r * math::cos(u), r * math::sin(u), z}));
        }
    }
    const auto top = static_cast<std::uint32_t>(corners + 1);
    const auto at = [&](std::uint32_t level, int i) {
        return level + 1 + static_cast<std::uint32_t>(i % corners);
    };
    for (int i = 0; i < corners; ++i) {
        add_quad(mesh, at(0, i), at(0, i + 1), at(top, i + 1), at(top, i));
        mesh.triangles.push_back({0, at(0, i + 1), at(0, i)});
        mesh.triangles.push_back({top, at(top, i), at(top, i + 1)});
    }
    return mesh;
}

// Two bodies that overlap, as modellers leave them: their surfaces cross.
inline TriangleMesh any_two_bodies(Draw& draw) {
    TriangleMesh both = any_bumpy_ball(draw);
    TriangleMesh other = any_star(draw, true);
    const double beside = draw.between(2, 8);
    const Vec3 by = beside * draw.direction();
    for (Point3f& p : other.positions) p = to_float(to_double(p) + by);
    append(both, other);
    return both;
}

// 16 mm wide, front up, with waves of up to 2 mm.
inline TriangleMesh any_sheet(Draw& draw) {
    TriangleMesh mesh;
    const int cells = static_cast<int>(draw.between(4, 40));
    const double wave = draw.between(0, 2), rate = draw.between(0.2, 2), phase = draw.between(0, 6);
    for (int j = 0; j <= cells; ++j) {
        for (int i = 0; i <= cells; ++i) {
            const double x = -8 + 16.0 * i / cells, y = -8 + 16.0 * j / cells;
            mesh.positions.push_back(
                to_float({x, y, wave * math::sin(rate * x + phase) * math::cos(0.7 * rate * y)}));
        }
    }
    const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(j * (cells + 1) + i); };
    for (int j = 0; j < cells; ++j) {
        for (int i = 0; i < cells; ++i)
            add_quad(mesh, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
    }
    return mesh;
}

}  // namespace tribo::field::test
