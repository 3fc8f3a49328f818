// SPDX-License-Identifier: MIT
#include "field/contour/contour_candidates.hpp"

#include <algorithm>
#include <cmath>

namespace tribo::field {
namespace {

// Returns true if `visit` returns true for a brick and for the existing bricks `step` bricks around it.
template <class Visit>
bool all_around(const CarvedField& field, BrickCoord b, int step, const Visit& visit) {
    for (int k = b.k - step; k <= b.k + step; k += step) {
        for (int j = b.j - step; j <= b.j + step; j += step) {
            for (int i = b.i - step; i <= b.i + step; i += step) {
                if (field.contains({i, j, k}) && !visit(BrickCoord{i, j, k})) return false;
            }
        }
    }
    return true;
}

}  // namespace

CandidateBricks::CandidateBricks(const CarvedField& field, BrickCoord first, BrickCoord last)
    : field_(field),
      first_(first),
      last_(last),
      radius_mm_(field.brick_radius_mm() + field.cell_mm()),
      chunks_i_((field.size().i + kChunkEdge - 1) / kChunkEdge) {}

bool CandidateBricks::untouched_around(BrickCoord b) const {
    return all_around(field_, b, 1, [&](BrickCoord at) { return field_.ref(at) == kUntouched; });
}

void CandidateBricks::look_at_chunks(int k) {
    if (k / kChunkEdge == chunk_layer_) return;
    chunk_layer_ = k / kChunkEdge;
    const int chunks_j = (field_.size().j + kChunkEdge - 1) / kChunkEdge;
    chunks_.assign(static_cast<std::size_t>(chunks_i_) * static_cast<std::size_t>(chunks_j), {});
    // From the middle of a chunk to the middles of its bricks, with a margin for rounding.
    const double far = radius_mm_ + kChunkEdge * field_.brick_radius_mm();
    for (int j = first_.j / kChunkEdge; j * kChunkEdge < last_.j; ++j) {
        for (int i = first_.i / kChunkEdge; i * kChunkEdge < last_.i; ++i) {
            const BrickCoord low{i * kChunkEdge, j * kChunkEdge, chunk_layer_ * kChunkEdge};
            const bool calm = all_around(field_, low, kChunkEdge,
                                         [&](BrickCoord at) { return field_.is_untouched_chunk(at); });
            if (!calm) continue;
            constexpr int kHalf = kChunkEdge / 2;
            const Lattice middle = field_.lattice({low.i + kHalf, low.j + kHalf, low.k + kHalf});
            chunks_[static_cast<std::size_t>(i + chunks_i_ * j)] = {
                true, std::abs(field_.blank().distance_mm(middle.node(0, 0, 0))) > far};
        }
    }
}

void CandidateBricks::append_layer(int k, std::vector<BrickCoord>& found) {
    look_at_chunks(k);
    for (int j = first_.j; j < last_.j; ++j) {
        const Chunk* row = &chunks_[static_cast<std::size_t>(chunks_i_ * (j / kChunkEdge))];
        for (int i = first_.i; i < last_.i; ++i) {
            const Chunk& chunk = row[i / kChunkEdge];
            if (chunk.clear) {
                i |= kChunkEdge - 1;
                continue;
            }
            const BrickCoord b{i, j, k};
            const BrickRef ref = field_.ref(b);
            if (ref == kAir) continue;
            if (ref == kUntouched && (chunk.calm || untouched_around(b)) &&
                std::abs(field_.blank().distance_mm(field_.centre(b))) > radius_mm_)
                continue;
            found.push_back(b);
        }
    }
}

}  // namespace tribo::field
