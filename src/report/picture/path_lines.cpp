// SPDX-License-Identifier: MIT
#include "report/picture/path_lines.hpp"

namespace tribo::report {
namespace {

constexpr int kCurvePoints = 16;
constexpr Colour kPathColour{0.12F, 0.44F, 0.55F};

}  // namespace

void PathLines::add(const motion::Move& move) {
    if (move.kind == motion::MoveKind::rapid) goes_on_ = false;
    if (move.kind != motion::MoveKind::feed) return;
    if (!goes_on_ || lines_.back().points_mm.back() != move.start.tip_mm)
        lines_.push_back({{move.start.tip_mm}, {kPathColour}});
    goes_on_ = true;
    const int points = move.arc || move.quadratic ? kCurvePoints : 1;
    for (int i = 1; i <= points; ++i)
        lines_.back().points_mm.push_back(motion::pose_at(move, static_cast<double>(i) / points).tip_mm);
}

}  // namespace tribo::report
