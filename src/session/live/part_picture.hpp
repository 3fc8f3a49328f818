// SPDX-License-Identifier: MIT
// The part as a picture that follows the cut: chunks of the surface, each told anew when it has changed.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "base/mesh.hpp"
#include "base/parallel.hpp"
#include "field/carved/carved_field.hpp"
#include "surface/designed_surface.hpp"

namespace tribo::session {

// Bricks along each edge of a chunk: large enough that a part is some hundred chunks, small enough that a cut
// changes few of them.
inline constexpr int kChunkBricks = 4;

// Counts chunks, not bricks.
struct ChunkCoord {
    int i = 0, j = 0, k = 0;
};

// One thread at a time, never while the field is carved.
class PartPicture {
  public:
    // Deviations from the designed surface are looked for up to here.
    static constexpr double kReachMm = 3;
    // A chunk's surface, and how far each vertex is from the designed one (surface::deviations_of), if there
    // is any.
    using Show = std::function<void(ChunkCoord, TriangleMesh, std::vector<float> deviations_mm)>;

    // The field must outlive it.
    explicit PartPicture(const field::CarvedField& field, ParallelFor parallel = serial_for,
                         std::shared_ptr<const surface::DesignedSurface> designed = {});

    // Calls show for each chunk within `box_mm` whose surface is not as it was last shown; an
    // empty mesh stands for a surface that is gone. Cost: the chunks of the box, and a contour of those that
    // have changed.
    void update(const Box3& box_mm, const Show& show);
    // The box of everything.
    Box3 all() const;

  private:
    // A number that changes with the bricks that a chunk is drawn from.
    std::uint64_t state(ChunkCoord chunk) const;
    std::size_t number(ChunkCoord chunk) const;

    const field::CarvedField& field_;
    ParallelFor parallel_;
    std::shared_ptr<const surface::DesignedSurface> designed_;
    ChunkCoord size_;
    std::vector<std::uint64_t> shown_;
    struct Change {
        ChunkCoord chunk;
        bool was_seen = false;
        TriangleMesh mesh;
        std::vector<float> deviations_mm;
    };
    std::vector<Change> changes_;
};

}  // namespace tribo::session
