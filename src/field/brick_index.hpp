// SPDX-License-Identifier: MIT
// Where each brick of a box stands: a dense table of chunks (8 x 8 x 8 bricks) that exist only once touched.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "field/brick.hpp"

namespace tribo::field {

// What is known of a brick. Numbers from kFirstBrick on are slots of a pool.
using BrickRef = std::uint32_t;
inline constexpr BrickRef kUntouched = 0;  // the blank alone says what is there
inline constexpr BrickRef kAir = 1;        // nothing left
inline constexpr BrickRef kFirstBrick = 2;

inline constexpr int kChunkEdge = 8;

class BrickIndex {
  public:
    // Bricks from (0, 0, 0) to size - 1.
    explicit BrickIndex(BrickCoord size);

    BrickCoord size() const { return size_; }
    bool contains(BrickCoord b) const {
        return b.i >= 0 && b.j >= 0 && b.k >= 0 && b.i < size_.i && b.j < size_.j && b.k < size_.k;
    }
    // Bricks counted along i, then j, then k. b must be contained.
    std::uint64_t number(BrickCoord b) const {
        const auto along = [](int n) { return static_cast<std::uint64_t>(n); };
        return along(b.i) + along(size_.i) * (along(b.j) + along(size_.j) * along(b.k));
    }
    BrickCoord coord(std::uint64_t number) const {
        const auto i = static_cast<std::uint64_t>(size_.i), j = static_cast<std::uint64_t>(size_.j);
        return {static_cast<int>(number % i), static_cast<int>(number / i % j),
                static_cast<int>(number / i / j)};
    }
    // b must be contained.
    BrickRef get(BrickCoord b) const {
        const Chunk* chunk = chunks_[chunk_number(b)].get();
        return chunk ? chunk->refs[place(b)] : kUntouched;
    }
    void set(BrickCoord b, BrickRef ref);
    std::size_t bytes() const { return chunks_.size() * sizeof(chunks_[0]) + touched_ * sizeof(Chunk); }

  private:
    struct Chunk {
        BrickRef refs[kChunkEdge * kChunkEdge * kChunkEdge] = {};
    };
    std::size_t chunk_number(BrickCoord b) const {
        return static_cast<std::size_t>(b.i / kChunkEdge) +
               chunks_i_ * (static_cast<std::size_t>(b.j / kChunkEdge) +
                            chunks_j_ * static_cast<std::size_t>(b.k / kChunkEdge));
    }
    static std::size_t place(BrickCoord b) {
        return static_cast<std::size_t>(b.i % kChunkEdge +
                                        kChunkEdge * (b.j % kChunkEdge + kChunkEdge * (b.k % kChunkEdge)));
    }

    BrickCoord size_;
    std::size_t chunks_i_ = 0, chunks_j_ = 0, touched_ = 0;
    std::vector<std::unique_ptr<Chunk>> chunks_;
};

// Bricks by slot, with stable addresses; freed slots are used again.
class BrickPool {
  public:
    BrickRef take(BrickCoord coord);
    void give_back(BrickRef ref);
    Brick& operator[](BrickRef ref) {
        return pages_[(ref - kFirstBrick) / kPage][(ref - kFirstBrick) % kPage];
    }
    const Brick& operator[](BrickRef ref) const {
        return pages_[(ref - kFirstBrick) / kPage][(ref - kFirstBrick) % kPage];
    }
    std::size_t in_use() const { return used_; }
    std::size_t bytes() const { return pages_.size() * kPage * sizeof(Brick); }

  private:
    static constexpr std::size_t kPage = 64;
    std::vector<std::unique_ptr<Brick[]>> pages_;
    std::vector<BrickRef> free_;
    std::size_t used_ = 0;
};

}  // namespace tribo::field
