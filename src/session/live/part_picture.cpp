// SPDX-License-Identifier: MIT
#include "session/live/part_picture.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "base/hash.hpp"
#include "field/contour/contour.hpp"
#include "protocol/live_frame.hpp"
#include "session/cut/stock_faces.hpp"
#include "surface/deviation.hpp"

namespace tribo::session {
namespace {

using field::BrickCoord;

// State of a chunk that was not examined yet.
constexpr std::uint64_t kUnseen = 0;
// A chunk that changes after fewer updates was under the tool, and is not kept; but where the clock jumped.
constexpr std::uint64_t kSettled = 30;

std::size_t bytes_of(const PartPicture::Piece& piece) {
    return piece.mesh.positions.size() * sizeof(piece.mesh.positions[0]) +
           piece.mesh.triangles.size() * sizeof(piece.mesh.triangles[0]) +
           piece.deviations_mm.size() * sizeof(float);
}

// Chunks between two checks of the time: a few milliseconds each where deviations are searched.
constexpr std::size_t kChunksAtOnce = 8;
// Rough chunks that one update makes exact: tens of milliseconds at most, in which no jump is heard.
constexpr std::size_t kExactAtOnce = 2;

ChunkCoord chunk_of(BrickCoord b) {
    return {b.i / kChunkBricks, b.j / kChunkBricks, b.k / kChunkBricks};
}

BrickCoord first_brick(ChunkCoord c) {
    return {c.i * kChunkBricks, c.j * kChunkBricks, c.k * kChunkBricks};
}

// Puts the vertices on the surface of the blank before the others and returns their number.
std::uint32_t put_first(TriangleMesh& mesh, const field::Shape& blank) {
    const auto count = static_cast<std::uint32_t>(mesh.positions.size());
    std::vector<Point3f> positions, others;
    std::vector<std::uint32_t> place(count);
    const std::vector<std::uint8_t> on_blank = vertices_on_blank(mesh, blank, serial_for);
    for (std::uint32_t v = 0; v < count; ++v) {
        std::vector<Point3f>& part = on_blank[v] != 0 ? positions : others;
        place[v] = static_cast<std::uint32_t>(part.size());
        part.push_back(mesh.positions[v]);
    }
    const auto first = static_cast<std::uint32_t>(positions.size());
    for (std::uint32_t v = 0; v < count; ++v)
        if (on_blank[v] == 0) place[v] += first;
    positions.insert(positions.end(), others.begin(), others.end());
    mesh.positions = std::move(positions);
    for (Triangle& t : mesh.triangles) {
        for (std::uint32_t& v : t) v = place[v];
    }
    return first;
}

}  // namespace

PartPicture::PartPicture(const field::CarvedField& field, ParallelFor parallel,
                         std::shared_ptr<const surface::DesignedSurface> designed)
    : field_(field), parallel_(std::move(parallel)), designed_(std::move(designed)) {
    const BrickCoord n = field.size();
    const ChunkCoord last = chunk_of({n.i - 1, n.j - 1, n.k - 1});
    size_ = {last.i + 1, last.j + 1, last.k + 1};
    shown_.assign(static_cast<std::size_t>(size_.i) * static_cast<std::size_t>(size_.j) *
                      static_cast<std::size_t>(size_.k),
                  kUnseen);
    shown_since_.assign(shown_.size(), 0);
    is_marked_.assign(shown_.size(), false);
    is_rough_.assign(shown_.size(), false);
}

Box3 PartPicture::all() const {
    return field_.blank().bounds_mm();
}

double PartPicture::step_mm() const {
    // Vertices lie in the cells beside their bricks at most, those of rough pieces in larger ones.
    const double edge_mm = (kChunkBricks + 2) * field::kBrickCells * field_.cell_mm();
    const Box3 box = all().inflated(edge_mm);
    double farthest = 0;
    for (int axis = 0; axis < 3; ++axis)
        farthest = std::max({farthest, std::abs(box.min[axis]), std::abs(box.max[axis])});
    return protocol::step_of_chunks_mm(edge_mm, farthest);
}

std::size_t PartPicture::number(ChunkCoord c) const {
    return static_cast<std::size_t>(c.i) +
           static_cast<std::size_t>(size_.i) *
               (static_cast<std::size_t>(c.j) +
                static_cast<std::size_t>(size_.j) * static_cast<std::size_t>(c.k));
}

std::uint64_t PartPicture::state(ChunkCoord chunk) const {
    // The state depends on the volume of the bricks: a cut that moves their surface removes volume. The
    // contour also uses the bricks one before the chunk.
    const BrickCoord first = first_brick(chunk), size = field_.size();
    Hash hash;
    for (int k = std::max(first.k - 1, 0); k < std::min(first.k + kChunkBricks, size.k); ++k) {
        for (int j = std::max(first.j - 1, 0); j < std::min(first.j + kChunkBricks, size.j); ++j) {
            for (int i = std::max(first.i - 1, 0); i < std::min(first.i + kChunkBricks, size.i); ++i) {
                const field::BrickRef ref = field_.ref({i, j, k});
                const double volume =
                    ref >= field::kFirstBrick ? field_.brick(ref).volume_mm3 : (ref == field::kAir ? -2 : -1);
                hash.add(volume);
            }
        }
    }
    return hash.value() | 1;
}

void PartPicture::mark(const Box3& box_mm) {
    if (box_mm.empty()) return;
    const BrickCoord n = field_.size();
    const auto inside = [&](BrickCoord b) {
        return BrickCoord{std::clamp(b.i, 0, n.i - 1), std::clamp(b.j, 0, n.j - 1),
                          std::clamp(b.k, 0, n.k - 1)};
    };
    const ChunkCoord first = chunk_of(inside(field_.brick_at(box_mm.min)));
    // The contour of a chunk uses the bricks before it, so a cut also changes the chunk after it.
    BrickCoord after = field_.brick_at(box_mm.max);
    ++after.i, ++after.j, ++after.k;
    const ChunkCoord last = chunk_of(inside(after));
    for (int k = first.k; k <= last.k; ++k) {
        for (int j = first.j; j <= last.j; ++j) {
            for (int i = first.i; i <= last.i; ++i) {
                if (is_marked_[number({i, j, k})]) continue;
                is_marked_[number({i, j, k})] = true;
                marked_.push_back({i, j, k});
            }
        }
    }
}

void PartPicture::update(const std::function<bool()>& has_time, const Show& show, bool jumped) {
    ++updates_;
    const bool stands = marked_.empty();
    while (!marked_.empty()) {
        find_changes(jumped);
        show_changes(show);
        if (!has_time()) return;
    }
    if (jumped && !stands) return;
    find_rough();
    show_changes(show);
}

void PartPicture::find_changes(bool rough) {
    while (!marked_.empty() && changes_.size() < kChunksAtOnce) {
        const ChunkCoord chunk = marked_.front();
        marked_.pop_front();
        is_marked_[number(chunk)] = false;
        const std::uint64_t now = state(chunk);
        std::uint64_t& shown = shown_[number(chunk)];
        if (now == shown) continue;
        std::uint64_t& since = shown_since_[number(chunk)];
        if (!rough && updates_ - since < kSettled) kept_.drop({number(chunk), shown});
        since = updates_;
        changes_.push_back({chunk, shown != kUnseen, now, false, {}});
        changes_.back().piece.rough = rough;
        shown = now;
    }
}

void PartPicture::find_rough() {
    while (!drawn_roughly_.empty() && changes_.size() < kExactAtOnce) {
        const ChunkCoord chunk = drawn_roughly_.front();
        drawn_roughly_.pop_front();
        if (is_rough_[number(chunk)]) changes_.push_back({chunk, true, shown_[number(chunk)], false, {}});
    }
}

void PartPicture::show_changes(const Show& show) {
    for (Change& change : changes_) {
        const Piece* kept = kept_.find({number(change.chunk), change.state});
        change.found = kept != nullptr && (change.piece.rough || !kept->rough);
        if (change.found) change.piece = *kept;
    }
    parallel_(changes_.size(), [&](std::size_t n) {
        Change& change = changes_[n];
        if (change.found) return;
        const BrickCoord from = first_brick(change.chunk);
        Piece& piece = change.piece;
        field::ContourOptions options;
        options.rough = piece.rough;
        piece.mesh = field::contour_part(
            field_, from, {from.i + kChunkBricks, from.j + kChunkBricks, from.k + kChunkBricks}, options);
        piece.on_blank = put_first(piece.mesh, field_.blank());
        if (designed_ && piece.rough)
            piece.deviations_mm.assign(piece.mesh.positions.size(), std::numeric_limits<float>::quiet_NaN());
        if (designed_ && !piece.rough)
            piece.deviations_mm = surface::deviations_of(piece.mesh, *designed_, serial_for, kReachMm);
    });
    for (Change& c : changes_) {
        const std::size_t at = number(c.chunk);
        if (c.piece.rough && !is_rough_[at]) drawn_roughly_.push_back(c.chunk);
        is_rough_[at] = c.piece.rough;
        if (!c.found) {
            ++contours_;
            kept_.put({number(c.chunk), c.state}, c.piece, bytes_of(c.piece));
        }
        if (c.was_seen || !c.piece.mesh.triangles.empty()) show(c.chunk, std::move(c.piece));
    }
    changes_.clear();
}

}  // namespace tribo::session
