// SPDX-License-Identifier: MIT
// The hand-over of a carved field's states from the thread that carves to one that reads, and what is kept
// for the reader until it has moved on.
#pragma once

#include <memory>
#include <vector>

#include "base/hand_over.hpp"
#include "field/carved/field_query.hpp"

namespace tribo::field {

// One state: tables of which nothing changes.
struct ShownField {
    Version version = 0;
    FieldQuery query;
    std::vector<const BrickChunk*> chunks;  // what query.bricks looks at
};

// The carver shows, the reader takes; both at any time, without waiting (one exchange of a pointer each). All
// but take() is the carver's.
class FieldShow {
  public:
    // Bricks and chunks of versions up to this are shown: changed only as copies.
    Version shown() const { return shown_; }
    // Shows the field as it is now. `pool` gets back the bricks that nobody can see any more.
    void show(const FieldQuery& query, const std::vector<BrickChunk*>& chunks, BrickPool& pool);
    // What the field no longer uses, but a reader may.
    void retire(BrickRef ref) { bricks_.push_back({ref, shown_ + 1}); }
    void retire(std::unique_ptr<BrickChunk> chunk) {
        if (chunk) chunks_.push_back({std::move(chunk), shown_ + 1});
    }
    // Gives everything back; the reader has left.
    void close(BrickPool& pool);

    // The newest state that was not taken yet, or null. By taking, the reader lets go of the one before.
    const ShownField* take();

  private:
    struct OldBrick {
        BrickRef ref;
        Version gone;  // the first version that it is not in
    };
    struct OldChunk {
        std::unique_ptr<BrickChunk> chunk;
        Version gone;
    };
    bool is_seen(Version made, Version gone) const;
    void reclaim(BrickPool& pool);

    HandOver<const ShownField> way_;  // the reader counts by version
    Version shown_ = 0;
    std::vector<std::unique_ptr<ShownField>> states_;  // that the reader holds or may take, oldest first
    std::vector<OldBrick> bricks_;
    std::vector<OldChunk> chunks_;
};

}  // namespace tribo::field
