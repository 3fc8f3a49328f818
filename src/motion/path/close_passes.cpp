// SPDX-License-Identifier: MIT
#include "motion/path/close_passes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <cstdint>
#include <vector>

#include "base/math.hpp"
#include "motion/path/path.hpp"

namespace tribo::motion {
namespace {

constexpr int kPlaces = 2000;
constexpr double kMostSteps = 400'000;
constexpr double kParallel = 0.9;        // least cosine between the directions of neighbours
constexpr double kSameTrack = 0.02;      // of the requested distance; nearer is the same line
constexpr double kLeastSideways = 0.25;  // of the distance; less is another depth, not another track
// Length along the path, in requested distances, that belongs to the place's own stretch.
constexpr double kOwnStretch = 4;

using Key = std::array<std::int64_t, 3>;

struct Place {
    Vec3 tip_mm, along, axis;
    double at_mm = 0;       // along the feed path
    double nearest_mm = 0;  // distance of the nearest pass beside it
    Vec3 aside;             // unit, to the nearest
};

struct Entry {
    Key key;
    std::uint32_t place;
    auto operator<=>(const Entry&) const = default;
};

class Search {
  public:
    Search(std::span<const Move> moves, double within_mm) : moves_(moves), within_(within_mm) {
        for (const Move& m : moves) length_ += m.kind == MoveKind::feed ? path_length_mm(m) : 0;
        step_ = std::max(0.5 * within_, length_ / kMostSteps);
        edge_ = within_ + step_;
    }

    ClosePasses run() {
        if (!(length_ > 0)) return {};
        choose_places();
        double at = 0;
        for (const Move& m : moves_) {
            if (m.kind != MoveKind::feed) continue;
            const double length = path_length_mm(m);
            const int steps = std::max(1, static_cast<int>(std::ceil(length / step_)));
            Vec3 from = m.start.tip_mm;
            for (int n = 1; n <= steps; ++n) {
                const Vec3 to = pose_at(m, static_cast<double>(n) / steps).tip_mm;
                pass(from, to, at + (n - 0.5) * length / steps);
                from = to;
            }
            at += length;
        }
        std::vector<const Place*> near;
        for (const Place& p : places_) {
            if (p.nearest_mm < within_) near.push_back(&p);
        }
        if (near.empty()) return {};
        const auto middle = near.begin() + static_cast<std::ptrdiff_t>(near.size() / 2);
        std::nth_element(near.begin(), middle, near.end(), [](const Place* a, const Place* b) {
            return a->nearest_mm != b->nearest_mm ? a->nearest_mm < b->nearest_mm : a->at_mm < b->at_mm;
        });
        return described(**middle, static_cast<double>(near.size()) / static_cast<double>(places_.size()));
    }

  private:
    static ClosePasses described(const Place& p, double share) {
        const Vec3 across = cross(p.along, p.aside);
        const Vec3 normal = normalized(dot(across, p.axis) < 0 ? -1.0 * across : across, p.axis);
        ClosePasses found{share, p.nearest_mm};
        const double forward = std::abs(dot(p.axis, p.along)),
                     sideways = std::abs(dot(p.axis, cross(normal, p.along)));
        found.tilt_rad = math::atan2(math::hypot(forward, sideways), dot(p.axis, normal));
        found.turn_rad = math::atan2(sideways, forward);
        return found;
    }

    Key key_of(Vec3 p) const {
        const auto part = [&](double v) {
            return static_cast<std::int64_t>(std::clamp(std::floor(v / edge_), -1e15, 1e15));
        };
        return {part(p.x), part(p.y), part(p.z)};
    }

    void choose_places() {
        double before = 0;
        for (const Move& m : moves_) {
            if (m.kind != MoveKind::feed) continue;
            const double length = path_length_mm(m);
            while (places_.size() < kPlaces) {
                const double at = (static_cast<double>(places_.size()) + 0.5) / kPlaces * length_;
                if (at > before + length) break;
                const double t = parameter_at_length(m, at - before);
                const ToolPose pose = pose_at(m, t);
                places_.push_back(
                    {pose.tip_mm, normalized(tip_derivative_mm(m, t), {}), pose.axis, at, within_, {}});
            }
            before += length;
        }
        for (std::uint32_t n = 0; n < places_.size(); ++n) {
            const Key key = key_of(places_[n].tip_mm);
            for (int k = 0; k < 27; ++k) {
                entries_.push_back({{key[0] + k % 3 - 1, key[1] + k / 3 % 3 - 1, key[2] + k / 9 - 1}, n});
            }
        }
        std::sort(entries_.begin(), entries_.end());
    }

    // Takes a short, almost straight stretch of path with its middle at `at` along the path.
    void pass(Vec3 from, Vec3 to, double at) {
        const Key key = key_of(0.5 * (from + to));
        for (auto e = std::lower_bound(entries_.begin(), entries_.end(), Entry{key, 0});
             e != entries_.end() && e->key == key; ++e) {
            Place& place = places_[e->place];
            if (std::abs(at - place.at_mm) < kOwnStretch * within_ + step_) continue;
            const Vec3 way = to - from;
            const double length = tribo::length(way), along = dot(way, place.along);
            if (!(std::abs(along) > kParallel * length)) continue;
            // The point where the stretch crosses the plane through the place that is normal to the direction
            // of the place.
            const double t = dot(place.tip_mm - from, place.along) / along;
            if (t < 0 || t > 1) continue;
            const Vec3 off = from + t * way - place.tip_mm;
            const double d = tribo::length(off),
                         sideways = std::abs(dot(off, cross(place.axis, place.along)));
            if (d > kSameTrack * within_ && sideways > kLeastSideways * d && d < place.nearest_mm) {
                place.nearest_mm = d;
                place.aside = off / d;
            }
        }
    }

    std::span<const Move> moves_;
    double within_, length_ = 0, step_ = 0, edge_ = 0;
    std::vector<Place> places_;
    std::vector<Entry> entries_;
};

}  // namespace

ClosePasses close_passes(std::span<const Move> moves, double within_mm) {
    return Search(moves, within_mm).run();
}

}  // namespace tribo::motion
