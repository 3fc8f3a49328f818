// SPDX-License-Identifier: MIT
// From the rows of a cut to the feed of each block of its program: the lowest one that any row of the block
// allows, within the limits of chip and machine.
#pragma once

#include <deque>
#include <limits>
#include <vector>

#include "session/audit/line_runs.hpp"
#include "session/feed/feed_solver.hpp"

namespace tribo::session {

// Why a block has its feed.
enum class FeedReason {
    air,           // it cuts nothing, or its tip does not move: the feed stays
    load,          // a load reaches its limit
    thick_chip,    // the chip reaches its largest thickness
    machine,       // the machine goes no faster
    acceleration,  // the block is too short to be faster than the ones beside it
    thin_chip,     // less would rub: a load stays above its limit
    fixed,         // its feed stands in no feed word, and stays
    edge           // the edges alone need more than a limit: no feed helps
};
// A few words.
std::string_view name_of(FeedReason reason);
// Whether a load may stay above its limit for this reason.
bool may_stay_over(FeedReason reason);

// Of a feed move, mm/min, also where the program gives its time.
double feed_of(const motion::Move& move);

struct BlockFeed {
    int line = 0;
    std::size_t first_move = 0, end_move = 0;  // of the setup; one behind the last
    double length_mm = 0;                      // of its feed moves
    double old_mm_per_min = 0;                 // of its first feed move
    double new_mm_per_min = 0;
    double ratio = 0;  // of the load that is nearest to its limit, over it, at the old feed
    FeedReason reason = FeedReason::air;

    double factor() const { return new_mm_per_min / old_mm_per_min; }
};

struct FeedPlanOptions {
    bool sure = false;
    double most_mm_per_min = std::numeric_limits<double>::infinity();  // of the machine
    bool solve = true;                                                 // false: the ratios alone
};

// One thread. Model and session must outlive it.
class FeedPlan {
  public:
    FeedPlan(const LoadModel& model, const MillSession& session, FeedPlanOptions options);

    // The rows of MillSinks::row.
    void add(const milling::CutRow& row, const milling::RowForce& force);
    // After the run: all blocks with feed moves, in the order of the program.
    std::vector<BlockFeed> finish();

  private:
    struct Open {
        LineRun run;
        BlockFeed block;
        std::size_t cutter = 0;
        double allowed_mm_per_s = std::numeric_limits<double>::infinity();
        double chip_per_speed_s = 0;  // thickest chip over the feed, at most
        bool edge = false;
    };
    void open_until(double t_s);
    void consider(Open& open, const milling::CutRow& row, double chip_mm, double ratio);
    void close_front();
    void decide(Open& open) const;
    void accelerate();

    const LoadModel& model_;
    const MillSession& session_;
    FeedPlanOptions options_;
    FeedSolver solver_;
    LineRuns runs_;
    std::deque<Open> open_;
    std::vector<BlockFeed> blocks_;
};

}  // namespace tribo::session
