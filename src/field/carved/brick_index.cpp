// SPDX-License-Identifier: MIT
#include "field/carved/brick_index.hpp"

namespace tribo::field {

BrickIndex::BrickIndex(BrickCoord size) {
    const auto chunks = [](int bricks) {
        return static_cast<std::size_t>((bricks + kChunkEdge - 1) / kChunkEdge);
    };
    chunks_.resize(chunks(size.i) * chunks(size.j) * chunks(size.k));
    table_ = {size, chunks(size.i), chunks(size.j), chunks_.data()};
}

BrickIndex::~BrickIndex() {
    for (BrickChunk* chunk : chunks_) delete chunk;
}

std::unique_ptr<BrickChunk> BrickIndex::set(BrickCoord b, BrickRef ref, Version version) {
    BrickChunk*& chunk = chunks_[table_.chunk_number(b)];
    std::unique_ptr<BrickChunk> old;
    if (chunk == nullptr) {
        chunk = std::make_unique<BrickChunk>().release();
        ++touched_;
    } else if (chunk->version < version) {
        old.reset(chunk);
        chunk = std::make_unique<BrickChunk>(*old).release();
    }
    chunk->version = version;
    chunk->refs[BrickTable::place(b)] = ref;
    return old;
}

BrickRef BrickPool::take(BrickCoord coord) {
    if (free_.empty()) {
        const auto first = static_cast<BrickRef>(bricks_.grow(kPage)) + kFirstBrick;
        for (std::size_t n = kPage; n-- > 0;) free_.push_back(first + static_cast<BrickRef>(n));
    }
    const BrickRef ref = free_.back();
    free_.pop_back();
    ++used_;
    (*this)[ref].coord = coord;
    return ref;
}

void BrickPool::give_back(BrickRef ref) {
    (*this)[ref].shapes.clear();
    free_.push_back(ref);
    --used_;
}

}  // namespace tribo::field
