// SPDX-License-Identifier: MIT
#include "base/hash.hpp"
#include "golden/golden.hpp"
#include "golden/golden_grooves.hpp"
#include "haptics/servo/force_table_player.hpp"
#include "haptics/servo/simulated_hand.hpp"
#include "session/cut/stock_at_time.hpp"
#include "session/feel/feel_session.hpp"
#include "session/live/force_look_ahead.hpp"

namespace tribo::golden {
namespace {

constexpr double kTickS = 1e-3;

// A hand that follows a stroke over the grooves for a second: what each tick did. `between(now_s)` comes
// before each tick.
template <class Between>
void rub(haptics::ForceSource& source, Hash& hash, const Between& between) {
    haptics::SimulatedHand hand(
        haptics::Stroke({{0, {4, 4, 2}}, {0.2, {6, 5, -2}}, {0.8, {15, 11, -2}}, {1, {16, 12, 2}}}), kTickS);
    haptics::Servo servo(hand, source, session::safety_limits(hand, 1 / kTickS), 2e-3);
    int touching = 0;
    for (int n = 0; n < 1000; ++n) {
        between(n * kTickS);
        const haptics::ServoTick tick = servo.tick(n * kTickS);
        hash.add(tick.position_mm);
        hash.add(tick.force_n);
        touching += tick.touching ? 1 : 0;
    }
    hash.add(touching);
}

}  // namespace

// A point, a ball with friction and a finger on a milled part; then the cut itself, with its table of forces
// and its textures, while the part is milled.
std::uint64_t haptics() {
    Hash hash;
    session::ForceLookAhead ahead(grooves(), serial_for);
    if (!ahead.run([] { return true; })) return 0;
    session::MillSession milled(grooves(), serial_for);
    if (!milled.run({})) return 0;
    haptics::ContactOptions options;
    options.tick_s = kTickS;
    const auto still = [](double) {};
    session::InspectSource point(milled.stock(), options);
    rub(point, hash, still);
    options.probe_radius_mm = 0.5;
    options.friction_static = 0.4;
    options.friction_kinetic = 0.3;
    session::InspectSource ball(milled.stock(), options);
    rub(ball, hash, still);
    options.probe_radius_mm = 0;
    session::InspectSource finger(milled.stock(), options, haptics::ProbeShape::cylinder(3));
    rub(finger, hash, still);

    const session::CutterTrack track(grooves());
    haptics::ForceTablePlayer force(1 / kTickS);
    force.replace(ahead.table({}, {}), {});
    const haptics::TextureMap textures = ahead.textures();
    session::StockAtTime stock(grooves(), serial_for, 0);
    session::CutSourceOptions cut;
    cut.part = &stock.reader();
    cut.tick_s = cut.contact.tick_s = kTickS;
    cut.finger_mm = 8;
    session::CutSource source(track, force, textures, cut);
    rub(source, hash, [&](double now_s) { stock.advance(now_s); });
    return textures.records().empty() ? 0 : hash.value();
}

}  // namespace tribo::golden
