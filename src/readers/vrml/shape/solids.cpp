// SPDX-License-Identifier: MIT
#include <array>
#include <utility>

#include "base/math.hpp"
#include "readers/vrml/fields.hpp"
#include "readers/vrml/shape/shapes.hpp"

namespace tribo::readers {
namespace {

constexpr std::uint32_t kSides = kVrmlSides, kRings = kVrmlSides / 2;

struct Direction {
    double x, z;
};

// Around the y axis from +z towards +x: counter-clockwise seen from above. Quarters are exact.
std::array<Direction, kSides> directions() {
    constexpr std::uint32_t quarter = kSides / 4;
    std::array<Direction, kSides> out{};
    for (std::uint32_t i = 0; i < quarter; ++i) {
        double s = 0, c = 1;
        math::sincos(2 * math::kPi * i / kSides, s, c);
        out[i] = {s, c};
        out[i + quarter] = {c, -s};
        out[i + 2 * quarter] = {-s, -c};
        out[i + 3 * quarter] = {-c, s};
    }
    return out;
}

std::uint32_t next(std::uint32_t i) {
    return (i + 1) % kSides;
}

class SolidReader {
  public:
    SolidReader(const VrmlTree& tree, VrmlNodeId node) : fields_(tree, node) {}

    Result<VrmlSurface> read(VrmlRole role) {
        const Result<void> ok = role == VrmlRole::box        ? box()
                                : role == VrmlRole::cone     ? cone()
                                : role == VrmlRole::cylinder ? cylinder()
                                                             : sphere();
        if (!ok) return std::unexpected(ok.error());
        return std::move(surface_);
    }

  private:
    Result<void> box() {
        double size[3] = {2, 2, 2};
        if (auto ok = fields_.read("size", size); !ok) return ok;
        for (const double s : size) {
            if (s <= 0) return fields_.refuse_field("size", "'size' must be three numbers above 0");
        }
        for (int i = 0; i < 8; ++i) {
            surface_.points.push_back({(i & 1 ? 0.5 : -0.5) * size[0], (i & 2 ? 0.5 : -0.5) * size[1],
                                       (i & 4 ? 0.5 : -0.5) * size[2]});
        }
        constexpr Triangle faces[] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
        surface_.triangles.assign(std::begin(faces), std::end(faces));
        return {};
    }

    // Adds the corners of a ring. Returns the index of the first.
    std::uint32_t add_ring(double radius, double y) {
        const auto first = static_cast<std::uint32_t>(surface_.points.size());
        for (const Direction& d : around_) surface_.points.push_back({radius * d.x, y, radius * d.z});
        return first;
    }
    void close_ring(std::uint32_t first, bool looks_up) {
        for (std::uint32_t i = 1; i + 1 < kSides; ++i) {
            surface_.triangles.push_back(
                {first, first + (looks_up ? i : i + 1), first + (looks_up ? i + 1 : i)});
        }
    }
    void add_band(std::uint32_t lower, std::uint32_t upper) {
        for (std::uint32_t i = 0; i < kSides; ++i) {
            surface_.triangles.push_back({lower + i, lower + next(i), upper + next(i)});
            surface_.triangles.push_back({lower + i, upper + next(i), upper + i});
        }
    }
    void add_tip(std::uint32_t ring, double y, bool is_top) {
        const auto tip = static_cast<std::uint32_t>(surface_.points.size());
        surface_.points.push_back({0, y, 0});
        for (std::uint32_t i = 0; i < kSides; ++i) {
            surface_.triangles.push_back({ring + (is_top ? i : next(i)), ring + (is_top ? next(i) : i), tip});
        }
    }

    Result<void> cone() {
        double radius = 1, height = 2;
        bool side = true, bottom = true;
        if (auto ok = fields_.read_size("bottomRadius", radius, 0, false); !ok) return ok;
        if (auto ok = fields_.read_size("height", height, 0, false); !ok) return ok;
        if (auto ok = fields_.read_flag("side", side); !ok) return ok;
        if (auto ok = fields_.read_flag("bottom", bottom); !ok) return ok;
        const std::uint32_t ring = add_ring(radius, -0.5 * height);
        if (side) add_tip(ring, 0.5 * height, true);
        if (bottom) close_ring(ring, false);
        return {};
    }

    Result<void> cylinder() {
        double radius = 1, height = 2;
        bool side = true, bottom = true, top = true;
        if (auto ok = fields_.read_size("radius", radius, 0, false); !ok) return ok;
        if (auto ok = fields_.read_size("height", height, 0, false); !ok) return ok;
        if (auto ok = fields_.read_flag("side", side); !ok) return ok;
        if (auto ok = fields_.read_flag("bottom", bottom); !ok) return ok;
        if (auto ok = fields_.read_flag("top", top); !ok) return ok;
        const std::uint32_t lower = add_ring(radius, -0.5 * height), upper = add_ring(radius, 0.5 * height);
        if (side) add_band(lower, upper);
        if (bottom) close_ring(lower, false);
        if (top) close_ring(upper, true);
        return {};
    }

    Result<void> sphere() {
        double radius = 1;
        if (auto ok = fields_.read_size("radius", radius, 0, false); !ok) return ok;
        std::uint32_t below = 0;
        for (std::uint32_t i = 1; i < kRings; ++i) {
            double s = 0, c = 1;
            math::sincos(math::kPi * i / kRings, s, c);
            const std::uint32_t ring = add_ring(radius * s, -radius * c);
            if (i > 1) add_band(below, ring);
            below = ring;
        }
        add_tip(0, -radius, false);
        add_tip(below, radius, true);
        return {};
    }

    VrmlFields fields_;
    VrmlSurface surface_;
    std::array<Direction, kSides> around_ = directions();
};

}  // namespace

std::uint64_t count_solid_triangles(VrmlRole role) {
    switch (role) {
        case VrmlRole::box:
            return 12;
        case VrmlRole::cone:
            return 2 * kSides - 2;
        case VrmlRole::cylinder:
            return 4 * kSides - 4;
        default:
            return std::uint64_t{2} * kSides * (kRings - 1);
    }
}

Result<VrmlSurface> read_vrml_solid(const VrmlTree& tree, VrmlNodeId solid) {
    return SolidReader(tree, solid).read(tree.nodes[solid].type->role);
}

}  // namespace tribo::readers
