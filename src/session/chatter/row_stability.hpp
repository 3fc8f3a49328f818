// SPDX-License-Identifier: MIT
// Whether a row of a program chatters: as a steady cut of its own.
#pragma once

#include <optional>

#include "session/chatter/steady_cut.hpp"
#include "session/cut/mill_session.hpp"

namespace tribo::session {

inline constexpr std::size_t kMostBands = 12;  // a ball: a point takes about a millisecond
inline constexpr std::size_t kRowBands = 4;    // for all rows of a program: enough to tell which is worse

// The steady cut of a row that has bands, alike neighbours joined to at most `most_bands`. Edges of a flat
// bottom are left out. The setup is that of the run that made the row.
SteadyCut steady_cut_of(const milling::CutRow& row, const MillSetup& setup, std::size_t most_bands);

// At its own speed and depth. Absent where the spindle is slower than SteadyCut::least_rpm().
std::optional<dynamics::Stability> stability_of(const SteadyCut& cut);
// The same with at most kRowBands bands.
std::optional<dynamics::Stability> stability_of(const milling::CutRow& row, const MillSetup& setup);

// Whether two rows differ by so little (0.001 mm, 0.001 rad) that one multiplier is enough for both.
bool chatter_alike(const milling::CutRow& a, const milling::CutRow& b);

// Keeps the row with the largest multiplier; of rows within 1 % of it the one that lasts longest, which is
// not one on the way into the cut.
class WorstRow {
  public:
    // `lasts_s`: with the alike rows that follow.
    void add(const milling::CutRow& row, double lasts_s, double multiplier);
    // Null before the first row.
    const milling::CutRow* row() const { return row_ ? &*row_ : nullptr; }

  private:
    std::optional<milling::CutRow> row_;
    double lasts_s_ = 0, most_ = 0;
};

// Joins bands that stand on each other, those first whose borders differ least.
std::vector<milling::EngagementBand> with_fewer_bands(std::vector<milling::EngagementBand> bands,
                                                      std::size_t most);

}  // namespace tribo::session
