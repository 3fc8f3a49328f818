// SPDX-License-Identifier: MIT
// A probe that rests on stock while another thread cuts it away: the servo never waits, what it feels never
// kicks, and in the end the probe is on the new surface.
#include <atomic>
#include <chrono>
#include <cmath>
#include <gtest/gtest.h>
#include <thread>

#include "field/carved/field_reader.hpp"
#include "field/shape/box_shape.hpp"
#include "haptics/contact/field_contact.hpp"
#include "milling/sweep/sweep.hpp"

namespace tribo::haptics {
namespace {

constexpr double kStiffness = 0.5;
// Material only goes, so a probe that stands still is pressed less and less: N in a tick, upwards.
constexpr double kMostRise = 1e-3;

std::unique_ptr<const field::Shape> pass(double radius, double y, double bottom, double from = -10,
                                         double to = 30) {
    milling::Cutter cutter;
    cutter.diameter_mm = 2 * radius;
    cutter.length_mm = 30;
    motion::Move move;
    move.start.tip_mm = {from, y, bottom};
    move.end.tip_mm = {to, y, bottom};
    return milling::make_sweep(cutter, move);
}

field::CarvedField block() {
    return {std::make_unique<field::BoxShape>(Box3{{0, 0, -6}, {20, 20, 0}}), 0.25};
}

ContactOptions options(double radius) {
    ContactOptions o;
    o.stiffness_n_per_mm = kStiffness;
    o.probe_radius_mm = radius;
    return o;
}

struct Rested {
    double most_rise_n = 0;
    ProbeContact last;
    bool inward = false;
};

// Cuts one sweep after the other, each felt for a tick or more.
struct Carver {
    std::atomic<long> ticks = 0;
    std::atomic<bool> done = false;

    void cut(field::CarvedField& field, std::unique_ptr<const field::Shape> sweep) {
        field.carve(std::move(sweep));
        const long seen = ticks + 2;
        while (ticks < seen) std::this_thread::yield();
    }
};

// Ticks as long as the other thread cuts, and 200 more.
Rested rest(field::FieldReader& reader, FieldContact& contact, Vec3 probe, Carver& carver) {
    Rested r;
    double last = 1e9;
    int after = 0;
    while (after < 200) {
        if (carver.done) ++after;
        (void)reader.refresh();
        r.last = contact.update(probe);
        const double force = length(r.last.force_n);
        r.most_rise_n = std::max(r.most_rise_n, force - last);
        r.inward = r.inward || dot(r.last.force_n, r.last.normal) < 0;
        last = force;
        ++carver.ticks;
    }
    return r;
}

TEST(CutUnderProbe, follows_the_surface_down_without_a_kick) {
    for (const double radius : {0.0, 0.4}) {
        field::CarvedField field = block();
        field::FieldReader reader(field);
        FieldContact contact(reader, options(radius));
        const Vec3 probe{10, 10, radius - 2};
        (void)contact.update({10, 10, 2});
        EXPECT_NEAR(contact.update(probe).force_n.z, kStiffness * 2, 1e-6);
        Carver carver;
        std::thread thread([&] {
            for (int layer = 1; layer <= 20; ++layer) {
                for (const double y : {7.5, 10.0, 12.5}) carver.cut(field, pass(2, y, -0.05 * layer));
            }
            carver.done = true;
        });
        const Rested r = rest(reader, contact, probe, carver);
        thread.join();
        EXPECT_LT(r.most_rise_n, kMostRise) << radius;
        EXPECT_FALSE(r.inward);
        EXPECT_NEAR(r.last.force_n.z, kStiffness * 1, 1e-6) << radius;
        EXPECT_NEAR(r.last.proxy_mm.z, -1 + radius, 1e-6);
    }
}

// A cutter that comes along beside the probe, then through it: off the top, then nothing holds.
TEST(CutUnderProbe, lets_go_where_nothing_is_left) {
    for (const double radius : {0.0, 0.4}) {
        field::CarvedField field = block();
        field::FieldReader reader(field);
        FieldContact contact(reader, options(radius));
        const Vec3 probe{10, 10, radius - 1};
        (void)contact.update({10, 10, 2});
        (void)contact.update(probe);
        Carver carver;
        std::thread thread([&] {
            for (int n = 0; n < 60; ++n) carver.cut(field, pass(3, 10, -4, -4 + 0.3 * n, -3.7 + 0.3 * n));
            carver.done = true;
        });
        const Rested r = rest(reader, contact, probe, carver);
        thread.join();
        EXPECT_LT(r.most_rise_n, kMostRise) << radius;
        EXPECT_FALSE(r.last.in_contact) << radius;
        EXPECT_EQ(length(r.last.force_n), 0);
        EXPECT_NEAR(distance(r.last.proxy_mm, probe), 0, 1e-9);
    }
}

// A sweep that takes as long to carve as the servo likes: until it has ticked so often.
class SlowSweep final : public field::Shape {
  public:
    SlowSweep(std::unique_ptr<const field::Shape> sweep, const std::atomic<long>& ticks,
              std::atomic<bool>& late)
        : sweep_(std::move(sweep)), ticks_(ticks), late_(late) {}
    Box3 bounds_mm() const override { return sweep_->bounds_mm(); }
    double distance_mm(Vec3 p) const override { return sweep_->distance_mm(p); }
    double distance_below(Vec3 p, double bound) const override { return sweep_->distance_below(p, bound); }
    Vec3 gradient(Vec3 p) const override { return sweep_->gradient(p); }
    void sample(const field::Lattice& lattice, float* out) const override {
        constexpr long kTicks = 1000;
        const auto begin = std::chrono::steady_clock::now();
        while (ticks_ < kTicks && !late_) {
            if (std::chrono::steady_clock::now() - begin > std::chrono::seconds(20)) late_ = true;
            std::this_thread::yield();
        }
        sweep_->sample(lattice, out);
    }

  private:
    std::unique_ptr<const field::Shape> sweep_;
    const std::atomic<long>& ticks_;
    std::atomic<bool>& late_;
};

// While a carve is going on and cannot end before it has ticked, the servo ticks.
TEST(CutUnderProbe, never_waits_for_the_carver) {
    field::CarvedField field = block();
    field.carve(pass(2, 10, -0.5));
    field::FieldReader reader(field);
    FieldContact contact(reader, options(0));
    (void)contact.update({10, 10, 2});
    std::atomic<long> ticks = 0;
    std::atomic<bool> late = false, done = false;
    std::thread carver([&] {
        field.carve(std::make_unique<SlowSweep>(pass(2, 10, -0.7), ticks, late));
        done = true;
    });
    ProbeContact c;
    for (; !done; ++ticks) {
        (void)reader.refresh();
        c = contact.update({10, 10, -1});
        if (ticks < 1000) {
            EXPECT_NEAR(c.force_n.z, kStiffness * 0.5, 1e-6);
        }
    }
    carver.join();
    EXPECT_FALSE(late);
    EXPECT_TRUE(reader.refresh() || reader.version() > 1);
    for (int n = 0; n < 3; ++n) c = contact.update({10, 10, -1});
    EXPECT_NEAR(c.force_n.z, kStiffness * 0.3, 1e-6);
}

}  // namespace
}  // namespace tribo::haptics
