// SPDX-License-Identifier: MIT
#include "elastic/pile.hpp"

#include <algorithm>
#include <cmath>

namespace tribo::elastic {
namespace {

// A hair in the middle of the finger has turned by half of its way after this distance.
constexpr double kTurnMm = 2;
// Hairs that lean most stand again after this time. They rise at one speed, so that the end is near and
// exact.
constexpr double kRiseS = 20;
// A fast finger is followed in so many steps at most: a frame's way across a wide image.
constexpr double kMostSteps = 64;

}  // namespace

Pile::Pile(const SheetSize& sheet)
    : width_(std::max(sheet.width / kPileNodes, 1)),
      height_(std::max(sheet.height / kPileNodes, 1)),
      node_width_mm_(sheet.spacing_mm * sheet.width / width_),
      node_height_mm_(sheet.spacing_mm * sheet.height / height_),
      leans_(2 * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_)) {}

void Pile::brush(const ContactEllipse& c, double dx_mm, double dy_mm) {
    const double way_mm = std::sqrt(dx_mm * dx_mm + dy_mm * dy_mm);
    if (!touches(c) || !(way_mm > 0 && way_mm <= kMostLengthMm)) return;
    const double step_mm = std::min(c.half_width_mm, c.half_height_mm) / 4;
    const int steps = static_cast<int>(std::min(std::ceil(way_mm / step_mm), kMostSteps));
    const double turned = way_mm / steps / kTurnMm;
    const auto node = [](double mm, double node_mm, int nodes) {
        return static_cast<int>(std::clamp(mm / node_mm, 0.0, static_cast<double>(nodes)));
    };
    for (int n = steps - 1; n >= 0; --n) {
        const double back = static_cast<double>(n) / steps;
        const double x_mm = c.x_mm - back * dx_mm, y_mm = c.y_mm - back * dy_mm;
        const int right = node(x_mm + c.half_width_mm, node_width_mm_, width_);
        const int below = node(y_mm + c.half_height_mm, node_height_mm_, height_);
        for (int j = node(y_mm - c.half_height_mm, node_height_mm_, height_); j < below; ++j) {
            for (int i = node(x_mm - c.half_width_mm, node_width_mm_, width_); i < right; ++i) {
                const double u = ((i + 0.5) * node_width_mm_ - x_mm) / c.half_width_mm;
                const double v = ((j + 0.5) * node_height_mm_ - y_mm) / c.half_height_mm;
                const double inside = std::max(1 - u * u - v * v, 0.0);
                // Never more than the whole way, whatever the distance of a step.
                const double share = inside * turned / (1 + inside * turned);
                float* lean = leans_.data() + 2 * (j * width_ + i);
                lean[0] += static_cast<float>(share * (dx_mm / way_mm - lean[0]));
                lean[1] += static_cast<float>(share * (dy_mm / way_mm - lean[1]));
            }
        }
    }
    leaning_ = true;
}

bool Pile::rise(double duration_s) {
    if (!leaning_ || !(duration_s > 0)) return leaning_;
    leaning_ = false;
    const auto risen = static_cast<float>(duration_s / kRiseS);
    for (std::size_t i = 0; i < leans_.size(); i += 2) {
        float &x = leans_[i], &y = leans_[i + 1];
        const float length = std::sqrt(x * x + y * y);
        const float kept = length > risen ? 1 - risen / length : 0;
        x *= kept;
        y *= kept;
        leaning_ |= kept > 0;
    }
    return leaning_;
}

}  // namespace tribo::elastic
