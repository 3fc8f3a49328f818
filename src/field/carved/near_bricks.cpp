// SPDX-License-Identifier: MIT
#include "field/carved/near_bricks.hpp"

#include <algorithm>
#include <cmath>

namespace tribo::field {
namespace {

// Largest number of bricks on each side.
constexpr int kMostReach = 6;

}  // namespace

NearBricks::NearBricks(const FieldQuery& field, BrickCoord here, Vec3 p, double bound_mm) {
    const double brick_mm = kBrickCells * field.cell_mm;
    const Vec3 corner = field.lattice(here).node(0, 0, 0);
    const auto low = [&](double from, double at) {
        return std::max(-kMostReach, static_cast<int>(std::floor((at - bound_mm - from) / brick_mm)));
    };
    const auto high = [&](double from, double at) {
        return std::min(kMostReach, static_cast<int>(std::floor((at + bound_mm - from) / brick_mm)));
    };
    const auto gap = [&](double from, int n, double at) {
        return std::max({0.0, from + n * brick_mm - at, at - from - (n + 1) * brick_mm});
    };
    const auto face = [&](double from, double at) { return std::min(at - from, from + brick_mm - at); };
    seen_mm_ =
        kMostReach * brick_mm + std::min({face(corner.x, p.x), face(corner.y, p.y), face(corner.z, p.z)});
    const double most = bound_mm * bound_mm;
    for (int k = low(corner.z, p.z); k <= high(corner.z, p.z); ++k) {
        const double z = gap(corner.z, k, p.z), zz = z * z;
        if (zz >= most) continue;
        for (int j = low(corner.y, p.y); j <= high(corner.y, p.y); ++j) {
            const double y = gap(corner.y, j, p.y), yz = zz + y * y;
            if (yz >= most) continue;
            for (int i = low(corner.x, p.x); i <= high(corner.x, p.x); ++i) {
                const double x = gap(corner.x, i, p.x), square = yz + x * x;
                if (square >= most) continue;
                const BrickCoord b{here.i + i, here.j + j, here.k + k};
                if (field.bricks.contains(b) && field.bricks.get(b) != kAir) put({square, b});
            }
        }
    }
}

bool NearBricks::take(double bound_mm, BrickCoord& b, double& distance_mm) {
    std::size_t least = count_;
    double square = bound_mm * bound_mm;
    for (std::size_t n = 0; n < count_; ++n) {
        if (all_[n].square < square) {
            square = all_[n].square;
            least = n;
        }
    }
    if (least == count_) return false;
    b = all_[least].brick;
    distance_mm = std::sqrt(square);
    all_[least] = all_[--count_];
    return true;
}

void NearBricks::put(const One& one) {
    const auto nearer = [](const One& a, const One& b) { return a.square < b.square; };
    if (count_ < all_.size()) {
        all_[count_++] = one;
        if (count_ == all_.size()) std::ranges::make_heap(all_, nearer);
        return;
    }
    One& farthest = all_.front();
    seen_mm_ = std::min(seen_mm_, std::sqrt(std::max(farthest.square, one.square)));
    if (one.square >= farthest.square) return;
    std::ranges::pop_heap(all_, nearer);
    all_.back() = one;
    std::ranges::push_heap(all_, nearer);
}

}  // namespace tribo::field
