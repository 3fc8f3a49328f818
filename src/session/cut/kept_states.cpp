// SPDX-License-Identifier: MIT
#include "session/cut/kept_states.hpp"

#include <algorithm>
#include <cassert>

namespace tribo::session {

KeptStates::KeptStates(const field::CarvedField& stock, std::size_t most_bytes, std::uint64_t spacing)
    : most_bytes_(most_bytes), spacing_(spacing), idle_(stock.brick_updates()) {
    states_.push_back({0, 0, stock.state()});
    bytes_ = own_bytes(states_.front().stock);
}

const KeptStates::Kept& KeptStates::before(std::size_t moves) const {
    const auto after = std::ranges::upper_bound(states_, moves, {}, &Kept::moves);
    assert(after != states_.begin());
    return *(after - 1);
}

void KeptStates::offer(const field::CarvedField& stock, std::size_t moves) {
    const std::uint64_t work = stock.brick_updates() - idle_;
    const auto after = std::ranges::upper_bound(states_, moves, {}, &Kept::moves);
    const Kept& last = *(after - 1);
    if (work < last.work + spacing_) return;
    if (after != states_.end() && after->work < work + spacing_) return;
    Kept kept{moves, work, stock.state(last.stock)};
    bytes_ += own_bytes(kept.stock);
    states_.insert(after, std::move(kept));
    while (bytes_ > most_bytes_ && states_.size() > 1) thin_out();
}

void KeptStates::thin_out() {
    spacing_ *= 2;
    for (std::size_t n = 1; n < states_.size();) {
        if (states_[n].work >= states_[n - 1].work + spacing_) {
            ++n;
            continue;
        }
        bytes_ -= own_bytes(states_[n].stock);
        states_.erase(states_.begin() + static_cast<std::ptrdiff_t>(n));
    }
}

void KeptStates::restore(field::CarvedField& stock, std::size_t moves) {
    const Kept& kept = before(moves);
    stock.restore(kept.stock);
    idle_ = stock.brick_updates() - kept.work;
}

}  // namespace tribo::session
