// SPDX-License-Identifier: MIT
// What searches along a surface have found, for other points nearby.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include "base/vec3.hpp"
#include "contact/distance_field.hpp"
#include "contact/half_spaces.hpp"

namespace tribo::contact {

// Keeps what was found by the place where a search began. A later one may take its room. About 600 kB large:
// not for the stack.
class SearchMemory {
  public:
    // From its start a search for a point a little away ends at the same place.
    struct Search {
        Vec3 start_mm, point_mm;
        // Over this way of the point, mm, the surface comes nearer to it from the start to the first edge.
        double lasts_mm = 0;
        Trail trail;  // `along`: towards the end
        Vec3 end_mm;
        HalfSpaces sides;          // that met at the end; none: nothing is remembered
        std::uint64_t change = 0;  // number of the state of the field
    };
    // A start, and the material that was found near it; none: it is in a gap between two sides.
    struct Wall {
        static constexpr std::uint64_t kNever = std::numeric_limits<std::uint64_t>::max();
        Vec3 start_mm;
        std::uint64_t change = kNever;  // number of the state of the field
        std::optional<Vec3> wall_mm;
    };
    // Where that from a start is remembered. Another one may be there.
    Search& from(Vec3 start_mm) { return search_[number_of(start_mm, kSearchBits)]; }
    Wall& wall_at(Vec3 start_mm) { return wall_[number_of(start_mm, kWallBits)]; }
    // For another field.
    void forget() {
        for (Search& one : search_) one.sides.count = 0;
        for (Wall& one : wall_) one.change = Wall::kNever;
    }

  private:
    static constexpr int kSearchBits = 8, kWallBits = 11;

    static std::size_t number_of(Vec3 start_mm, int bits) {
        // Any spread of nearby starts does: those of one grid differ by parts of a cell.
        const double mixed = 7919 * start_mm.x + 104729 * start_mm.y + 1299709 * start_mm.z;
        return static_cast<std::size_t>(std::bit_cast<std::uint64_t>(mixed) * 0x9e3779b97f4a7c15U >>
                                        (64 - bits));
    }

    std::array<Search, 1 << kSearchBits> search_;
    std::array<Wall, 1 << kWallBits> wall_;
};

}  // namespace tribo::contact
