// SPDX-License-Identifier: MIT
// The bricks that a contour looks at.
#pragma once

#include <vector>

#include "field/carved/carved_field.hpp"

namespace tribo::field {

// Finds, layer by layer upwards, the bricks that the surface may pass through. The field must outlive it and
// stay as it is. Chunks of the field's index far from the blank's surface that no cut has come near are
// passed over whole.
class CandidateBricks {
  public:
    // Of the bricks from `first` on up to `last`, which is left out, in each coordinate.
    CandidateBricks(const CarvedField& field, BrickCoord first, BrickCoord last);

    // Appends those of layer `k`, which is not below that of the call before, by j, then by i.
    void append_layer(int k, std::vector<BrickCoord>& found);

  private:
    // What is known of all bricks of a chunk.
    struct Chunk {
        bool calm = false;   // neither in it nor around it anything is carved
        bool clear = false;  // and the surface of the blank is far
    };
    void look_at_chunks(int k);
    bool untouched_around(BrickCoord b) const;

    const CarvedField& field_;
    BrickCoord first_, last_;
    double radius_mm_;  // from a brick's middle, what its nodes and their neighbours reach
    std::vector<Chunk> chunks_;
    int chunks_i_, chunk_layer_ = -1;
};

}  // namespace tribo::field
