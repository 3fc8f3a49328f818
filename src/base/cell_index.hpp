// SPDX-License-Identifier: MIT
// Finds the places near a point: places sorted by the cubes of a grid. Built once; queries are real-time
// safe, from any thread.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec3.hpp"

namespace tribo {

class CellIndex {
  public:
    CellIndex() = default;
    // `cell_mm` > 0. Fewer than 2^32 finite places.
    CellIndex(std::span<const Vec3> places_mm, double cell_mm) : cell_mm_(cell_mm) {
        Box3 box;
        for (const Vec3& place : places_mm) box.include(place);
        if (places_mm.empty()) return;
        origin_ = box.min - Vec3{2 * cell_mm, 2 * cell_mm, 2 * cell_mm};
        entries_.reserve(places_mm.size());
        for (std::size_t n = 0; n < places_mm.size(); ++n)
            entries_.push_back({cell_of(places_mm[n], 0, 0, 0), static_cast<std::uint32_t>(n)});
        std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
            return a.cell != b.cell ? a.cell < b.cell : a.place < b.place;
        });
    }

    // Calls use(number of the place) for the places in the 27 cells around a finite point: all that are
    // nearer than `cell_mm`. At most `most` of each cell, those with the lowest numbers.
    template <class Use>
    void for_each_near(Vec3 point_mm, int most, Use&& use) const {
        for (int n = 0; n < 27; ++n) {
            const std::uint64_t cell = cell_of(point_mm, n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
            auto at = std::lower_bound(entries_.begin(), entries_.end(), cell,
                                       [](const Entry& e, std::uint64_t c) { return e.cell < c; });
            for (int k = 0; k < most && at != entries_.end() && at->cell == cell; ++k, ++at) use(at->place);
        }
    }

  private:
    static constexpr int kCellBits = 21;

    struct Entry {
        std::uint64_t cell;
        std::uint32_t place;
    };
    std::uint64_t cell_of(Vec3 p, int dx, int dy, int dz) const {
        const auto along = [&](double v, int d) {
            const double most = (1 << kCellBits) - 2;
            return static_cast<std::uint64_t>(std::clamp(std::floor(v / cell_mm_) + d, 0.0, most));
        };
        return along(p.x - origin_.x, dx) | along(p.y - origin_.y, dy) << kCellBits |
               along(p.z - origin_.z, dz) << 2 * kCellBits;
    }

    std::vector<Entry> entries_;  // sorted by cell, then by place
    Vec3 origin_;
    double cell_mm_ = 1;
};

}  // namespace tribo
