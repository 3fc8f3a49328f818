// SPDX-License-Identifier: MIT
#include "field/carved/carved_view.hpp"

#include <algorithm>
#include <array>

namespace tribo::field {

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
    float deepest = static_cast<float>(-depth_mm);
    std::array<float, kLatticeNodes> other, own, carved;
    for (int k = std::max(lo.k, 0); k <= std::min(hi.k, n.k - 1); ++k) {
        for (int j = std::max(lo.j, 0); j <= std::min(hi.j, n.j - 1); ++j) {
            for (int i = std::max(lo.i, 0); i <= std::min(hi.i, n.i - 1); ++i) {
                const BrickRef ref = field_.ref({i, j, k});
                const Vec3 c = field_.centre({i, j, k});
                if (ref == kAir || shape.distance_mm(c) > radius) continue;
                if (ref == kUntouched && field_.blank().distance_mm(c) > radius) continue;
                const Lattice nodes = field_.lattice({i, j, k});
                shape.sample(nodes, other.data());
                field_.sample_nodes({i, j, k}, own.data());
                for (const PendingShape& pending : pending_) {
                    if (pending.shape->distance_mm(c) > radius) continue;
                    pending.shape->sample(nodes, carved.data());
                    for (std::size_t at = 0; at < kLatticeNodes; ++at)
                        own[at] = std::max(own[at], -carved[at]);
                }
                for (int at = 0; at < kLatticeNodes; ++at) {
                    const auto node = static_cast<std::size_t>(at);
                    const float d = std::max(other[node], own[node]);
                    if (d >= deepest) continue;
                    deepest = d;
                    place = nodes.node(at % kLatticeEdge, at / kLatticeEdge % kLatticeEdge,
                                       at / (kLatticeEdge * kLatticeEdge));
                }
            }
        }
    }
    return place;
}

}  // namespace tribo::field
