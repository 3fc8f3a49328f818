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

class JoinedSweep final : public field::Shape {
  public:
    explicit JoinedSweep(std::vector<std::unique_ptr<const field::Shape>> parts) : parts_(std::move(parts)) {
        for (const auto& part : parts_) box_.include(part->bounds_mm());
    }

    Box3 bounds_mm() const override { return box_; }
    double distance_mm(Vec3 point) const override { return distance_below(point, kFarMm); }
    double distance_below(Vec3 point, double bound) const override { return least(point, bound).distance; }
    bool is_searched() const override {
        return std::ranges::any_of(parts_, [](const auto& part) { return part->is_searched(); });
    }
    Vec3 gradient(Vec3 point) const override { return nearest(point).gradient(point); }
    Slope slope(Vec3 point) const override { return nearest(point).slope(point); }

    void sample(const field::Lattice& lattice, float* out) const override {
        sample_near(lattice, kFarMm, out);
    }

    void sample_near(const field::Lattice& lattice, double near_mm, float* out) const override {
        constexpr int kLast = field::kLatticeEdge - 1;
        const Box3 nodes =
            Box3{lattice.node(0, 0, 0), lattice.node(kLast, kLast, kLast)}.inflated(kMitre * near_mm);
        std::fill_n(out, field::kLatticeNodes, static_cast<float>(2 * near_mm));
        std::array<float, field::kLatticeNodes> one;
        for (const auto& part : parts_) {
            if (!part->bounds_mm().overlaps(nodes)) continue;
            part->sample_near(lattice, near_mm, one.data());
            for (std::size_t n = 0; n < one.size(); ++n) out[n] = std::min(out[n], one[n]);
        }
    }

  private:
    struct Least {
        double distance;
        std::size_t part;
    };
    Least least(Vec3 point, double bound) const {
        Least least{bound, 0};
        const double reach = kMitre * std::max(bound, 0.0);
        if (!box_.inflated(reach).contains(point)) return least;
        for (std::size_t n = 0; n < parts_.size(); ++n) {
            const double d = parts_[n]->distance_below(point, least.distance);
            if (d < least.distance) least = {d, n};
        }
        return least;
    }
    const field::Shape& nearest(Vec3 point) const { return *parts_[least(point, kFarMm).part]; }

    std::vector<std::unique_ptr<const field::Shape>> parts_;
    Box3 box_;
};

}  // namespace

std::unique_ptr<field::Shape> join_sweeps(std::vector<std::unique_ptr<const field::Shape>> sweeps) {
    assert(!sweeps.empty());
    return std::make_unique<JoinedSweep>(std::move(sweeps));
}

}  // namespace tribo::milling
