// SPDX-License-Identifier: MIT
// What `tribo feed` says about what was won.
#pragma once

#include <string>
#include <vector>

#include "app/audit/speed_advice.hpp"
#include "app/feed/feed.hpp"
#include "session/cut/mill_session.hpp"
#include "session/feed/feed_plan.hpp"

namespace tribo::app {

// Largest forces by their time, in steps of 1 %.
class ForceShares {
  public:
    void add(double force_n, double seconds);
    // The force that is not exceeded in this share of the cutting time; 0 without a cut.
    double quantile(double share) const;

  private:
    std::vector<double> seconds_;
    double all_s_ = 0;
};

// One run of the program.
struct FeedRun {
    session::MillTotals totals;
    std::vector<session::BlockFeed> blocks;
    ForceShares forces;
};

// The grid rounds: a load that is a hundredth over its limit is at its limit.
inline bool is_over(double ratio) {
    constexpr double kRounding = 1.01;
    return ratio > kRounding;
}

struct FeedAnswer {
    FeedRun before, after;
    std::string program, file;  // that was written
    std::size_t changed = 0;    // blocks with another feed
    SpeedAdvice speeds;         // with --stable
    Warnings warnings;
};

// Lines whose load is over its limit with the new feed, with the reason.
struct LineOver {
    int line = 0;
    double ratio = 0;
    session::FeedReason reason = session::FeedReason::load;
};
std::vector<LineOver> lines_over(const FeedAnswer& answer);

std::string feed_json(const FeedCall& call, const FeedAnswer& answer);
// For people.
void print(const FeedAnswer& answer);

}  // namespace tribo::app
