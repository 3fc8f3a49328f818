// SPDX-License-Identifier: MIT
// Extrusion (ISO/IEC 14772-1, 6.18): a cross-section in the x-z plane, moved along a spine.
#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>
#include <utility>

#include "base/math.hpp"
#include "readers/vrml/fields.hpp"
#include "readers/vrml/shape/affine.hpp"
#include "readers/vrml/shape/shapes.hpp"

namespace tribo::readers {
namespace {

// Default values of the standard.
constexpr std::array kSquare{1.0, 1.0, 1.0, -1.0, -1.0, -1.0, -1.0, 1.0, 1.0, 1.0};
constexpr std::array kUpright{0.0, 0.0, 0.0, 0.0, 1.0, 0.0};
constexpr std::array kUnscaled{1.0, 1.0};
constexpr std::array kUnturned{0.0, 0.0, 1.0, 0.0};

// Angles with a sine up to this value count as straight.
constexpr double kStraight = 1e-9;

struct Frame {
    Vec3 x, y, z;
};

// Returns the direction perpendicular to two segments; zero if they are collinear.
Vec3 across(Vec3 a, Vec3 b) {
    const Vec3 c = cross(a, b);
    return length(c) <= kStraight * length(a) * length(b) ? Vec3{} : normalized(c);
}

// Replaces gaps by the last known value before them, and gaps at the start by the first known value.
void fill_gaps(std::vector<Vec3>& v) {
    const auto known = std::find_if(v.begin(), v.end(), [](Vec3 a) { return a != Vec3{}; });
    if (known == v.end()) return;
    std::fill(v.begin(), known, *known);
    for (std::size_t i = 1; i < v.size(); ++i) {
        if (v[i] == Vec3{}) v[i] = v[i - 1];
    }
}

// Frame of a straight spine: the rotation from +y to its direction, about their common perpendicular.
Frame straight_frame(Vec3 along) {
    const Vec3 up{0, 1, 0};
    if (along == Vec3{}) return {{1, 0, 0}, up, {0, 0, 1}};
    const double c = dot(up, along);
    if (c <= -1 + kStraight) return {{-1, 0, 0}, -up, {0, 0, 1}};  // half a turn about z
    const Vec3 a = cross(up, along);                               // length: sine of the angle
    const auto turned = [&](Vec3 p) { return c * p + cross(a, p) + dot(a, p) / (1 + c) * a; };
    return {turned({1, 0, 0}), along, turned({0, 0, 1})};
}

// The spine-aligned cross-section planes of 6.18.3.
std::vector<Frame> frames(std::span<const Vec3> spine) {
    const std::size_t n = spine.size();
    const bool closed = n > 2 && spine[0] == spine[n - 1];
    std::vector<Vec3> y(n), z(n);
    for (std::size_t i = 0; i < n; ++i) {
        const bool at_end = i == 0 || i + 1 == n;
        const Vec3 before = i > 0 ? spine[i - 1] : closed ? spine[n - 2] : spine[i];
        const Vec3 after = i + 1 < n ? spine[i + 1] : closed ? spine[1] : spine[i];
        y[i] = normalized(after - before, {});
        if (!at_end || closed) z[i] = across(after - spine[i], before - spine[i]);
    }
    fill_gaps(y);
    fill_gaps(z);
    std::vector<Frame> out(n);
    if (n == 0) return out;
    if (z[0] == Vec3{}) {
        const Frame straight = straight_frame(y[0]);
        for (Frame& f : out) f = straight;
        return out;
    }
    for (std::size_t i = 0; i < n; ++i) {
        if (i > 0 && dot(z[i], z[i - 1]) < 0) z[i] = -z[i];
        out[i] = {normalized(cross(y[i], z[i]), {}), y[i], z[i]};
    }
    return out;
}

std::vector<Vec3> points_of(std::span<const double> xyz) {
    std::vector<Vec3> out;
    for (std::size_t i = 0; i + 2 < xyz.size(); i += 3) out.push_back({xyz[i], xyz[i + 1], xyz[i + 2]});
    return out;
}

class ExtrusionReader {
  public:
    ExtrusionReader(const VrmlTree& tree, VrmlNodeId node, PolygonTriangulator& triangulator)
        : tree_(tree), node_(node), fields_(tree, node), triangulator_(triangulator) {}

    Result<VrmlSurface> read() {
        if (auto ok = read_fields(); !ok) return std::unexpected(ok.error());
        const std::size_t rings = spine_.size() / 3, corners = section_.size() / 2;
        if (rings < 2 || corners < 2) return std::move(surface_);
        const std::vector<Vec3> spine = points_of(spine_);
        const std::vector<Frame> planes = frames(spine);
        for (std::size_t i = 0; i < rings; ++i) add_ring(spine[i], planes[i], i);
        add_sides(static_cast<std::uint32_t>(rings), static_cast<std::uint32_t>(corners));
        if (auto ok = add_caps(static_cast<std::uint32_t>(rings), static_cast<std::uint32_t>(corners)); !ok)
            return std::unexpected(ok.error());
        join_equal_points();
        if (!ccw_) {
            for (Triangle& t : surface_.triangles) std::swap(t[1], t[2]);
        }
        return std::move(surface_);
    }

  private:
    Result<void> read_fields() {
        for (const auto& [name, flag] :
             {std::pair{"ccw", &ccw_}, std::pair{"solid", &surface_.solid},
              std::pair{"beginCap", &begin_cap_}, std::pair{"endCap", &end_cap_}}) {
            if (auto ok = fields_.read_flag(name, *flag); !ok) return ok;
        }
        if (auto ok = fields_.read_size("creaseAngle", surface_.crease_angle_rad, 0, true); !ok) return ok;
        struct List {
            const char* name;
            std::size_t width;
            std::span<const double>& out;
        };
        for (const List& list : {List{"crossSection", 2, section_}, List{"spine", 3, spine_},
                                 List{"scale", 2, scale_}, List{"orientation", 4, orientation_}}) {
            if (!tree_.find(node_, list.name)) continue;
            const auto numbers = fields_.read_list(list.name, list.width);
            if (!numbers) return std::unexpected(numbers.error());
            list.out = *numbers;
        }
        const std::size_t rings = spine_.size() / 3;
        for (const auto& [name, count] :
             {std::pair{"scale", scale_.size() / 2}, std::pair{"orientation", orientation_.size() / 4}}) {
            if (count != 1 && count < rings) {
                return fields_.refuse_field(name, quoted(name) +
                                                      " must have one value, or one for each of the " +
                                                      std::to_string(rings) + " points of the spine");
            }
        }
        return {};
    }

    void add_ring(Vec3 centre, const Frame& plane, std::size_t ring) {
        const auto scale = scale_.subspan(scale_.size() == 2 ? 0 : 2 * ring, 2);
        const auto turn = orientation_.subspan(orientation_.size() == 4 ? 0 : 4 * ring, 4);
        const Affine own = rotation({turn[0], turn[1], turn[2]}, turn[3]);
        for (std::size_t i = 0; i + 1 < section_.size(); i += 2) {
            const Vec3 p = own.turn({scale[0] * section_[i], 0, scale[1] * section_[i + 1]});
            surface_.points.push_back(centre + p.x * plane.x + p.y * plane.y + p.z * plane.z);
        }
    }

    void add_sides(std::uint32_t rings, std::uint32_t corners) {
        for (std::uint32_t i = 0; i + 1 < rings; ++i) {
            for (std::uint32_t k = 0; k + 1 < corners; ++k) {
                const std::uint32_t a = i * corners + k, b = a + 1, d = a + corners, c = d + 1;
                surface_.triangles.push_back({a, b, c});
                surface_.triangles.push_back({a, c, d});
            }
        }
    }

    // Makes flat faces from the whole cross-section, which is closed if necessary.
    Result<void> add_caps(std::uint32_t rings, std::uint32_t corners) {
        std::vector<std::uint32_t> numbers(corners);
        std::vector<Vec3> points(corners);
        for (const bool is_end : {false, true}) {
            if (corners < 3 || !(is_end ? end_cap_ : begin_cap_)) continue;
            std::iota(numbers.begin(), numbers.end(), is_end ? (rings - 1) * corners : 0);
            if (!is_end) std::reverse(numbers.begin(), numbers.end());
            for (std::uint32_t i = 0; i < corners; ++i) points[i] = surface_.points[numbers[i]];
            if (!triangulator_.append(numbers, points, surface_.triangles)) {
                return tree_.refuse(tree_.nodes[node_].place,
                                    "the caps of the Extrusion are too long to be cut into triangles",
                                    PolygonTriangulator::kTooConcaveRemedy);
            }
        }
        return {};
    }

    // Closed sections, closed spines and pointed ends have equal corners; this merges them.
    void join_equal_points() {
        const std::vector<Vec3>& p = surface_.points;
        if (!std::ranges::all_of(p, [](Vec3 q) { return is_finite(q); }))
            return;  // refused later, when it is placed
        std::vector<std::uint32_t> order(p.size()), joined(p.size());
        std::iota(order.begin(), order.end(), 0);
        const auto key = [&](std::uint32_t i) { return std::tuple{p[i].x, p[i].y, p[i].z, i}; };
        std::sort(order.begin(), order.end(),
                  [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
        for (std::size_t i = 0; i < order.size(); ++i) {
            const bool same = i > 0 && p[order[i]] == p[order[i - 1]];
            joined[order[i]] = same ? joined[order[i - 1]] : order[i];
        }
        for (Triangle& t : surface_.triangles) {
            for (std::uint32_t& corner : t) corner = joined[corner];
        }
        std::erase_if(surface_.triangles, is_degenerate);
    }

    const VrmlTree& tree_;
    VrmlNodeId node_;
    VrmlFields fields_;
    PolygonTriangulator& triangulator_;
    VrmlSurface surface_;
    std::span<const double> section_ = kSquare, spine_ = kUpright, scale_ = kUnscaled,
                            orientation_ = kUnturned;
    bool ccw_ = true, begin_cap_ = true, end_cap_ = true;
};

}  // namespace

std::uint64_t count_extrusion_triangles(const VrmlTree& tree, VrmlNodeId extrusion) {
    const auto count = [&](std::string_view field, std::size_t width, std::uint64_t otherwise) {
        const VrmlValue* value = tree.find(extrusion, field);
        return value ? std::uint64_t{tree.numbers_of(*value).size() / width} : otherwise;
    };
    const std::uint64_t corners = count("crossSection", 2, 5), rings = count("spine", 3, 2);
    if (corners < 2 || rings < 2) return 0;
    return 2 * (corners - 1) * (rings - 1) + 2 * (corners - 2);
}

Result<VrmlSurface> read_vrml_extrusion(const VrmlTree& tree, VrmlNodeId extrusion,
                                        PolygonTriangulator& triangulator) {
    return ExtrusionReader(tree, extrusion, triangulator).read();
}

}  // namespace tribo::readers
