// SPDX-License-Identifier: MIT
#include "milling/sweep/joined_sweep.hpp"

#include <algorithm>
#include <array>
#include <cassert>

namespace tribo::milling {
namespace {

// Larger than every distance.
constexpr double kFarMm = 1e30;
// At an edge a mitred distance is at most the square root of 2 shorter than the distance.
constexpr double kMitre = 1.4143;

}  // namespace

JoinedSweep::JoinedSweep(std::vector<std::unique_ptr<const field::Shape>> parts) : parts_(std::move(parts)) {
    assert(!parts_.empty());
    for (const auto& part : parts_) box_.include(part->bounds_mm());
}

double JoinedSweep::distance_mm(Vec3 point) const {
    return least(point, kFarMm).distance;
}

double JoinedSweep::distance_below(Vec3 point, double bound) const {
    return least(point, bound).distance;
}

bool JoinedSweep::is_searched() const {
    return std::ranges::any_of(parts_, [](const auto& part) { return part->is_searched(); });
}

Vec3 JoinedSweep::gradient(Vec3 point) const {
    return parts_[least(point, kFarMm).part]->gradient(point);
}

field::Shape::Slope JoinedSweep::slope(Vec3 point) const {
    return parts_[least(point, kFarMm).part]->slope(point);
}

void JoinedSweep::sample(const field::Lattice& lattice, float* out) const {
    sample_near(lattice, kFarMm, out);
}

void JoinedSweep::sample_near(const field::Lattice& lattice, double near_mm, float* out) const {
    sample_below(lattice, near_mm, nullptr, out);
}

void JoinedSweep::sample_below(const field::Lattice& lattice, double near_mm, const float* known,
                               float* out) const {
    constexpr int kLast = field::kLatticeEdge - 1;
    const Box3 nodes =
        Box3{lattice.node(0, 0, 0), lattice.node(kLast, kLast, kLast)}.inflated(kMitre * near_mm);
    const auto beyond = static_cast<float>(2 * near_mm);
    for (std::size_t n = 0; n < field::kLatticeNodes; ++n)
        out[n] = known ? std::min(known[n], beyond) : beyond;
    std::array<float, field::kLatticeNodes> one;
    const std::size_t likely = likely_part(nodes.centre());
    for (std::size_t n = 0; n < parts_.size(); ++n) {
        const std::size_t part = n == 0 ? likely : n <= likely ? n - 1 : n;
        if (!parts_[part]->bounds_mm().overlaps(nodes)) continue;
        parts_[part]->sample_below(lattice, near_mm, out, one.data());
        for (std::size_t n = 0; n < one.size(); ++n) out[n] = std::min(out[n], one[n]);
    }
}

JoinedSweep::Least JoinedSweep::least(Vec3 point, double bound) const {
    const double reach = kMitre * std::max(bound, 0.0);
    if (!box_.inflated(reach).contains(point)) return {bound, 0};
    return nearest_part(point, {bound, 0});
}

JoinedSweep::Least JoinedSweep::nearest_part(Vec3 point, Least least) const {
    for (std::size_t n = 0; n < parts_.size(); ++n) {
        const double d = parts_[n]->distance_below(point, least.distance);
        if (d < least.distance) least = {d, n};
    }
    return least;
}

}  // namespace tribo::milling
