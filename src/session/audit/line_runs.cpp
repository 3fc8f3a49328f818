// SPDX-License-Identifier: MIT
#include "session/audit/line_runs.hpp"

#include <algorithm>

namespace tribo::session {

double LineRun::shared_s(const milling::CutRow& row) const {
    // Times of rows and moves differ by rounding.
    constexpr double kRounding = 1e-6;
    const double shared = std::min(row.end_s, end_s) - std::max(row.start_s, start_s);
    return shared > kRounding * row.duration_s() ? shared : 0;
}

std::optional<LineRun> LineRuns::next(double before_s) {
    const std::size_t count = setup_.moves.size();
    if (move_ >= count || !(schedule_.moves[move_].start_s < before_s)) return std::nullopt;
    LineRun run{setup_.moves[move_].line, move_, move_, schedule_.moves[move_].start_s, 0};
    const std::size_t cutter = setup_.cutter_of_move[move_];
    while (move_ < count && setup_.moves[move_].line == run.line && setup_.cutter_of_move[move_] == cutter)
        ++move_;
    run.end_move = move_;
    run.end_s = schedule_.moves[move_ - 1].end_s;
    return run;
}

}  // namespace tribo::session
