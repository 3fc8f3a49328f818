// SPDX-License-Identifier: MIT
#include "milling/tool/material_arcs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace tribo::milling {
namespace {

// Narrower slits and slivers are rounding, left where surfaces meet or touch.
constexpr double kSliver = 5e-4;  // mm
constexpr double kSliverRad = 2e-3;
// Farther apart, in mm and in cells, even places would miss a rib or a narrow blank.
constexpr double kWidestPlaceMm = 1, kWidestPlaceCells = 1;

struct Direction {
    double sine, cosine;
};

const std::array<Direction, kTurnPlaces>& directions() {
    static const std::array<Direction, kTurnPlaces> table = [] {
        std::array<Direction, kTurnPlaces> t;
        for (int n = 0; n < kTurnPlaces; ++n)
            math::sincos(n * kPlaceRad, t[static_cast<std::size_t>(n)].sine,
                         t[static_cast<std::size_t>(n)].cosine);
        return t;
    }();
    return table;
}

class Scan {
  public:
    Scan(const field::CarvedView& stock, const AxisCircle& circle, double from, double to,
         std::vector<MaterialArc>& arcs)
        : stock_(stock), circle_(circle), from_(from), to_(to), arcs_(arcs), before_(arcs.size()) {
        // On a small circle only every stride-th place is tested: as many as stand about a cell apart.
        constexpr int kMostStride = 8;
        const double apart = std::min(kWidestPlaceMm, kWidestPlaceCells * stock.field().cell_mm());
        while (stride_ < kMostStride && 2 * stride_ * kPlaceRad * circle.radius_mm <= apart) stride_ *= 2;
        while (kPlaceRad * circle.radius_mm > parts_ * apart) parts_ *= 2;
        step_ = stride_ * kPlaceRad / parts_;
        first_ = static_cast<int>(std::floor(from / step_)) + 1;
        const int last = static_cast<int>(std::ceil(to / step_)) - 1;
        count_ = std::max(0, last - first_ + 1);
    }

    void run() {
        const Place begin{0, from_, way(circle_.at(from_))}, end{count_ + 1, to_, way(circle_.at(to_))};
        entry_ = from_;
        between(begin, end);
        if (end.way < 0) add(to_);
    }

  private:
    struct Place {
        int number;
        double rotation;
        double way;  // distance that is surely clear of a border, negative in material
    };

    double way(Vec3 p) const {
        const double enough = circle_.radius_mm * (to_ - from_);
        return stock_.clear_way_mm(p, enough) + kSkin;
    }
    Place place(int number) const {
        const int n = first_ + number - 1;
        const double rotation = n * step_;
        return {number, rotation, way(parts_ > 1 ? circle_.at(rotation) : circle_.at_place(n * stride_))};
    }

    // Adds the arc that began at entry_.
    void add(double exit) {
        const double sliver = std::max(kSliverRad, kSliver / circle_.radius_mm);
        if (arcs_.size() > before_ && entry_ - arcs_.back().to_rad < sliver) {
            arcs_.back().to_rad = exit;
        } else if (exit - entry_ > sliver) {
            arcs_.push_back({entry_, exit});
        }
    }

    void between(const Place& a, const Place& b) {
        const bool differ = (a.way < 0) != (b.way < 0);
        if (b.number - a.number == 1) {
            if (!differ) return;
            if (a.way < 0) {
                add(border(b, a));
            } else {
                entry_ = border(a, b);
            }
            return;
        }
        const double apart = circle_.radius_mm * (b.rotation - a.rotation);
        if (!differ && std::abs(a.way) + std::abs(b.way) > apart) return;
        const Place middle = place((a.number + b.number) / 2);
        between(a, middle);
        between(middle, b);
    }

    // Returns the border between two rotations of which only `inside` lies in material. It halves first,
    // because the signs do not depend on the storage of the stock; then it uses regula falsi in the Illinois
    // form. Far from the surface the clear way has the right sign, but the exact distance of a brick may not;
    // near it both are the same.
    double border(const Place& outside, const Place& inside) const {
        constexpr int kHalvings = 3, kSteps = 30;
        constexpr double kAngle = 1e-7, kDepth = 1e-9;  // rad, mm
        double out_at = outside.rotation, in_at = inside.rotation, out = outside.way, in = inside.way;
        double angle = in_at;
        int last = 0;
        for (int n = 0; n < kSteps && std::abs(in_at - out_at) > kAngle; ++n) {
            angle = n >= kHalvings && in < out ? out_at + (in_at - out_at) * out / (out - in)
                                               : 0.5 * (in_at + out_at);
            const double d = way(circle_.at(angle));
            if (std::abs(d) < kDepth) break;
            const int side = d < 0 ? 1 : -1;
            if (side > 0) {
                in_at = angle;
                in = d;
                if (last > 0) out *= 0.5;
            } else {
                out_at = angle;
                out = d;
                if (last < 0) in *= 0.5;
            }
            last = side;
        }
        return angle;
    }

    const field::CarvedView& stock_;
    const AxisCircle& circle_;
    double from_, to_;
    std::vector<MaterialArc>& arcs_;
    std::size_t before_;
    int stride_ = 1, parts_ = 1;  // places in a step, or steps in a place
    double step_ = kPlaceRad;
    int first_ = 0, count_ = 0;  // of the places between the ends, in steps
    double entry_ = 0;
};

}  // namespace

Vec3 AxisCircle::at(double rotation_rad) const {
    double sine, cosine;
    math::sincos(rotation_rad, sine, cosine);
    return centre_mm + sine * x + cosine * y;
}

Vec3 AxisCircle::at_place(int place) const {
    const Direction d = directions()[static_cast<std::size_t>(place & (kTurnPlaces - 1))];
    return centre_mm + d.sine * x + d.cosine * y;
}

void material_arcs(const field::CarvedView& stock, const AxisCircle& circle, double from, double to,
                   std::vector<MaterialArc>& arcs) {
    Scan(stock, circle, from, to, arcs).run();
}

}  // namespace tribo::milling
