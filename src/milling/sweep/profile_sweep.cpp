// SPDX-License-Identifier: MIT
#include "milling/sweep/profile_sweep.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "milling/sweep/sweep_frames.hpp"

namespace tribo::milling {
namespace {

using field::kLatticeEdge;

// Larger than every distance, mm.
constexpr double kNoBound = 1e30;
// Surfaces that are nearer to each other than this meet in an edge, mm.
constexpr double kEdgeMm = 1e-5;
// Nearer to the axis of the tool than this the way from it is rounding: at a tip it would tell of a wall
// ahead. mm.
constexpr double kOnAxis = 1e-9;

// Unit; zero on the axis.
Vec3 radial_of(Vec3 across) {
    const double r = length(across);
    return r > kOnAxis ? across / r : Vec3{};
}

// Calls distance(point, bound) for the nodes of a lattice, with `known` as the bound, if it is given. `near`
// and rows as in sweep_kernels.inl: where the neighbour before shows that a node is farther than `near` from
// the surface, its bound is enough.
template <class F>
void sample_nodes(const field::Lattice& lattice, double near_mm, const float* known, float* out,
                  const F& distance) {
    for (int n = 0; n < field::kLatticeNodes; ++n) {
        const int a = n % kLatticeEdge, b = n / kLatticeEdge % kLatticeEdge,
                  c = n / (kLatticeEdge * kLatticeEdge);
        double above = -kNoBound, below = kNoBound;
        const auto learn = [&](bool has, int step) {
            if (!has) return;
            const double before = static_cast<double>(out[n - step]);
            above = std::max(above, before - lattice.cell_mm - kProvenMm);
            // What is not below the known one is no distance but a bound from below.
            if (known == nullptr || out[n - step] < known[n - step])
                below = std::min(below, before + lattice.cell_mm + kProvenMm);
        };
        learn(a > 0, 1);
        learn(b > 0, kLatticeEdge);
        learn(c > 0, kLatticeEdge * kLatticeEdge);
        const double bound = known == nullptr ? near_mm : std::min(near_mm, static_cast<double>(known[n]));
        const double side = above >= near_mm ? above : below <= -near_mm ? below : 0;
        out[n] = static_cast<float>(side != 0 ? side : distance(lattice.node(a, b, c), bound));
    }
}

// A level move: straight, or along an arc.
class LevelSweep : public field::Shape {
  public:
    double distance_mm(Vec3 point) const override { return zones_->distance_mm(seen(point).at); }
    Vec3 gradient(Vec3 point) const override {
        const View v = seen(point);
        const PlanePoint normal = zones_->look(v.at).normal;
        return normalized(normal.r * v.radial + normal.z * v.axis, -v.axis);
    }
    void sample(const field::Lattice& lattice, float* out) const override {
        sample_near(lattice, kNoBound, out);
    }
    void sample_near(const field::Lattice& lattice, double near_mm, float* out) const override {
        sample_nodes(lattice, near_mm, nullptr, out,
                     [this](Vec3 point, double) { return distance_mm(point); });
    }

  protected:
    // The tool where it is nearest. `radial` is a unit vector in stock coordinates; zero on the axis.
    struct View {
        PlanePoint at;
        Vec3 radial, axis;
    };
    explicit LevelSweep(std::shared_ptr<const ConvexZones> zones) : zones_(std::move(zones)) {}
    virtual View seen(Vec3 point) const = 0;
    ToolCylinder cylinder() const { return {zones_->radius_mm(), zones_->length_mm()}; }
    static View view(const Frame& frame, Vec3 off) {
        const Vec3 across{off.x, off.y, 0};
        return {{length(across), off.z}, frame.out_of(radial_of(across)), frame.z};
    }

    std::shared_ptr<const ConvexZones> zones_;
};

class LevelLineSweep final : public LevelSweep {
  public:
    LevelLineSweep(std::shared_ptr<const ConvexZones> zones, const StraightFrame& path)
        : LevelSweep(std::move(zones)), path_(path) {}
    Box3 bounds_mm() const override { return path_.box(cylinder()); }

  private:
    View seen(Vec3 point) const override {
        const Vec3 q = path_.frame.into(point - path_.start);
        const double t = std::clamp(q.x * path_.line.per_across, 0.0, 1.0);
        return view(path_.frame, q - Vec3{t * path_.line.across, 0, 0});
    }

    StraightFrame path_;
};

class LevelArcSweep final : public LevelSweep {
  public:
    LevelArcSweep(std::shared_ptr<const ConvexZones> zones, const motion::Move& move)
        : LevelSweep(std::move(zones)), path_(move) {}
    Box3 bounds_mm() const override { return path_.box(cylinder()); }

  private:
    View seen(Vec3 point) const override {
        const Vec3 q = path_.frame.into(point - path_.centre);
        return view(path_.frame, q - path_.nearest(q));
    }

    ArcFrame path_;
};

// The tool as seen from a point at one instant; derivatives by t.
struct ZonesView {
    Vec3 axis, radial;
    PlanePoint at, rate;
};
ZonesView zones_view(const CurvedLine& c, Vec3 point, double t) {
    const Vec3 d = point - t * (c.tip1 + t * c.tip2), velocity = c.tip1 + 2 * t * c.tip2;
    const Vec3 raw = c.axis0 + t * (c.axis1 + t * c.axis2), turning = c.axis1 + 2 * t * c.axis2;
    const double size = length(raw);
    ZonesView v;
    v.axis = raw / size;
    const Vec3 axis_rate = (turning - dot(turning, v.axis) * v.axis) / size;
    v.at.z = dot(d, v.axis);
    const Vec3 radial = d - v.at.z * v.axis;
    v.at.r = length(radial);
    v.radial = radial_of(radial);
    v.rate.z = dot(d, axis_rate) - dot(velocity, v.axis);
    v.rate.r = -dot(v.radial, velocity) - v.at.z * dot(v.radial, axis_rate);
    return v;
}

class SearchedSweep final : public field::Shape {
  public:
    SearchedSweep(std::shared_ptr<const ConvexZones> zones, const motion::Move& move)
        : zones_(std::move(zones)), start_(move.start.tip_mm), line_(curved_line(move)) {
        box_ = curved_box({zones_->radius_mm(), zones_->length_mm()}, line_, start_);
        frame_.z = line_.axis0;
        frame_.x = any_perpendicular(frame_.z);
        frame_.y = cross(frame_.z, frame_.x);
        turns_ = line_.axis1 != Vec3{} || line_.axis2 != Vec3{};
        tip1_ = frame_.into(line_.tip1);
        tip2_ = frame_.into(line_.tip2);
    }

    Box3 bounds_mm() const override { return box_; }
    double distance_mm(Vec3 point) const override { return least(point, kNoBound, kNoBound).distance; }
    double distance_below(Vec3 point, double bound) const override {
        return least(point, bound, kNoBound).distance;
    }
    bool is_searched() const override { return true; }

    // Where two surfaces of the cutter meet in an edge that makes the surface, its normal is perpendicular to
    // the travel of the edge, between their normals.
    Vec3 gradient(Vec3 point) const override {
        const Least nearest = least(point, kNoBound, kNoBound);
        const ZonesView v = zones_view(line_, point - start_, nearest.t);
        const PlanePoint normal = edge_normal(v, nearest);
        return normalized(normal.r * v.radial + normal.z * v.axis, -v.axis);
    }

    void sample(const field::Lattice& lattice, float* out) const override {
        sample_near(lattice, kNoBound, out);
    }
    void sample_near(const field::Lattice& lattice, double near_mm, float* out) const override {
        sample_below(lattice, near_mm, nullptr, out);
    }
    void sample_below(const field::Lattice& lattice, double near_mm, const float* known,
                      float* out) const override {
        sample_nodes(lattice, near_mm, known, out,
                     [&](Vec3 point, double bound) { return least(point, bound, near_mm).distance; });
    }

  private:
    static constexpr int kDepth = 40, kMostLooks = 400;

    struct Least {
        double distance, t;
        std::size_t zone;
    };
    // Where a point lies in the half plane of the tool, and how fast that changes.
    struct Place {
        PlanePoint at, rate;
    };
    // `d`: the point from the start of the tip; in the frame where the axis does not turn.
    Place place(Vec3 d, double t) const {
        if (turns_) {
            const ZonesView v = zones_view(line_, d, t);
            return {v.at, v.rate};
        }
        const Vec3 off = d - t * (tip1_ + t * tip2_), velocity = tip1_ + 2 * t * tip2_;
        const double r = std::sqrt(off.x * off.x + off.y * off.y);
        const double approach = off.x * velocity.x + off.y * velocity.y;
        return {{r, off.z}, {r > kOnAxis ? -approach / r : 0, -velocity.z}};
    }

    // The distance to a zone at one instant.
    struct Instant {
        double t, distance, slope;
    };
    struct Stretch {
        Instant a, b;
        double floor;  // nothing between is lower
    };

    Instant instant(std::size_t zone, const Place& p, double t) const {
        const ConvexZones::Seen seen = zones_->look(zone, p.at);
        return {t, seen.distance_mm, dot(seen.normal, p.rate)};
    }

    // The parabolas from both ends meet once; below neither of them is the least there or at an end.
    static double meeting(const Instant& a, const Instant& b, double bend) {
        const double width = b.t - a.t, steepness = b.slope - a.slope + bend * width;
        const double x = a.distance - b.distance + (b.slope + 0.5 * bend * width) * width;
        return steepness > 0 ? std::clamp(x / steepness, 0.0, width) : 0;
    }
    static Stretch stretch(const Instant& a, const Instant& b, double bend) {
        const double x = meeting(a, b, bend), ends = std::min(a.distance, b.distance);
        return {a, b, std::min(ends, a.distance + x * (a.slope - 0.5 * bend * x))};
    }

    // Returns the next instant to look at: the bottom of the cubic through both ends, or by turns where the
    // parabolas meet, which finds the edges.
    static double next(const Stretch& s, double bend, int look) {
        const double width = s.b.t - s.a.t;
        double x = meeting(s.a, s.b, bend);
        if (s.a.slope < 0 && s.b.slope > 0 && look % 2 == 0) {
            const double chord = s.a.slope + s.b.slope + 3 * (s.a.distance - s.b.distance) / width;
            const double root = std::sqrt(std::max(chord * chord - s.a.slope * s.b.slope, 0.0));
            x = width - width * (s.b.slope + root - chord) / (s.b.slope - s.a.slope + 2 * root);
        }
        return s.a.t + std::clamp(x, 0.05 * width, 0.95 * width);
    }

    // Looks for the least distance below `bound`. Beyond `near` on both sides of the surface only the side is
    // exact: above it the result is a bound from below.
    Least least(Vec3 point, double bound, double near) const {
        if (bound <= -zones_->radius_mm()) return {bound, 0, 0};  // no place of the tool is so deep
        const Vec3 d = point - start_;
        const TravelBounds& b = line_.bounds;
        const double reach = length(d - b.middle) + b.spread;
        const double curve = b.tip_bend + 2 * b.turn * b.speed + (b.turn_rate + b.turn * b.turn) * reach;
        const Vec3 seen = turns_ ? d : frame_.into(d);
        const Place first = place(seen, 0), last = place(seen, 1);
        const PlanePoint halfway = zones_->size() > 1 ? place(seen, 0.5).at : PlanePoint{};
        const double speed = b.speed + b.turn * reach;
        Least best{bound, 0, 0};
        double lowest_floor = kNoBound;
        for (std::size_t zone = 0; zone < zones_->size(); ++zone) {
            const double bend = curve + zones_->bend_per_mm(zone) * speed * speed;
            std::array<Stretch, kDepth> open;
            int count = 0;
            const auto goal = [&] {
                return best.distance > -near ? std::min(best.distance - 0.5 * kProvenMm, near) : -kNoBound;
            };
            const auto take = [&](const Instant& i) {
                if (i.distance < best.distance) best = {i.distance, i.t, zone};
            };
            const auto push = [&](const Stretch& s) {
                if (s.floor < goal() && count < kDepth) {
                    open[static_cast<std::size_t>(count++)] = s;
                } else {
                    lowest_floor = std::min(lowest_floor, s.floor);
                }
            };
            // Where one of many zones may come in half of the travel is seen from the middle.
            if (zones_->size() > 1) {
                const double nearest = zones_->look(zone, halfway).distance_mm - 0.5 * speed;
                if (nearest >= goal()) {
                    lowest_floor = std::min(lowest_floor, nearest);
                    continue;
                }
            }
            const Instant start = instant(zone, first, 0), end = instant(zone, last, 1);
            take(start);
            take(end);
            push(stretch(start, end, bend));
            for (int look = 0; count > 0 && look < kMostLooks; ++look) {
                const Stretch s = open[static_cast<std::size_t>(--count)];
                if (s.floor >= goal()) {
                    lowest_floor = std::min(lowest_floor, s.floor);
                    continue;
                }
                const double t = next(s, bend, look);
                const Instant middle = instant(zone, place(seen, t), t);
                take(middle);
                const Stretch left = stretch(s.a, middle, bend), right = stretch(middle, s.b, bend);
                push(left.floor < right.floor ? right : left);
                push(left.floor < right.floor ? left : right);
            }
        }
        const double far = std::min(near, bound);
        if (best.distance >= far) best.distance = std::max(far, std::min(lowest_floor, best.distance));
        return best;
    }

    PlanePoint edge_normal(const ZonesView& v, const Least& nearest) const {
        const PlanePoint normal = zones_->look(nearest.zone, v.at).normal;
        if (nearest.t <= 0 || nearest.t >= 1) return normal;
        const PlanePoint other = zones_->other_normal(nearest.zone, v.at, kEdgeMm);
        const double slope = dot(normal, v.rate), rate = dot(other, v.rate);
        if (!(slope * rate < 0)) return normal;
        return std::abs(rate) * normal + std::abs(slope) * other;
    }

    std::shared_ptr<const ConvexZones> zones_;
    Vec3 start_;
    CurvedLine line_;
    Box3 box_;
    bool turns_ = false;
    Frame frame_;       // about the axis, where it does not turn
    Vec3 tip1_, tip2_;  // the travel in this frame
};

}  // namespace

std::unique_ptr<field::Shape> make_profile_sweep(std::shared_ptr<const ConvexZones> zones,
                                                 const motion::Move& move) {
    if (move.arc) return std::make_unique<LevelArcSweep>(std::move(zones), move);
    if (!move.quadratic && move.start.axis == move.end.axis) {
        const StraightFrame path(move.start.tip_mm, move.end.tip_mm - move.start.tip_mm, move.start.axis);
        if (path.line.rise == 0) return std::make_unique<LevelLineSweep>(std::move(zones), path);
    }
    return std::make_unique<SearchedSweep>(std::move(zones), move);
}

}  // namespace tribo::milling
