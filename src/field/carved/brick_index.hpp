// SPDX-License-Identifier: MIT
// The position of each brick of a box: a dense table of chunks (8 x 8 x 8 bricks). A chunk exists only once
// it is touched.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "field/carved/brick.hpp"
#include "field/carved/steady_array.hpp"

namespace tribo::field {

// State of a brick. Numbers from kFirstBrick on are slots of a pool.
using BrickRef = std::uint32_t;
inline constexpr BrickRef kUntouched = 0;  // the blank alone defines it
inline constexpr BrickRef kAir = 1;        // nothing left
inline constexpr BrickRef kFirstBrick = 2;

inline constexpr int kChunkEdge = 8;

struct BrickChunk {
    BrickRef refs[kChunkEdge * kChunkEdge * kChunkEdge] = {};
    Version version = 0;
};

// View of the chunks of a box; another object owns the tables.
struct BrickTable {
    BrickCoord size;  // bricks from (0, 0, 0) to size - 1
    std::size_t chunks_i = 0, chunks_j = 0;
    const BrickChunk* const* chunks = nullptr;  // null: untouched

    bool contains(BrickCoord b) const {  // coordinates below 0 become large numbers
        const auto along = [](int n) { return static_cast<unsigned>(n); };
        return along(b.i) < along(size.i) && along(b.j) < along(size.j) && along(b.k) < along(size.k);
    }
    // b must be contained.
    BrickRef get(BrickCoord b) const {
        const BrickChunk* chunk = chunks[chunk_number(b)];
        return chunk ? chunk->refs[place(b)] : kUntouched;
    }
    bool is_untouched_chunk(BrickCoord b) const { return !chunks[chunk_number(b)]; }
    std::size_t chunk_number(BrickCoord b) const {
        const auto along = [](int n) { return static_cast<std::size_t>(static_cast<unsigned>(n) / kEdge); };
        return along(b.i) + chunks_i * (along(b.j) + chunks_j * along(b.k));
    }
    static std::size_t place(BrickCoord b) {
        const auto along = [](int n) { return static_cast<unsigned>(n) % kEdge; };
        return along(b.i) + kEdge * (along(b.j) + kEdge * along(b.k));
    }
    // The brick at a place of a chunk; it may lie beyond the box.
    BrickCoord coord(std::size_t chunk, std::size_t at) const {
        const auto along = [](std::size_t chunks, std::size_t bricks) {
            return static_cast<int>(kEdge * chunks + bricks);
        };
        return {along(chunk % chunks_i, at % kEdge), along(chunk / chunks_i % chunks_j, at / kEdge % kEdge),
                along(chunk / chunks_i / chunks_j, at / kEdge / kEdge)};
    }
    static constexpr unsigned kEdge = kChunkEdge;  // unsigned numbers are divided by a shift
};

class BrickIndex {
  public:
    // Bricks from (0, 0, 0) to size - 1.
    explicit BrickIndex(BrickCoord size);
    BrickIndex(const BrickIndex&) = delete;
    BrickIndex& operator=(const BrickIndex&) = delete;
    ~BrickIndex();

    BrickCoord size() const { return table_.size; }
    bool contains(BrickCoord b) const { return table_.contains(b); }
    // Bricks counted along i, then j, then k. b must be contained.
    std::uint64_t number(BrickCoord b) const {
        const auto along = [](int n) { return static_cast<std::uint64_t>(n); };
        return along(b.i) + along(size().i) * (along(b.j) + along(size().j) * along(b.k));
    }
    BrickCoord coord(std::uint64_t number) const {
        const auto i = static_cast<std::uint64_t>(size().i), j = static_cast<std::uint64_t>(size().j);
        return {static_cast<int>(number % i), static_cast<int>(number / i % j),
                static_cast<int>(number / i / j)};
    }
    // b must be contained.
    BrickRef get(BrickCoord b) const { return table_.get(b); }
    // Chunks older than `version` stay unchanged and are returned; a copy is changed instead. Returns null if
    // no chunk was replaced.
    std::unique_ptr<BrickChunk> set(BrickCoord b, BrickRef ref, Version version = 0);
    // Valid as long as the index lives.
    const BrickTable& table() const { return table_; }
    // The chunks, in the order of the table.
    const std::vector<BrickChunk*>& chunks() const { return chunks_; }
    std::size_t bytes() const { return chunks_.size() * sizeof(chunks_[0]) + touched_ * sizeof(BrickChunk); }

  private:
    BrickTable table_;
    std::size_t touched_ = 0;
    std::vector<BrickChunk*> chunks_;  // owned
};

// Bricks by slot, with stable addresses. Freed slots are reused.
class BrickPool {
  public:
    BrickRef take(BrickCoord coord);
    void give_back(BrickRef ref);
    Brick& operator[](BrickRef ref) { return bricks_[ref - kFirstBrick]; }
    const Brick& operator[](BrickRef ref) const { return bricks_[ref - kFirstBrick]; }
    std::size_t in_use() const { return used_; }
    std::size_t bytes() const { return bricks_.bytes(); }

  private:
    static constexpr std::size_t kPage = 64;
    SteadyArray<Brick, kPage> bricks_;
    std::vector<BrickRef> free_;
    std::size_t used_ = 0;
};

}  // namespace tribo::field
