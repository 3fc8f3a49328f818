// SPDX-License-Identifier: MIT
// Drilling cycles of NCI: record 81 is the first hole, records 100 are those after it.
#pragma once

#include "readers/apt/cycle.hpp"

namespace tribo::readers::nci {

struct Hole {
    // Least numbers of values of the two records.
    static constexpr std::size_t kValues = 17, kValuesOfNext = 11;

    apt::Cycle cycle;        // lengths count from `point`
    motion::ToolPose point;  // where the feed begins
};

// kind, bottom (3), dwell, feed, first peck, pecks, gap above a peck, way back, height of the start, height
// where the feed begins, top of the stock, shift, the point of the start above the hole (3), flags, 1: the
// two points are exchanged.
Result<Hole> read_hole(const apt::Statement& record, const apt::Path& path, apt::Report& report);

// kind, bottom (3), height of the start, height where the feed begins, dwell, feed, the point of the start
// (3), flags, 1: the two points are exchanged. The rest is that of the hole before.
Result<void> read_next_hole(const apt::Statement& record, Hole& hole, const apt::Path& path,
                            apt::Report& report);

Result<void> drill(const Hole& hole, const apt::Item& at, apt::Path& path, apt::Report& report);

}  // namespace tribo::readers::nci
