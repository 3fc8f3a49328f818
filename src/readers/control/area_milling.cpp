// SPDX-License-Identifier: MIT
#include "readers/control/area_milling.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/math.hpp"

namespace tribo::readers::control {
namespace {

using gcode::Element;
using gcode::Point;

constexpr std::size_t kMostRings = 10'000;
constexpr double kMostWork = 1e8;   // pairs of elements that are compared: seconds
constexpr double kClosedMm = 0.05;  // ends of a contour that is meant to be closed
constexpr double kUsualStep = 0.8;  // of the tool's diameter, from ring to ring
// A middle that no ring at the step reaches gets one as far inside as the tool nearly covers, of its radius.
constexpr double kLastStep = 0.95;

double pass_count(const AreaMilling& milling) {
    const double height = milling.depths.top - milling.depths.bottom;
    return milling.infeed > 0 ? std::max(1.0, std::ceil(height / milling.infeed - 1e-9)) : 1;
}

Ring reversed(const Ring& ring) {
    Ring back(ring.rbegin(), ring.rend());
    for (Element& element : back) {
        std::swap(element.start, element.end);
        element.turn_rad *= -1;
    }
    return back;
}

class AreaMill {
  public:
    AreaMill(const Area& area, const AreaMilling& milling, Vec3 from, const PocketMove& go)
        : area_(area), milling_(milling), now_(from), go_(go) {}

    Result<void> leave(double z) { return to({now_.x, now_.y, z}, {}, {}); }

    // To a place at the depth: straight where that stays within the pocket, else above it.
    Result<void> enter(Point start, double z) {
        const double most = milling_.radius + milling_.allowance;
        if (now_.z == z && area_.keeps({now_.x, now_.y}, start, most))
            return to({start.u, start.v, z}, milling_.feed, {});
        auto done = now_.z < milling_.depths.near ? leave(milling_.depths.near) : Result<void>{};
        if (done) done = to({start.u, start.v, now_.z}, {}, {});
        if (done && now_.z > milling_.depths.near) done = leave(milling_.depths.near);
        return done ? to({start.u, start.v, z}, milling_.plunge, {}) : done;
    }

    // From the place of the ring that is nearest.
    Result<void> ring(const Ring& given, double z) {
        const Ring ring = milling_.clockwise ? reversed(given) : given;
        std::size_t first = 0;
        const Point here{now_.x, now_.y};
        for (std::size_t i = 1; i < ring.size(); ++i) {
            if (distance(ring[i].start, here) < distance(ring[first].start, here)) first = i;
        }
        if (auto done = enter(ring[first].start, z); !done) return done;
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Element& element = ring[(first + i) % ring.size()];
            std::optional<motion::Arc> arc;
            if (element.is_arc()) {
                arc.emplace();
                arc->centre_mm = {element.centre.u, element.centre.v, z};
                arc->normal = {0, 0, element.turn_rad < 0 ? -1.0 : 1.0};
                arc->turn_rad = std::abs(element.turn_rad);
            }
            if (auto done = to({element.end.u, element.end.v, z}, milling_.feed, arc); !done) return done;
        }
        return {};
    }

  private:
    Result<void> to(Vec3 place, std::optional<double> feed, const std::optional<motion::Arc>& arc) {
        now_ = place;
        return go_(place, feed, arc);
    }

    const Area& area_;
    const AreaMilling& milling_;
    Vec3 now_;
    const PocketMove& go_;
};

}  // namespace

bool close_ring(Ring& ring) {
    if (ring.empty()) return false;
    const double gap = distance(ring.back().end, ring.front().start);
    if (gap > kClosedMm) return false;
    if (gap > 0) ring.push_back({ring.back().end, ring.front().start, {}, 0});
    return true;
}

std::optional<std::vector<Ring>> rings_of(const Area& area, const AreaMilling& milling) {
    const double least = milling.radius + milling.allowance;
    const double step = milling.step > 0 ? milling.step : kUsualStep * 2 * milling.radius;
    std::vector<std::vector<Ring>> levels;
    std::size_t count = 0;
    double at = least;
    double work = 0;
    for (;; at += step) {
        work += static_cast<double>(area.size() * area.size());
        if (count > kMostRings || work > kMostWork) return std::nullopt;
        levels.push_back(area.rings_at(at));
        count += levels.back().size();
        if (levels.back().empty() || milling.along_edge) break;
    }
    if (!milling.along_edge && levels.size() > 1 && step > kLastStep * milling.radius)
        levels.back() = area.rings_at(at - step + kLastStep * milling.radius);
    std::vector<Ring> rings;
    for (auto level = levels.rbegin(); level != levels.rend(); ++level)
        rings.insert(rings.end(), level->begin(), level->end());
    return rings;
}

double ring_count(const std::vector<Ring>& rings, const AreaMilling& milling) {
    return static_cast<double>(rings.size()) * pass_count(milling);
}

Result<void> mill_area(const Area& area, const std::vector<Ring>& rings, const AreaMilling& milling,
                       Vec3 from, const PocketMove& go) {
    const PocketDepths& depths = milling.depths;
    AreaMill mill(area, milling, from, go);
    auto done = mill.leave(depths.back);
    const double passes = pass_count(milling);
    for (double pass = 1; done && pass <= passes; ++pass) {
        const double z = depths.top - (depths.top - depths.bottom) * pass / passes;
        for (const Ring& ring : rings) {
            if (done) done = mill.ring(ring, z);
        }
        if (done) done = mill.leave(pass < passes ? depths.near : depths.back);
    }
    return done;
}

}  // namespace tribo::readers::control
