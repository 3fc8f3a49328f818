// SPDX-License-Identifier: MIT
// The stock at a time of the program, for a servo that touches the part while it is milled.
#pragma once

#include <memory>

#include "session/cut/mill_session.hpp"

namespace tribo::session {

// One thread mills. One other thread (the servo) uses reader(). Neither waits for the other.
class StockAtTime {
  public:
    // Mills up to `start_s` of the program. Moves should be short (MillOptions::longest_piece_mm): the
    // material of a move is removed when the move begins.
    StockAtTime(MillSetup setup, ParallelFor parallel, double start_s);

    // Continues milling up to this program time.
    void advance(double program_s);
    // The part for the servo. Call refresh(), then query.
    field::FieldReader& reader() { return *reader_; }

  private:
    MillSession session_;
    std::unique_ptr<field::FieldReader> reader_;  // destroyed before the session
};

}  // namespace tribo::session
