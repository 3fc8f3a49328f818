// SPDX-License-Identifier: MIT
#include "field/carved/field_show.hpp"

#include <algorithm>

namespace tribo::field {

void FieldShow::show(const FieldQuery& query, const std::vector<BrickChunk*>& chunks, BrickPool& pool) {
    auto state = std::make_unique<ShownField>();
    state->version = ++shown_;
    state->query = query;
    state->chunks.assign(chunks.begin(), chunks.end());
    state->query.bricks.chunks = state->chunks.data();
    const ShownField* missed = way_.post(state.get());
    // The reader no longer uses any state before the one that it reads. It will never read a state that it
    // missed.
    const Version reading = way_.progress();
    std::erase_if(states_, [&](const std::unique_ptr<ShownField>& s) {
        return s.get() == missed || s->version < reading;
    });
    states_.push_back(std::move(state));
    reclaim(pool);
}

const ShownField* FieldShow::take() {
    const ShownField* state = way_.take();
    if (state != nullptr) way_.reached(state->version);
    return state;
}

bool FieldShow::is_seen(Version made, Version gone) const {
    return std::any_of(states_.begin(), states_.end(), [&](const std::unique_ptr<ShownField>& s) {
        return made <= s->version && s->version < gone;
    });
}

void FieldShow::reclaim(BrickPool& pool) {
    std::erase_if(bricks_, [&](const OldBrick& old) {
        if (is_seen(pool[old.ref].version, old.gone)) return false;
        pool.give_back(old.ref);
        return true;
    });
    std::erase_if(chunks_, [&](const OldChunk& old) { return !is_seen(old.chunk->version, old.gone); });
}

void FieldShow::close(BrickPool& pool) {
    (void)way_.take();
    states_.clear();
    reclaim(pool);
}

}  // namespace tribo::field
