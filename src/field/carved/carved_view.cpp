// SPDX-License-Identifier: MIT
#include "field/carved/carved_view.hpp"

#include <algorithm>
#include <array>

namespace tribo::field {
namespace {

// No solid is as deep as this, mm.
constexpr float kBelowAll = -1e30F;

}  // namespace

double CarvedView::distance_mm(Vec3 p) const {
    double d = field_.distance_mm(p);
    for (const PendingShape& pending : pending_) d = std::max(d, -pending.shape->distance_below(p, -d));
    return d;
}

bool CarvedView::is_material(Vec3 p, double skin) const {
    if (!field_.is_material(p, skin)) return false;
    for (std::size_t n = pending_.size(); n-- > 0;) {
        const PendingShape& pending = pending_[n];
        if (pending.bounds_mm.inflated(skin).contains(p) && pending.shape->distance_below(p, skin) < skin)
            return false;
    }
    return true;
}

double CarvedView::clear_way_mm(Vec3 p, double enough) const {
    double way = field_.clear_way_mm(p, enough);
    for (std::size_t n = pending_.size(); n-- > 0 && way < 0;) {
        const PendingShape& pending = pending_[n];
        if (!pending.bounds_mm.inflated(-way).contains(p)) continue;
        // Material ends where the shape begins; there is none within the shape.
        way = std::max(way, -pending.shape->distance_below(p, -way));
    }
    return way;
}

const Shape* CarvedView::emptied_by(Vec3 p, double skin) const {
    if (const ShapeId id = field_.emptied_by(p, skin); id != 0) return &field_.shape(id);
    for (std::size_t n = pending_.size(); n-- > 0;) {
        const PendingShape& pending = pending_[n];
        if (pending.bounds_mm.inflated(skin).contains(p) && pending.shape->distance_below(p, skin) < skin)
            return pending.shape;
    }
    return nullptr;
}

std::optional<Vec3> CarvedView::overlap(const Shape& shape, double depth_mm) const {
    const Box3 reach = shape.bounds_mm();
    const BrickCoord n = field_.size(), lo = field_.brick_at(reach.min), hi = field_.brick_at(reach.max);
    const double radius = field_.brick_radius_mm();
    std::optional<Vec3> place;
    // A brick that was cut knows no greater depth than near_mm.
    auto deepest = static_cast<float>(-std::min(depth_mm, field_.near_mm()));
    std::array<float, kLatticeNodes> own, least, other;
    // Raises the distances to what is in `sampled` too. True if a node is deeper than all before.
    const auto raise = [&](const std::array<float, kLatticeNodes>& sampled, float sign) {
        bool is_deeper = false;
        for (std::size_t at = 0; at < kLatticeNodes; ++at) {
            own[at] = std::max(own[at], sign * sampled[at]);
            is_deeper |= own[at] < deepest;
        }
        return is_deeper;
    };
    const auto overlaps = [&](BrickCoord brick) {
        const BrickRef ref = field_.ref(brick);
        const Vec3 c = field_.centre(brick);
        if (ref == kAir || shape.distance_below(c, radius) >= radius) return false;
        if (ref == kUntouched && field_.blank().distance_mm(c) > radius) return false;
        const Lattice nodes = field_.lattice(brick);
        field_.sample_nodes(brick, own.data());
        shape.sample_near(nodes, radius, other.data());
        bool is_deeper = raise(other, 1);
        for (std::size_t at = 0; is_deeper && at < pending_.size(); ++at) {
            const Shape& gone = *pending_[at].shape;
            if (gone.distance_below(c, radius) >= radius) continue;
            // Of the nodes that are no deeper no distance is asked.
            for (std::size_t node = 0; node < kLatticeNodes; ++node)
                least[node] = own[node] < deepest ? -own[node] : kBelowAll;
            gone.sample_below(nodes, radius, least.data(), other.data());
            is_deeper = raise(other, -1);
        }
        return is_deeper;
    };
    for (int k = std::max(lo.k, 0); k <= std::min(hi.k, n.k - 1); ++k) {
        for (int j = std::max(lo.j, 0); j <= std::min(hi.j, n.j - 1); ++j) {
            for (int i = std::max(lo.i, 0); i <= std::min(hi.i, n.i - 1); ++i) {
                if (!overlaps({i, j, k})) continue;
                const auto node = std::min_element(own.begin(), own.end());
                deepest = *node;
                const int at = static_cast<int>(node - own.begin());
                place = field_.lattice({i, j, k}).node(at % kLatticeEdge, at / kLatticeEdge % kLatticeEdge,
                                                       at / (kLatticeEdge * kLatticeEdge));
            }
        }
    }
    return place;
}

}  // namespace tribo::field
