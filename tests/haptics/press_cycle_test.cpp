// SPDX-License-Identifier: MIT
// A hand that presses fast: down into a slot, sideways into a thin rib or across it, along an edge, held, and
// lifted. The rib holds it as long as it presses, and nothing is felt soon after it has left.
#include <cstdio>
#include <gtest/gtest.h>
#include <span>

#include "base/noise_hash.hpp"
#include "base/spiral.hpp"
#include "field/carved/carved_field.hpp"
#include "field/shape/box_shape.hpp"
#include "haptics/contact/field_contact.hpp"
#include "milling/sweep/sweep.hpp"
#include "motion/path/moves.hpp"

namespace tribo::haptics {
namespace {

constexpr double kStiffness = 0.5;  // N/mm

// Slots along x with ribs between them, milled by one flat cutter.
struct Slots {
    std::unique_ptr<field::CarvedField> field;
    double pitch_mm = 0, width_mm = 0, depth_mm = 0;
    // How far the cutter's axis leans to either side over the length of a slot, rad; 0: straight sweeps.
    double lean_rad = 0;
    std::vector<std::unique_ptr<const field::Shape>> sweeps;  // of the slot in the middle
};

constexpr double kLeaning = 0.2;  // a wall's way out from bottom to top, at most, mm
constexpr double kLength = 40;    // of a slot, about x = 0
constexpr int kSlots = 6;         // on each side of the one in the middle

motion::Move slot_move(double y, double depth, double lean) {
    const auto axis = [](double angle) { return Vec3{0, std::sin(angle), std::cos(angle)}; };
    motion::Move move;
    move.start = {{-0.5 * kLength - 5, y, -depth}, axis(-lean)};
    move.end = {{0.5 * kLength + 5, y, -depth}, axis(lean)};
    return move;
}

Slots slots(double pitch, double width, double depth, double cell, double lean = 0) {
    Slots s{nullptr, pitch, width, depth, lean, {}};
    const double reach = (kSlots + 1) * pitch;
    s.field = std::make_unique<field::CarvedField>(
        std::make_unique<field::BoxShape>(
            Box3{{-0.5 * kLength, -reach, -depth - 5}, {0.5 * kLength, reach, 0}}),
        cell);
    milling::Cutter cutter;
    cutter.diameter_mm = width;
    cutter.length_mm = depth + 20;
    for (int n = -kSlots; n <= kSlots; ++n) {
        for (const motion::Move& piece : motion::to_elementary(slot_move(n * pitch, depth, lean))) {
            s.field->carve(milling::make_sweep(cutter, piece));
            if (n == 0) s.sweeps.push_back(milling::make_sweep(cutter, piece));
        }
    }
    return s;
}

// How deep a ball in the middle slot stands in what is around the slot, below the stock's top.
double depth_beside(const Slots& s, Vec3 centre, double radius) {
    double air = 1e9;
    for (const auto& sweep : s.sweeps) air = std::min(air, sweep->distance_mm(centre));
    return air + radius;
}

// The place in the middle slot that is nearest to the probe, by a search that knows of no field: steps in all
// directions, each halved where none leads nearer.
Vec3 nearest_in_slot(const Slots& s, Vec3 probe, double radius) {
    Vec3 at{probe.x, 0, -s.depth_mm + radius + 0.5 * (s.width_mm - 2 * radius)};
    constexpr int kWays = 60;
    for (double step = 0.5; step > 1e-6;) {
        Vec3 best = at;
        for (int n = 0; n < kWays; ++n) {
            const Vec3 next = at + step * tribo::test::spiral_direction(n, kWays);
            if (depth_beside(s, next, radius) <= 0 && distance(next, probe) < distance(best, probe))
                best = next;
        }
        if (best == at) step *= 0.5;
        at = best;
    }
    return at;
}

struct Found {
    long ticks = 0, holds = 0;
    long lost = 0;    // holds that do not push back as the way says
    long in_air = 0;  // forces after the probe has left
    long inward = 0;  // forces away from the proxy
    long kicks = 0;   // forces that grow by more than the probe's way explains
    void operator+=(const Found& f) {
        ticks += f.ticks;
        holds += f.holds;
        lost += f.lost;
        in_air += f.in_air;
        inward += f.inward;
        kicks += f.kicks;
    }
};

// A hand that draws its probe and its ways by chance, and what is wrong with what it feels.
class Hand {
  public:
    Hand(const Slots& slots, std::uint64_t seed, std::span<const double> radii_mm)
        : slots_(slots), noise_(seed), contact_(*slots.field) {
        constexpr double kRates[] = {1000, 4000, 10000};
        rate_hz_ = kRates[choice(3)];
        radius_ = radii_mm[static_cast<std::size_t>(choice(static_cast<int>(radii_mm.size())))];
        friction_ = choice(2) == 0 ? 0 : 0.4;
        ContactOptions options;
        options.stiffness_n_per_mm = kStiffness;
        options.probe_radius_mm = radius_;
        options.tick_s = 1 / rate_hz_;
        options.friction_static = friction_;
        options.friction_kinetic = 0.7 * friction_;
        contact_.set_options(options);
    }

    void feel(const contact::DistanceField& field) { contact_.set_field(field); }

  protected:
    double between(double low, double high) { return low + (high - low) * noise_.uniform(drawn_++); }
    int choice(int count) {
        return static_cast<int>(noise_.bits(drawn_++) % static_cast<std::uint64_t>(count));
    }
    int ticks(double seconds) const { return static_cast<int>(std::ceil(seconds * rate_hz_)); }

    void begin(Vec3 at) {
        at_ = last_ = at;
        tick(at);
    }
    ProbeContact tick(Vec3 probe) {
        const ProbeContact c = contact_.update(probe);
        ++found_.ticks;
        EXPECT_LE(contact_.queries(), FieldContact::kMostQueries);
        if (dot(c.force_n, c.proxy_mm - probe) < -1e-12) ++found_.inward;
        // What has not settled never kicks.
        if (!c.settled) {
            EXPECT_LE(length(c.force_n), length(force_) + kStiffness * distance(probe, last_) + 1e-12);
        }
        const double way = distance(probe, last_) * (1 + friction_) * 1.05 + 4e-3;
        if (length(c.force_n) > length(force_) + kStiffness * way) ++found_.kicks;
        force_ = c.force_n;
        last_ = probe;
        return c;
    }
    void go(Vec3 to, double mm_per_s) {
        const Vec3 from = at_;
        const int count = std::max(1, ticks(distance(from, to) / mm_per_s));
        for (int n = 1; n <= count; ++n) {
            at_ = from + static_cast<double>(n) / count * (to - from);
            tick(at_);
        }
    }
    // 40 ms; in the second half of it the force is at least so much of the spring's, and where nothing rubs
    // at most so much.
    void hold(double least_mm, double most_mm) {
        bool held = true;
        const int count = ticks(0.04);
        for (int n = 0; n < count; ++n) {
            const ProbeContact c = tick(at_);
            if (n < ticks(0.02)) continue;
            const double held_mm = length(c.force_n) / kStiffness;
            held = held && held_mm >= least_mm && (friction_ > 0 || held_mm <= most_mm);
        }
        ++found_.holds;
        if (!held) ++found_.lost;
    }
    // Up, and out of the cone of friction, which holds a probe that has gone through a rib so long.
    void lift(double height, double aside_mm) {
        go({at_.x, at_.y, radius_ + friction_ * aside_mm + height}, between(300, 2000));
        for (int n = 0; n < ticks(0.005); ++n) tick(at_);
        if (length(force_) > 0) ++found_.in_air;
    }

    const Slots& slots_;
    CounterNoise noise_;
    std::uint64_t drawn_ = 0;
    FieldContact contact_;
    double rate_hz_ = 1000, radius_ = 0, friction_ = 0;
    Vec3 at_, last_, force_;
    Found found_;
};

// Down into a slot, sideways into its wall, held, and up.
class Press : public Hand {
  public:
    Press(const Slots& slots, std::uint64_t seed) : Hand(slots, seed, kRadii) {}
    Found run() {
        const double half = 0.5 * slots_.width_mm, y = between(-0.3, 0.3) * (half - radius_);
        const double floor = -slots_.depth_mm + radius_;
        const bool on_floor = choice(2) == 0;
        const double z = on_floor ? floor - between(0, 0.5) : floor + between(0.2, 0.6) * slots_.depth_mm;
        const double side = choice(2) == 0 ? -1 : 1;
        begin({between(-8, 8), y, 3});
        go({at_.x, y, z}, between(50, 2000));
        // Wall to wall: first into the other one.
        if (choice(3) == 0) go({at_.x, -side * half, z}, between(300, 2000));
        go({at_.x + between(-1, 1), side * (half - radius_ + between(0.3, 0.7)), z}, between(300, 2000));
        const double way = distance(nearest_in_slot(slots_, at_, radius_), at_);
        hold(0.95 * way, 1.05 * way + 1e-3);
        lift(between(0.2, 2), std::abs(at_.y) - half + radius_ + kLeaning);
        return found_;
    }

  private:
    static constexpr double kRadii[] = {0, 0.05, 0.1, 0.2, 0.5};
};

// Onto the ribs from above, across their edges as deep as it presses, held, and up; also balls that are as
// wide as a slot or wider.
class Ride : public Hand {
  public:
    Ride(const Slots& slots, std::uint64_t seed) : Hand(slots, seed, kRadii) {}
    Found run() {
        begin({between(-8, 8), between(-3, 3), radius_ + 2});
        // One draw after the other: compilers evaluate the arguments of a call in different orders.
        const Vec3 down{at_.x, at_.y, radius_ - between(0.1, 1.5)};
        go(down, between(100, 2000));
        for (int legs = 1 + choice(3); legs > 0; --legs) {
            const Vec3 to{std::clamp(at_.x + between(-2, 2), -9.0, 9.0),
                          std::clamp(at_.y + between(-4, 4), -4.0, 4.0), radius_ - between(0.05, 1.5)};
            go(to, between(300, 2000));
        }
        // A centre in material has to come out of it and be a radius away.
        const double deep = depth_in_stock(at_);
        hold(deep > 0 ? 0.95 * (deep + radius_) : 0, 1e30);
        lift(between(0.3, 2), 10);
        return found_;
    }

  private:
    static constexpr double kRadii[] = {0, 0.1, 0.2, 0.5, 0.95, 1, 2};
    double depth_in_stock(Vec3 p) const {
        double air = -p.z;
        for (int n = -kSlots; n <= kSlots; ++n)
            air = std::min(air, depth_beside(slots_, p - Vec3{0, n * slots_.pitch_mm, 0}, 0));
        return air;
    }
};

// 0 of each but the kicks: what they are of the ticks.
template <class Cycle>
void expect_none(std::uint64_t cycles, double kicks_of_cycles) {
    for (const double lean : {0.0, 0.15}) {
        const Slots thin = slots(2.2, 2, 3, 0.2, lean);
        const Slots thick = slots(3, 2, 3, 0.4, lean);
        Found found;
        for (std::uint64_t n = 0; n < cycles / 2; ++n) {
            const Found one = Cycle(n % 2 == 0 ? thin : thick, n).run();
            if (one.lost + one.in_air + one.inward + one.kicks > 0)
                std::printf("lean %g, cycle %lu: lost %ld, in air %ld, inward %ld, kicks %ld\n", lean,
                            static_cast<unsigned long>(n), one.lost, one.in_air, one.inward, one.kicks);
            found += one;
        }
        EXPECT_EQ(found.lost, 0) << lean;
        EXPECT_EQ(found.in_air, 0) << lean;
        EXPECT_EQ(found.inward, 0) << lean;
        EXPECT_LE(static_cast<double>(found.kicks), kicks_of_cycles * static_cast<double>(cycles)) << lean;
        EXPECT_EQ(found.holds, static_cast<long>(cycles / 2));
    }
}

TEST(PressCycle, no_rib_is_lost_and_no_air_pushes) {
    expect_none<Press>(1000, 0);
}

// A ball that is exactly as wide as a slot is held now by one edge of it, now by the other: 3 kicks in 3,000
// cycles, as such balls settle.
TEST(PressCycle, no_edge_catches_a_probe_that_rides_over_it) {
    expect_none<Ride>(1500, 0.005);
}

// Cycles that failed in five-axis slots. In a corner of bent sides the proxy came to stand up to 1 um in
// material and was set back to its anchor (kicks), or stood still, as a side near it left no room for its
// next anchor (19519, 47929, 51003). A flight close to a floor and a wall was not done in its tick (8139,
// 29597), or came down on a wall that the probe was not behind (61990), or again and again above a rounded
// edge (63177). On a floor the step between two pieces of a sweep, a nanometre high, was taken for the place
// below the ball (102461, 103715), or the depth in a searched sweep was 70 nm
// short here and right there, a step that no way led over (4261, 6892, 115751, 116515, 116927), or a piece
// whose floor is 60 nm higher was taken for the one below it (21340). Beside a wall the nearest place leapt
// from the floor to the wall, and the margin that was proven for all but the floor hid the floor (24362,
// 82034, 105835, 324549, 441051). A flight low above a floor took so many small steps that it came down a
// tick late (228229). A landing 0.2 um below a floor met the rim of a cutter that had stood there, and that
// was taken for a wall (33109). Beside such a rim a wall was taken for air, as the way between the others
// hardly goes behind it (36280, 48080, 55250).
TEST(PressCycle, corners_of_bent_sides_neither_set_the_proxy_back_nor_hold_it) {
    const Slots thin = slots(2.2, 2, 3, 0.2, 0.15), thick = slots(3, 2, 3, 0.4, 0.15);
    for (const std::uint64_t n :
         {4261u,  6892u,   8139u,   12747u,  13342u,  19519u,  21340u,  23378u,  27106u,  29597u,
          47929u, 51003u,  61990u,  63177u,  102461u, 103715u, 115751u, 116515u, 116927u, 24362u,
          82034u, 105835u, 324549u, 441051u, 228229u, 33109u,  36280u,  48080u,  55250u}) {
        const Found one = Press(n % 2 == 0 ? thin : thick, n).run();
        EXPECT_EQ(one.lost + one.in_air + one.inward + one.kicks, 0) << n;
    }
}

// A field that finds each nearest place also without what is known from the queries before.
class Checked final : public contact::DistanceField {
  public:
    explicit Checked(const contact::DistanceField& field) : field_(field) {}
    double distance_mm(Vec3 p) const override { return field_.distance_mm(p); }
    Vec3 normal(Vec3 p) const override { return field_.normal(p); }
    contact::SurfaceSample sample(Vec3 p) const override { return field_.sample(p); }
    contact::SurfaceSample sample_piece(std::uint32_t piece, Vec3 p) const override {
        return field_.sample_piece(piece, p);
    }
    double clearance_mm(Vec3 p, double enough_mm) const override { return field_.clearance_mm(p, enough_mm); }
    contact::SurfaceSample nearest(Vec3 p, double within_mm, contact::NearHint& hint) const override {
        contact::NearHint none;
        none.at_mm = none.from_mm = p;
        const contact::SurfaceSample seen = field_.nearest(p, within_mm, hint),
                                     truth = field_.nearest(p, within_mm, none);
        if (truth.distance_mm > 0 && truth.distance_mm < within_mm && none.sides.count > 0)
            worst_mm = std::max(worst_mm, seen.distance_mm - truth.distance_mm);
        return seen;
    }
    mutable double worst_mm = 0;

  private:
    const contact::DistanceField& field_;
};

// In the corners of a leaning slot a ball comes from the floor to a wall and back. Following the one led to
// the other, and the one was forgotten: up to 25 um too far in 55 of 3,000 cycles, these among them.
TEST(PressCycle, no_place_that_was_known_is_forgotten) {
    const Slots thin = slots(2.2, 2, 3, 0.2, 0.15), thick = slots(3, 2, 3, 0.4, 0.15);
    for (const std::uint64_t n :
         {164u, 213u, 216u, 267u, 335u, 377u, 405u, 596u, 774u, 1161u, 1523u, 1908u, 2253u, 2781u}) {
        const Slots& of = n % 2 == 0 ? thin : thick;
        const Checked field(*of.field);
        Press cycle(of, n);
        cycle.feel(field);
        (void)cycle.run();
        EXPECT_LE(field.worst_mm, 1e-4) << n;
    }
}

// For a long `make soak`.
TEST(PressCycle, DISABLED_no_rib_is_lost_and_no_air_pushes_in_a_million) {
    expect_none<Press>(1'000'000, 0);
}

// A stock, a probe and a path that lost the rib for good: 0.2 mm ribs, one tick per 1.3 mm.
TEST(PressCycle, a_rib_that_is_crossed_within_two_ticks_pushes_back_at_once) {
    const Slots thin = slots(2.2, 2, 3, 0.2);
    ContactOptions options;
    options.stiffness_n_per_mm = kStiffness;
    options.probe_radius_mm = 0.2;
    FieldContact contact(*thin.field, options);
    for (int n = 0; n <= 100; ++n) contact.update({0, 0, 2 - 0.049 * n});
    contact.update({0, 1.3, -2.9});
    for (int n = 0; n < 498; ++n) {
        const ProbeContact c = contact.update({0, 2.1, -2.9});
        ASSERT_NEAR(c.force_n.y, -0.65, 0.0325) << n;
        ASSERT_TRUE(c.settled) << n;
    }
}

}  // namespace
}  // namespace tribo::haptics
