// SPDX-License-Identifier: MIT
// The part as a picture that follows the cut: chunks of the surface, sent again when they change. Chunks that
// looked the same for a while are kept, so that a clock that goes back and forth finds them again. After a
// jump of the clock chunks are drawn roughly first, and exactly as soon as there is time.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <vector>

#include "base/mesh.hpp"
#include "base/parallel.hpp"
#include "field/carved/carved_field.hpp"
#include "session/live/kept_pieces.hpp"
#include "surface/designed_surface.hpp"

namespace tribo::session {

// Bricks along each edge of a chunk. Large enough that a part has some hundred chunks, small enough that a
// cut changes few of them.
inline constexpr int kChunkBricks = 4;

// In chunks, not bricks.
struct ChunkCoord {
    int i = 0, j = 0, k = 0;
};

// One thread at a time, never while the field is carved.
class PartPicture {
  public:
    // Largest distance at which deviations from the designed surface are searched.
    static constexpr double kReachMm = 3;
    // The surface of a chunk. Its first vertices, `on_blank` of them, lie on the surface of the blank.
    struct Piece {
        TriangleMesh mesh;
        // Of each vertex from the designed surface (surface::deviations_of), if there is one.
        std::vector<float> deviations_mm;
        std::uint32_t on_blank = 0;
        bool rough = false;  // its deviations are not known
    };
    using Show = std::function<void(ChunkCoord, Piece)>;

    // `field` must outlive this object.
    explicit PartPicture(const field::CarvedField& field, ParallelFor parallel = serial_for,
                         std::shared_ptr<const surface::DesignedSurface> designed = {});

    // The surface within this box may have changed. Cheap: update() does the work.
    void mark(const Box3& box_mm);
    // The box of the whole field.
    Box3 all() const;
    // The step of the vertices of all pieces as they are told (protocol::LiveChunk::step_mm).
    double step_mm() const;
    // Calls show for each marked chunk whose surface has changed since it was last shown, in the order of the
    // marks, while `has_time` is true (checked after every few chunks). An empty mesh means that the surface
    // is gone. Cost: a check of each marked chunk, and a contour of the changed ones.
    // `jumped`: the marked chunks are to be seen soon (ContourOptions::rough); later updates show them again,
    // a few each.
    void update(const std::function<bool()>& has_time, const Show& show, bool jumped = false);
    // Chunks are marked that update() has not reached yet.
    bool is_behind() const { return !marked_.empty(); }
    // Number of pieces that were made and not found again.
    std::size_t contours() const { return contours_; }

  private:
    void find_changes(bool rough);
    void find_rough();
    void show_changes(const Show& show);
    // Returns a hash of the bricks that the chunk is drawn from.
    std::uint64_t state(ChunkCoord chunk) const;
    std::size_t number(ChunkCoord chunk) const;

    const field::CarvedField& field_;
    ParallelFor parallel_;
    std::shared_ptr<const surface::DesignedSurface> designed_;
    ChunkCoord size_;
    std::vector<std::uint64_t> shown_;
    std::vector<std::uint64_t> shown_since_;  // number of the update
    std::uint64_t updates_ = 0;
    std::size_t contours_ = 0;
    KeptPieces<Piece> kept_;
    std::deque<ChunkCoord> marked_, drawn_roughly_;  // of the latter some are not rough any more
    std::vector<bool> is_marked_, is_rough_;
    struct Change {
        ChunkCoord chunk;
        bool was_seen = false;
        std::uint64_t state = 0;
        bool found = false;
        Piece piece;
    };
    std::vector<Change> changes_;
};

}  // namespace tribo::session
