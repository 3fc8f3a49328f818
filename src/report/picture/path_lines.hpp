// SPDX-License-Identifier: MIT
// The path at feed as lines of a picture.
#pragma once

#include <utility>
#include <vector>

#include "motion/path/program.hpp"
#include "report/picture/picture.hpp"

namespace tribo::report {

// Takes the moves of a program in order. A line goes on from move to move; it ends where a rapid follows, or
// where the next move starts elsewhere. Moves without a way, as dwells, do not end it. Curved moves have 16
// points.
class PathLines {
  public:
    void add(const motion::Move& move);
    std::vector<PictureLine> take() { return std::move(lines_); }

  private:
    std::vector<PictureLine> lines_;
    bool goes_on_ = false;
};

}  // namespace tribo::report
