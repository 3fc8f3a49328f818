// SPDX-License-Identifier: MIT
// The bricks that a contour examines.
#pragma once

#include <vector>

#include "field/carved/carved_field.hpp"

namespace tribo::field {

// Finds, layer by layer upwards, the bricks that the surface may pass through. The field must outlive this
// object and must not change. Whole chunks of the index are skipped if they are far from the surface of the
// blank and from all cuts.
class CandidateBricks {
  public:
    // The bricks from `first` up to `last` (excluded) in each coordinate.
    CandidateBricks(const CarvedField& field, BrickCoord first, BrickCoord last);

    // Appends the bricks of layer `k`, sorted by j, then by i. `k` must not be below the layer of the last
    // call.
    void append_layer(int k, std::vector<BrickCoord>& found);

  private:
    // Properties of all bricks of a chunk.
    struct Chunk {
        bool calm = false;   // nothing is carved in it or next to it
        bool clear = false;  // calm, and far from the surface of the blank
    };
    void look_at_chunks(int k);
    bool untouched_around(BrickCoord b) const;

    const CarvedField& field_;
    BrickCoord first_, last_;
    double radius_mm_;  // reach of the nodes of a brick and of their neighbours, from its middle
    std::vector<Chunk> chunks_;
    int chunks_i_, chunk_layer_ = -1;
};

}  // namespace tribo::field
