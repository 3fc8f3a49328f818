// SPDX-License-Identifier: MIT
// The lines of a program in the order in which they run, each with its moves and times. A row of a cut may
// belong to several lines, because short moves share rows.
#pragma once

#include <cstddef>
#include <optional>

#include "session/cut/mill_session.hpp"

namespace tribo::session {

// Neighbouring moves of one line and one tool.
struct LineRun {
    int line = 0;
    std::size_t first_move = 0, end_move = 0;  // of the setup; one behind the last
    double start_s = 0, end_s = 0;

    // The time that a row shares with it.
    double shared_s(const milling::CutRow& row) const;
};

// One thread. Setup and schedule must outlive it.
class LineRuns {
  public:
    LineRuns(const MillSetup& setup, const motion::Schedule& schedule) : setup_(setup), schedule_(schedule) {}

    // The next one; none at the end of the program, and none that begins at `before_s` or later.
    std::optional<LineRun> next(double before_s);

  private:
    const MillSetup& setup_;
    const motion::Schedule& schedule_;
    std::size_t move_ = 0;
};

}  // namespace tribo::session
