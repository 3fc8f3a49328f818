// SPDX-License-Identifier: MIT
// Gouge and scallop of a finished part, by the lines of the program that left them. Each piece of the
// machined surface is the work of one move: of the moves that passed the same place at the same depth, one.
#pragma once

#include <cstddef>
#include <vector>

#include "session/audit/auditor.hpp"
#include "surface/deviation.hpp"

namespace tribo::session {

class PartErrors {
  public:
    // `deviation`: of the part of the session, which has run, with all places. A scallop belongs to the moves
    // of its crest and of both its sides.
    PartErrors(const MillSession& session, const surface::DeviationReport& deviation);

    struct Largest {
        double gouge_mm = 0, scallop_mm = 0;  // >= 0
    };
    // Of the moves that begin in that time.
    Largest between(double from_s, double to_s) const;
    // The line of the deepest gouge; 0: there is none, or no move of the job left it.
    int gouge_line() const { return gouge_line_; }
    // The lines with gouges, the deepest first; at most kWorstLines.
    struct Gouge {
        int line = 0;
        double mm = 0;
    };
    const std::vector<Gouge>& gouges() const { return gouges_; }
    // Sets the errors of tools and worst lines.
    void describe(Audit& audit) const;

  private:
    struct OfMove {
        double start_s = 0;
        std::size_t cutter = 0;
        Largest largest;
    };
    std::vector<OfMove> moves_;  // those with errors, in the order of time
    int gouge_line_ = 0;
    std::vector<Gouge> gouges_;
};

}  // namespace tribo::session
