// SPDX-License-Identifier: MIT
// What earlier jobs cut out of the stock that a job begins with: their moves again, without forces, rows and
// collisions. The field then holds the very sweeps that a session of the earlier job carves.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "field/carved/carved_field.hpp"
#include "milling/tool/cutter.hpp"
#include "motion/machine/work_frame.hpp"
#include "motion/path/program.hpp"

namespace tribo::session {

struct MillSetup;

// The cuts of one job, in the order in which it makes them.
struct EarlierCuts {
    std::vector<milling::Cutter> cutters;
    std::vector<motion::Move> moves;          // elementary, without dwells
    std::vector<std::size_t> cutter_of_move;  // index into `cutters`, one per move
};

// What a setup cuts, up to its until_s; the last move is then cut short where the time ends.
EarlierCuts cuts_of(const MillSetup& setup);

// A hash of all that decides the material that they take: paths and kinds of the moves, and apart from it
// sizes of the cutters. Feeds, speeds and flutes do not count.
std::uint64_t hash_of_moves(const EarlierCuts& cuts);
std::uint64_t hash_of_cutters(const EarlierCuts& cuts);

// The same move in the coordinates of a frame. Exact where the frame's axes are those of the stock, or
// opposite to them, and its origin is 0.
motion::Move in_frame(const motion::Move& move, const motion::WorkFrame& frame);

// Carves all of them. The carving thread's; other threads through the field's own ParallelFor. `progress`
// hears now and then which fraction is done, and may be empty; false stops, and is given back.
bool carve(field::CarvedField& stock, std::span<const EarlierCuts> earlier,
           const std::function<bool(double fraction)>& progress);

}  // namespace tribo::session
