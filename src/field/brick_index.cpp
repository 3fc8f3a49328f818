// SPDX-License-Identifier: MIT
#include "field/brick_index.hpp"

namespace tribo::field {

BrickIndex::BrickIndex(BrickCoord size) : size_(size) {
    const auto chunks = [](int bricks) {
        return static_cast<std::size_t>((bricks + kChunkEdge - 1) / kChunkEdge);
    };
    chunks_i_ = chunks(size.i);
    chunks_j_ = chunks(size.j);
    chunks_.resize(chunks_i_ * chunks_j_ * chunks(size.k));
}

void BrickIndex::set(BrickCoord b, BrickRef ref) {
    std::unique_ptr<Chunk>& chunk = chunks_[chunk_number(b)];
    if (!chunk) {
        chunk = std::make_unique<Chunk>();
        ++touched_;
    }
    chunk->refs[place(b)] = ref;
}

BrickRef BrickPool::take(BrickCoord coord) {
    if (free_.empty()) {
        const auto first = static_cast<BrickRef>(pages_.size() * kPage) + kFirstBrick;
        pages_.push_back(std::make_unique_for_overwrite<Brick[]>(kPage));
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
