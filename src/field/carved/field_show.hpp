// SPDX-License-Identifier: MIT
// Hands the states of a carved field from the carving thread to a reading thread, and keeps the old data
// until the reader no longer uses it.
#pragma once

#include <memory>
#include <vector>

#include "base/hand_over.hpp"
#include "field/carved/field_query.hpp"

namespace tribo::field {

// One state: its tables never change.
struct ShownField {
    Version version = 0;
    FieldQuery query;
    std::vector<const BrickChunk*> chunks;  // the chunks of query.bricks
};

// The carver shows states, the reader takes them; both at any time, without waiting (one exchange of a
// pointer each). Only take() is for the reader; all other functions are for the carver.
class FieldShow {
  public:
    // Bricks and chunks of versions up to this one are shown: change only copies of them.
    Version shown() const { return shown_; }
    // Shows the present state of the field. Returns to `pool` the bricks that no reader can see any more.
    void show(const FieldQuery& query, const std::vector<BrickChunk*>& chunks, BrickPool& pool);
    // Stores data that the field no longer uses but a reader may use.
    void retire(BrickRef ref) { bricks_.push_back({ref, shown_ + 1}); }
    void retire(std::unique_ptr<BrickChunk> chunk) {
        if (chunk) chunks_.push_back({std::move(chunk), shown_ + 1});
    }
    // Returns everything to the pool; call it after the reader has left.
    void close(BrickPool& pool);

    // Returns the newest state that was not taken yet, or null. The reader then gives up the state before it.
    const ShownField* take();

  private:
    struct OldBrick {
        BrickRef ref;
        Version gone;  // the first version without this brick
    };
    struct OldChunk {
        std::unique_ptr<BrickChunk> chunk;
        Version gone;
    };
    bool is_seen(Version made, Version gone) const;
    void reclaim(BrickPool& pool);

    HandOver<const ShownField> way_;  // the reader counts by version
    Version shown_ = 0;
    std::vector<std::unique_ptr<ShownField>> states_;  // those that the reader holds or may take, by age
    std::vector<OldBrick> bricks_;
    std::vector<OldChunk> chunks_;
};

}  // namespace tribo::field
