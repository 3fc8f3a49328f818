// SPDX-License-Identifier: MIT
// A part that is milled at the pace of a hand's clock, for a servo to touch meanwhile.
#pragma once

#include <memory>

#include "session/cut/mill_session.hpp"

namespace tribo::session {

// One thread mills (all but reader()'s users), one feels; neither waits for the other.
class StockInTime {
  public:
    // Milled up to `start_s` of the program. Moves should be short (MillOptions::longest_piece_mm): a move's
    // material goes when the move begins.
    StockInTime(MillSetup setup, ParallelFor parallel, double start_s);

    // Mills on up to this moment of the program.
    void advance(double program_s);
    // The part as the servo sees it: refresh(), then ask.
    field::FieldReader& reader() { return *reader_; }

  private:
    MillSession session_;
    std::unique_ptr<field::FieldReader> reader_;  // goes before the session
};

}  // namespace tribo::session
