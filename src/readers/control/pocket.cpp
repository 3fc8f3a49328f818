// SPDX-License-Identifier: MIT
#include "readers/control/pocket.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"

namespace tribo::readers::control {
namespace {

constexpr double kSameMm = 1e-6;
constexpr double kUsualStep = 0.8;  // of the tool's diameter, from ring to ring

double step_count(const Pocket& pocket) {
    const double height = pocket.depths.top - pocket.depths.bottom;
    return pocket.infeed > 0 ? std::max(1.0, std::ceil(height / pocket.infeed - 1e-9)) : 1;
}

double step_of(const Pocket& pocket) {
    return pocket.step > 0 ? pocket.step : kUsualStep * 2 * pocket.radius;
}

double rings_of_pass(const Pocket& pocket) {
    const double outer = pocket.radius + pocket.allowance, step = step_of(pocket);
    if (pocket.along_edge || !(step > 0)) return 1;
    return std::floor(std::min(pocket.half_width - outer, pocket.half_length - outer) / step + 1e-9) + 1;
}

// Rings of a slot beside the line in its middle.
double rings_of_slot_pass(const Pocket& slot) {
    const double most = slot.half_width - slot.radius - slot.allowance, step = step_of(slot);
    if (!(most > kSameMm)) return 0;
    return slot.along_edge || !(step > 0) ? 1 : std::max(1.0, std::ceil(most / step - 1e-9));
}

double rings_of_stud_pass(const Pocket& stud) {
    const double step = step_of(stud);
    const double left =
        std::max(stud.blank_half_length - stud.half_length, stud.blank_half_width - stud.half_width) -
        stud.allowance;
    if (stud.along_edge || !(step > 0) || !(left > 0)) return 1;
    return std::max(1.0, std::ceil(left / step - 1e-9));
}

class Mill {
  public:
    Mill(const Pocket& shape, Vec3 from, const PocketMove& go)
        : shape_(shape),
          go_(go),
          now_(from),
          cosine_(math::cos(shape.angle_rad)),
          sine_(math::sin(shape.angle_rad)) {}

    Vec3 at(double x, double y, double z) const {
        return {shape_.centre.x + cosine_ * x - sine_ * y, shape_.centre.y + sine_ * x + cosine_ * y, z};
    }
    Vec3 now() const { return now_; }

    Result<void> to(Vec3 place, std::optional<double> feed, const std::optional<motion::Arc>& arc = {}) {
        now_ = place;
        return go_(place, feed, arc);
    }

    // A rectangle of half sides a and b with round corners, from the middle of its lower side.
    Result<void> ring(double a, double b, double corner, double z) {
        const double way = shape_.clockwise ? -1 : 1;
        // Clockwise: the same ring, seen in a mirror.
        const auto on_ring = [&](double x, double y) { return at(way * x, y, z); };
        struct Corner {
            double x, y;    // of the corner
            double dx, dy;  // of the side that leads to it
        };
        const Corner corners[] = {{a, -b, 1, 0}, {a, b, 0, 1}, {-a, b, -1, 0}, {-a, -b, 0, -1}};
        if (auto done = to(on_ring(0, -b), shape_.feed); !done) return done;
        for (const Corner& c : corners) {
            if (auto done = to(on_ring(c.x - corner * c.dx, c.y - corner * c.dy), shape_.feed); !done)
                return done;
            if (!(corner > kSameMm)) continue;
            const Vec3 centre = on_ring(c.x - corner * (c.dx + c.dy), c.y - corner * (c.dy - c.dx));
            if (auto done = turn(centre, way * math::kHalfPi, z); !done) return done;
        }
        return to(on_ring(0, -b), shape_.feed);
    }

    // Turns about a centre at the feed.
    Result<void> turn(Vec3 centre, double turn_rad, double z) {
        const Turn turned = turn_about(now_, centre, turn_rad, z);
        return to(turned.to, shape_.feed, turned.arc);
    }

  private:
    const Pocket& shape_;
    const PocketMove& go_;
    Vec3 now_;
    double cosine_, sine_;
};

// Rings about a stud with equal sides, in a round blank.
double rings_of_polygon_pass(const Polygon& polygon) {
    const Pocket& stud = polygon.stud;
    const double step = step_of(stud), left = stud.blank_half_width - stud.half_width - stud.allowance;
    if (stud.along_edge || !(step > 0) || !(left > 0)) return 1;
    return std::max(1.0, std::ceil(left / step - 1e-9));
}

}  // namespace

Turn turn_about(Vec3 from, Vec3 centre, double turn_rad, double z) {
    double sine = 0, cosine = 0;
    math::sincos(turn_rad, sine, cosine);
    const double u = from.x - centre.x, v = from.y - centre.y;
    Turn turned;
    turned.to = {centre.x + cosine * u - sine * v, centre.y + sine * u + cosine * v, z};
    turned.arc.centre_mm = {centre.x, centre.y, from.z};
    turned.arc.normal = {0, 0, turn_rad < 0 ? -1.0 : 1.0};
    turned.arc.turn_rad = std::abs(turn_rad);
    return turned;
}

double ring_count(const Pocket& pocket) {
    return step_count(pocket) * rings_of_pass(pocket);
}

double stud_ring_count(const Pocket& stud) {
    return step_count(stud) * rings_of_stud_pass(stud);
}

double ring_count(const CurvedSlot& slot) {
    return step_count(slot.pocket) * (1 + rings_of_slot_pass(slot.pocket));
}

double ring_count(const Polygon& polygon) {
    return step_count(polygon.stud) * rings_of_polygon_pass(polygon);
}

// A slot as wide as the tool is a line there and back.
Result<void> mill_pocket(const Pocket& pocket, Vec3 from, const PocketMove& go) {
    const PocketDepths& depths = pocket.depths;
    const double passes = step_count(pocket), rings = rings_of_pass(pocket), step = step_of(pocket);
    const double outer = pocket.radius + pocket.allowance;
    const double width = pocket.half_width - outer, length = pocket.half_length - outer;
    const double start = std::max(0.0, length - std::max(width, 0.0));  // of the line within a slot
    Mill mill(pocket, from, go);
    if (auto done = mill.to({from.x, from.y, depths.back}, {}); !done) return done;
    if (auto done = mill.to(mill.at(-start, 0, depths.back), {}); !done) return done;
    if (auto done = mill.to(mill.at(-start, 0, depths.near), {}); !done) return done;
    for (double pass = 1; pass <= passes; ++pass) {
        const double z = depths.top - (depths.top - depths.bottom) * pass / passes;
        if (auto done = mill.to(mill.at(-start, 0, z), pocket.plunge); !done) return done;
        for (double ring = rings - 1; ring >= 0; --ring) {
            const double a = std::max(length - ring * step, 0.0), b = std::max(width - ring * step, 0.0);
            if (b < kSameMm) {
                if (auto done = mill.to(mill.at(a, 0, z), pocket.feed); !done) return done;
                if (auto done = mill.to(mill.at(-a, 0, z), pocket.feed); !done) return done;
                continue;
            }
            const double corner = std::clamp(pocket.corner - outer - ring * step, 0.0, std::min(a, b));
            if (auto done = mill.ring(a, b, corner, z); !done) return done;
        }
        if (auto done = mill.to(mill.at(-start, 0, z), pocket.feed); !done) return done;
    }
    return mill.to(mill.at(-start, 0, depths.back), {});
}

// The middle of the slot, there or back, and then rings about it: along one side, round an end, back along
// the other side, round the start.
Result<void> mill_slot(const CurvedSlot& slot, Vec3 from, const PocketMove& go) {
    const Pocket& pocket = slot.pocket;
    const PocketDepths& depths = pocket.depths;
    const double passes = step_count(pocket), rings = rings_of_slot_pass(pocket);
    const double most = pocket.half_width - pocket.radius - pocket.allowance;
    const double way = pocket.clockwise ? -1 : 1;  // a slot clockwise is one counter-clockwise in a mirror
    const double first = pocket.clockwise ? pocket.angle_rad + slot.sweep_rad : pocket.angle_rad;
    Mill mill(pocket, from, go);
    const auto place = [&](double radius, double angle, double z) {
        return Vec3{pocket.centre.x + radius * math::cos(angle), pocket.centre.y + radius * math::sin(angle),
                    z};
    };
    const double start = first, end = first + way * slot.sweep_rad;
    const Vec3 at_start = place(slot.arc_radius, start, 0), at_end = place(slot.arc_radius, end, 0);
    if (auto done = mill.to({from.x, from.y, depths.back}, {}); !done) return done;
    if (auto done = mill.to({at_start.x, at_start.y, depths.back}, {}); !done) return done;
    if (auto done = mill.to({at_start.x, at_start.y, depths.near}, {}); !done) return done;
    bool is_at_end = false;
    for (double pass = 1; pass <= passes; ++pass) {
        const double z = depths.top - (depths.top - depths.bottom) * pass / passes;
        if (auto done = mill.to({mill.now().x, mill.now().y, z}, pocket.plunge); !done) return done;
        if (auto done = mill.turn(pocket.centre, (is_at_end ? -way : way) * slot.sweep_rad, z); !done)
            return done;
        is_at_end = !is_at_end;
        for (double ring = 1; ring <= rings; ++ring) {
            const double out = most * ring / rings;
            // From the end that the tool is at: the outer side first where the ring begins there.
            if (is_at_end) {
                if (auto done = mill.to(place(slot.arc_radius - out, end, z), pocket.feed); !done)
                    return done;
                if (auto done = mill.turn(pocket.centre, -way * slot.sweep_rad, z); !done) return done;
                if (auto done = mill.turn(at_start, way * math::kPi, z); !done) return done;
                if (auto done = mill.turn(pocket.centre, way * slot.sweep_rad, z); !done) return done;
                if (auto done = mill.turn(at_end, way * math::kPi, z); !done) return done;
            } else {
                if (auto done = mill.to(place(slot.arc_radius + out, start, z), pocket.feed); !done)
                    return done;
                if (auto done = mill.turn(pocket.centre, way * slot.sweep_rad, z); !done) return done;
                if (auto done = mill.turn(at_end, way * math::kPi, z); !done) return done;
                if (auto done = mill.turn(pocket.centre, -way * slot.sweep_rad, z); !done) return done;
                if (auto done = mill.turn(at_start, way * math::kPi, z); !done) return done;
            }
        }
        const Vec3 middle = is_at_end ? at_end : at_start;
        if (rings > 0) {
            if (auto done = mill.to({middle.x, middle.y, z}, pocket.feed); !done) return done;
        }
    }
    return mill.to({mill.now().x, mill.now().y, depths.back}, {});
}

// The tool goes down beside the blank, below its lower side.
Result<void> mill_stud(const Pocket& stud, Vec3 from, const PocketMove& go) {
    const PocketDepths& depths = stud.depths;
    const double passes = step_count(stud), rings = rings_of_stud_pass(stud), step = step_of(stud);
    const double inner = stud.radius + stud.allowance;
    const double beside = std::max(stud.blank_half_width, stud.half_width) + 2 * stud.radius;
    Mill mill(stud, from, go);
    if (auto done = mill.to({from.x, from.y, depths.back}, {}); !done) return done;
    for (double pass = 1; pass <= passes; ++pass) {
        const double z = depths.top - (depths.top - depths.bottom) * pass / passes;
        if (auto done = mill.to(mill.at(0, -beside, mill.now().z), {}); !done) return done;
        if (auto done = mill.to(mill.at(0, -beside, z), stud.plunge); !done) return done;
        for (double ring = rings - 1; ring >= 0; --ring) {
            const double out = inner + ring * step;
            const double a = stud.half_length + out, b = stud.half_width + out;
            if (auto done = mill.ring(a, b, std::min({stud.corner + out, a, b}), z); !done) return done;
        }
        if (auto done = mill.to(mill.at(0, -beside, z), stud.feed); !done) return done;
        if (auto done = mill.to(mill.at(0, -beside, depths.back), {}); !done) return done;
    }
    return {};
}

// Each ring is the polygon within whose corners a round one turns. The tool goes down beside the blank,
// before the middle of the first side.
Result<void> mill_polygon(const Polygon& polygon, Vec3 from, const PocketMove& go) {
    const Pocket& stud = polygon.stud;
    const PocketDepths& depths = stud.depths;
    const double passes = step_count(stud), rings = rings_of_polygon_pass(polygon), step = step_of(stud);
    const double inner = stud.radius + stud.allowance, turn = math::kTwoPi / polygon.sides;
    const double corner = std::min(stud.corner, stud.half_width);
    const double half_side = (stud.half_width - corner) * math::tan(turn / 2);
    const double way = stud.clockwise ? -1 : 1;
    const double beside = std::max(stud.blank_half_width, stud.half_width) + 2 * stud.radius;
    Mill mill(stud, from, go);
    const auto on_side = [&](int side, double out, double along, double z) {
        double sine = 0, cosine = 0;
        math::sincos(way * side * turn, sine, cosine);
        return mill.at(cosine * out - way * sine * along, sine * out + way * cosine * along, z);
    };
    auto done = mill.to({from.x, from.y, depths.back}, {});
    for (double pass = 1; done && pass <= passes; ++pass) {
        const double z = depths.top - (depths.top - depths.bottom) * pass / passes;
        done = mill.to(on_side(0, beside, 0, mill.now().z), {});
        if (done) done = mill.to(on_side(0, beside, 0, z), stud.plunge);
        for (double ring = rings - 1; done && ring >= 0; --ring) {
            const double round = corner + inner + ring * step, out = stud.half_width - corner + round;
            done = mill.to(on_side(0, out, 0, z), stud.feed);
            for (int side = 0; done && side < polygon.sides; ++side) {
                done = mill.to(on_side(side, out, half_side, z), stud.feed);
                if (done)
                    done = mill.turn(on_side(side, stud.half_width - corner, half_side, z), way * turn, z);
            }
            if (done) done = mill.to(on_side(0, out, 0, z), stud.feed);
        }
        if (done) done = mill.to(on_side(0, beside, 0, z), stud.feed);
        if (done) done = mill.to(on_side(0, beside, 0, depths.back), {});
    }
    return done;
}

}  // namespace tribo::readers::control
