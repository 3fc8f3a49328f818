// SPDX-License-Identifier: MIT
// States of the stock along a program, to go back to. They lie evenly by the work that carving takes, and
// farther apart once they fill their memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "field/carved/carved_field.hpp"

namespace tribo::session {

class KeptStates {
  public:
    // Memory of the states of a session that is shown.
    static constexpr std::size_t kMostBytes = std::size_t{192} << 20;
    // Some hundredths of a second of carving.
    static constexpr std::uint64_t kSpacing = 1'000;

    // Keeps the state of the stock before the first move. `spacing`: changes of bricks between two states.
    KeptStates(const field::CarvedField& stock, std::size_t most_bytes, std::uint64_t spacing = kSpacing);

    // Call this after each few moves, from any state on. Keeps the state of the stock after `moves` moves if
    // enough was carved since the one before.
    void offer(const field::CarvedField& stock, std::size_t moves);
    // Moves of the last state that has at most `moves` of them.
    std::size_t last(std::size_t moves) const { return before(moves).moves; }
    // Puts the stock into this state.
    void restore(field::CarvedField& stock, std::size_t moves);

    std::size_t bytes() const { return bytes_; }
    std::size_t count() const { return states_.size(); }

  private:
    struct Kept {
        std::size_t moves = 0;
        std::uint64_t work = 0;  // changes of bricks from the first state on
        field::FieldState stock;
    };
    const Kept& before(std::size_t moves) const;
    void thin_out();

    std::size_t most_bytes_, bytes_ = 0;
    std::uint64_t spacing_;
    std::uint64_t idle_ = 0;    // CarvedField::brick_updates() less the work of the stock
    std::vector<Kept> states_;  // by moves; never empty
};

}  // namespace tribo::session
