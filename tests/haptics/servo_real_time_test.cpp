// SPDX-License-Identifier: MIT
// Nothing in a tick allocates or locks: counted by a replaced operator new and a replaced pthread_mutex_lock.
// (Nothing throws either: every function of a tick is noexcept, so a throw would end this program.)
#include <array>
#include <cmath>
#include <gtest/gtest.h>

#include "base/counted_allocations.hpp"
#include "base/counted_locks.hpp"
#include "contact/force_table.hpp"
#include "haptics/contact/field_contact.hpp"
#include "haptics/contact/force_field.hpp"
#include "haptics/servo/servo.hpp"
#include "haptics/servo/simulated_hand.hpp"

namespace tribo::haptics {
namespace {

// Waves of 0.1 mm over 2 mm: grooves enough to slide over.
class Waves final : public contact::DistanceField {
  public:
    double distance_mm(Vec3 p) const override { return 0.9 * (p.z - 0.1 * std::sin(3 * p.x)); }
    Vec3 normal(Vec3 p) const override { return normalized(Vec3{-0.3 * std::cos(3 * p.x), 0, 1}); }
};

class Everything final : public ForceSource, public CuttingForce {
  public:
    Everything(const contact::DistanceField& field, contact::ForceTable table)
        : contact_(field), field_(ForceFieldOptions{}), table_(std::move(table)) {
        field_.set_contact(&contact_);
        field_.set_cutting(this);
    }
    RenderedForce render(const HandReading& hand, double now_s, double) noexcept override {
        field_.set_mode(now_s < 1 ? FeelMode::cut : FeelMode::inspect);
        FieldMoment moment;
        moment.at_s = now_s;
        moment.cutter = {{10 * now_s, 0, 0}, {0, 0, 1}, 3, 20};
        moment.finger = {hand.position_mm, {0, 0, 1}, 0.5, 40};
        const FieldForce f = field_.render(moment);
        RenderedForce felt;
        felt.contact_n = f.surface_n + f.texture_n;
        felt.driven_n = f.cutting_n;
        felt.touching = f.in_contact;
        felt.simulation_s = now_s;
        cut_ticks += squared_length(f.cutting_n) > 0 ? 1 : 0;
        contact_ticks += f.in_contact ? 1 : 0;
        return felt;
    }
    Vec3 force_n(double at_s) noexcept override {
        Vec3 force;
        return table_.force_at(at_s, 1000, cursor_, force) ? 0.01 * force : Vec3{};
    }
    int cut_ticks = 0, contact_ticks = 0;

  private:
    FieldContact contact_;
    ForceField field_;
    contact::ForceTable table_;
    contact::ForceTable::Cursor cursor_;
};

TEST(ServoRealTime, a_tick_neither_allocates_nor_locks_whatever_it_renders) {
    std::vector<contact::ForceStretch> cut(200);
    for (std::size_t n = 0; n < cut.size(); ++n) {
        cut[n].start_s = 0.01 * static_cast<double>(n);
        cut[n].end_s = cut[n].start_s + 0.01;
        cut[n].rate_rad_per_s = 600;
        cut[n].spectrum.harmonics.resize(4);
        cut[n].spectrum.harmonics[0].x = 100 + 50 * std::sin(0.2 * static_cast<double>(n));
        cut[n].spectrum.harmonics[1].y = 60;
    }
    const contact::ForceTableOptions options;
    Waves waves;
    Everything everything(waves, build_force_table(force_function(cut, options), options));
    SimulatedHand hand(Stroke({{0, {0, 0, 2}}, {0.3, {2, 0, -0.5}}, {1.8, {17, 3, -0.5}}, {2, {17, 3, 2}}}),
                       1e-3);
    Servo servo(hand, everything, {});
    const long allocations_before = test::allocations, locks_before = test::locks;
    for (int n = 0; n < 2000; ++n) {
        double now_s = n * 1e-3;
        if (n > 1950) now_s += 10;  // a fault too
        servo.tick(now_s);
    }
    EXPECT_EQ(test::allocations - allocations_before, 0);
    EXPECT_EQ(test::locks - locks_before, 0);
    EXPECT_GT(everything.cut_ticks, 500);
    EXPECT_GT(everything.contact_ticks, 500);
    EXPECT_EQ(servo.safety().count(Fault::clock_jump), 1U);
}

TEST(ServoRealTime, the_counters_count) {
#ifdef TRIBO_NOT_COUNTED
    GTEST_SKIP() << "the sanitizer has these functions";
#endif
    const long allocations_before = test::allocations, locks_before = test::locks;
    // Called by name: a new-expression without use may be left out by the compiler.
    ::operator delete(::operator new(8));
    pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
    pthread_mutex_lock(&mutex);
    pthread_mutex_unlock(&mutex);
    EXPECT_GT(test::allocations, allocations_before);
    EXPECT_EQ(test::locks, locks_before + 1);
}

}  // namespace
}  // namespace tribo::haptics
