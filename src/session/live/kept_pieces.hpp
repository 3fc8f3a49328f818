// SPDX-License-Identifier: MIT
// Pieces of a picture that are likely to be shown again, as many as fit into a bound.
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <map>
#include <utility>

namespace tribo::session {

// By chunk and state. Those that were not used for the longest time go first.
template <class Piece>
class KeptPieces {
  public:
    using Key = std::pair<std::size_t, std::uint64_t>;

    static constexpr std::size_t kMostBytes = std::size_t{64} << 20;

    // Null: not kept. Valid until the next call.
    const Piece* find(const Key& key) {
        const auto kept = kept_.find(key);
        if (kept == kept_.end()) return nullptr;
        by_use_.splice(by_use_.begin(), by_use_, kept->second.use);
        return &kept->second.piece;
    }

    void put(const Key& key, Piece piece, std::size_t bytes) {
        drop(key);
        by_use_.push_front(key);
        kept_.emplace(key, Kept{std::move(piece), bytes, by_use_.begin()});
        bytes_ += bytes;
        while (bytes_ > kMostBytes) drop(Key(by_use_.back()));
    }

    void drop(const Key& key) {
        const auto kept = kept_.find(key);
        if (kept == kept_.end()) return;
        bytes_ -= kept->second.bytes;
        by_use_.erase(kept->second.use);
        kept_.erase(kept);
    }

    std::size_t bytes() const { return bytes_; }
    std::size_t count() const { return kept_.size(); }

  private:
    struct Kept {
        Piece piece;
        std::size_t bytes = 0;
        typename std::list<Key>::iterator use;
    };
    std::map<Key, Kept> kept_;
    std::list<Key> by_use_;  // the newest first
    std::size_t bytes_ = 0;
};

}  // namespace tribo::session
