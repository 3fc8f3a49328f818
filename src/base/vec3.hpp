// SPDX-License-Identifier: MIT
// Points and vectors of three doubles, and axis-aligned boxes. Header only. All operations are + - * / sqrt,
// so that they give the same bits on every compiler.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace tribo {

struct Vec3 {
    double x = 0, y = 0, z = 0;

    constexpr double& operator[](int i) { return i == 0 ? x : i == 1 ? y : z; }
    constexpr double operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
    constexpr bool operator==(const Vec3&) const = default;
};

constexpr Vec3 operator+(Vec3 a, Vec3 b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
constexpr Vec3 operator-(Vec3 a, Vec3 b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
constexpr Vec3 operator-(Vec3 a) {
    return {-a.x, -a.y, -a.z};
}
constexpr Vec3 operator*(double s, Vec3 a) {
    return {s * a.x, s * a.y, s * a.z};
}
constexpr Vec3 operator*(Vec3 a, double s) {
    return s * a;
}
constexpr Vec3 operator/(Vec3 a, double s) {
    return {a.x / s, a.y / s, a.z / s};
}
constexpr Vec3& operator+=(Vec3& a, Vec3 b) {
    return a = a + b;
}
constexpr Vec3& operator-=(Vec3& a, Vec3 b) {
    return a = a - b;
}
constexpr Vec3& operator*=(Vec3& a, double s) {
    return a = s * a;
}

constexpr double dot(Vec3 a, Vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
constexpr Vec3 cross(Vec3 a, Vec3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
constexpr double squared_length(Vec3 a) {
    return dot(a, a);
}
inline double length(Vec3 a) {
    return std::sqrt(dot(a, a));
}
inline double distance(Vec3 a, Vec3 b) {
    return length(a - b);
}
constexpr Vec3 lerp(Vec3 a, Vec3 b, double t) {
    return a + t * (b - a);
}
inline bool is_finite(Vec3 a) {
    return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

// The unit vector along a, or `fallback` if a has no direction (zero or non-finite length).
inline Vec3 normalized(Vec3 a, Vec3 fallback = {0, 0, 1}) {
    const double l = length(a);
    return l > 0 && std::isfinite(l) ? a / l : fallback;
}

// A unit vector perpendicular to the unit vector u; continuous except where u crosses an octant border.
inline Vec3 any_perpendicular(Vec3 u) {
    const double ax = std::abs(u.x), ay = std::abs(u.y), az = std::abs(u.z);
    const Vec3 least = ax <= ay && ax <= az ? Vec3{1, 0, 0} : ay <= az ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
    return normalized(cross(u, least));
}

struct Box3 {
    Vec3 min{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
             std::numeric_limits<double>::infinity()};
    Vec3 max{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
             -std::numeric_limits<double>::infinity()};

    constexpr bool empty() const { return min.x > max.x || min.y > max.y || min.z > max.z; }
    constexpr Vec3 size() const { return max - min; }
    constexpr Vec3 centre() const { return 0.5 * (min + max); }
    constexpr double volume() const {
        const Vec3 s = size();
        return empty() ? 0 : s.x * s.y * s.z;
    }
    constexpr void include(Vec3 p) {
        min = {std::min(min.x, p.x), std::min(min.y, p.y), std::min(min.z, p.z)};
        max = {std::max(max.x, p.x), std::max(max.y, p.y), std::max(max.z, p.z)};
    }
    constexpr void include(const Box3& b) {
        if (b.empty()) return;
        include(b.min);
        include(b.max);
    }
    constexpr Box3 inflated(double by) const {
        return {{min.x - by, min.y - by, min.z - by}, {max.x + by, max.y + by, max.z + by}};
    }
    constexpr bool overlaps(const Box3& b) const {
        return min.x <= b.max.x && b.min.x <= max.x && min.y <= b.max.y && b.min.y <= max.y &&
               min.z <= b.max.z && b.min.z <= max.z;
    }
    constexpr bool contains(Vec3 p) const {
        return p.x >= min.x && p.x <= max.x && p.y >= min.y && p.y <= max.y && p.z >= min.z && p.z <= max.z;
    }
};

}  // namespace tribo
