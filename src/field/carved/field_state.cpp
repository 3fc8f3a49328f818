// SPDX-License-Identifier: MIT
#include "field/carved/field_state.hpp"

#include <cassert>

#include "field/carved/carved_field.hpp"

namespace tribo::field {
namespace {

std::size_t bytes_of(const Brick& brick) {
    return sizeof(Brick) + brick.shapes.capacity() * sizeof(ShapeId) +
           brick.thin.capacity() * sizeof(Brick::Thin) + brick.winner.bytes_beside();
}

// `like`: the chunk at another moment, or null. Its bricks are shared where they are the same.
std::shared_ptr<const KeptChunk> kept_chunk(const BrickChunk& chunk, const BrickPool& pool,
                                            std::uint64_t change, const KeptChunk* like) {
    const auto kept = std::make_shared<KeptChunk>();
    kept->change = change;
    std::size_t next = 0;  // in like->places
    for (std::size_t place = 0; place < std::size(chunk.refs); ++place) {
        const auto at = static_cast<std::uint16_t>(place);
        const BrickRef ref = chunk.refs[place];
        if (ref == kUntouched) continue;
        if (ref == kAir) {
            kept->places.push_back({at, nullptr});
            continue;
        }
        while (like != nullptr && next < like->places.size() && like->places[next].at < at) ++next;
        const bool is_there = like != nullptr && next < like->places.size() && like->places[next].at == at;
        std::shared_ptr<const Brick> brick = is_there ? like->places[next].brick : nullptr;
        if (!brick || brick->change != pool[ref].change) brick = std::make_shared<const Brick>(pool[ref]);
        kept->places.push_back({at, std::move(brick)});
    }
    return kept;
}

}  // namespace

std::size_t own_bytes(const FieldState& state) {
    std::size_t bytes = state.chunks.size() * sizeof(state.chunks[0]);
    for (const auto& chunk : state.chunks) {
        if (!chunk || chunk.use_count() > 1) continue;
        bytes += sizeof(KeptChunk) + chunk->places.capacity() * sizeof(KeptChunk::Place);
        for (const KeptChunk::Place& place : chunk->places) {
            if (place.brick && place.brick.use_count() == 1) bytes += bytes_of(*place.brick);
        }
    }
    return bytes;
}

FieldState CarvedField::state(const FieldState& like) const {
    FieldState now{carved_, removed_, {}};
    const std::vector<BrickChunk*>& chunks = tables_->index.chunks();
    now.chunks.resize(chunks.size());
    for (std::size_t n = 0; n < chunks.size(); ++n) {
        if (chunks[n] == nullptr) continue;
        const std::shared_ptr<const KeptChunk> other = like.chunks.empty() ? nullptr : like.chunks[n];
        now.chunks[n] = other && other->change == chunk_changes_[n]
                            ? other
                            : kept_chunk(*chunks[n], tables_->pool, chunk_changes_[n], other.get());
    }
    return now;
}

void CarvedField::restore(const FieldState& state) {
    const std::vector<BrickChunk*>& chunks = tables_->index.chunks();
    assert(state.chunks.size() == chunks.size() && state.shapes < tables_->shapes.size());
    static const KeptChunk untouched;
    for (std::size_t n = 0; n < chunks.size(); ++n) {
        const KeptChunk& kept = state.chunks[n] ? *state.chunks[n] : untouched;
        if (chunk_changes_[n] == kept.change) continue;
        chunk_changes_[n] = kept.change;
        auto place = kept.places.begin();
        for (std::size_t at = 0; at < kChunkEdge * kChunkEdge * kChunkEdge; ++at) {
            const bool is_touched = place != kept.places.end() && place->at == at;
            restore(tables_->index.table().coord(n, at), is_touched,
                    is_touched ? place->brick.get() : nullptr);
            if (is_touched) ++place;
        }
    }
    carved_ = state.shapes;
    removed_ = state.removed_mm3;
    tables_->query.change = ++change_;
    if (showing_) show_->show(tables_->query, chunks, tables_->pool);
}

// `kept`: null for a brick of air, or one that is not touched.
void CarvedField::restore(BrickCoord coord, bool is_touched, const Brick* kept) {
    if (!contains(coord)) return;
    const BrickRef was = tables_->index.get(coord);
    if (kept == nullptr) {
        const BrickRef now = is_touched ? kAir : kUntouched;
        if (was == now) return;
        release(was);
        return point_to(coord, now);
    }
    if (was >= kFirstBrick && tables_->pool[was].change == kept->change) return;
    const BrickRef now = take_brick(coord);
    const Version version = tables_->pool[now].version;
    tables_->pool[now] = *kept;
    tables_->pool[now].version = version;
    release(was);
    point_to(coord, now);
}

}  // namespace tribo::field
