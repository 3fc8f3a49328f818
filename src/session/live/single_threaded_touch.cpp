// SPDX-License-Identifier: MIT
#include "session/live/single_threaded_touch.hpp"

#include <algorithm>

#include "session/feel/feel_session.hpp"

namespace tribo::session {
namespace {

// Largest servo time that is caught up at once.
constexpr double kMostOwedS = 0.1;
// Force and texture are updated at the interval kRenewS of servo time, from the cut of the last kBehindS
// before the clock.
constexpr double kRenewS = 0.1, kBehindS = 0.15;
constexpr std::size_t kMostStretches = 400;

}  // namespace

void SingleThreadedTouch::renew() {
    LiveMill& mill = controller_.mill();
    const auto all = mill.record().rows();
    // After a restart or a change of the force: update at once.
    if (all.size() < stretches_ || force_changes_ != controller_.force_changes()) {
        force_changes_ = controller_.force_changes();
        renewed_s_ = -1;
        stretches_ = 0;
    }
    if (all.size() == stretches_ || mill.pace() <= 0 || now_s_ - renewed_s_ < kRenewS) return;
    renewed_s_ = now_s_;
    stretches_ = all.size();
    const double from = mill.clock_s() - kBehindS * mill.pace();
    std::size_t first = all.size() > kMostStretches ? all.size() - kMostStretches : 0;
    while (first < all.size() && all[first].end_s < from) ++first;
    const auto cut = all.subspan(first);
    controller_.finger().force_source().set_textures(texture_map(cut, mill.session().stock(), serial_for));
    auto recent = force_stretches(cut, mill.session().setup(), mill.change());
    to_program_time(recent, mill.change().feed_factor);
    const contact::ForceTableOptions options = controller_.table_options();
    controller_.set_force(contact::build_force_table(contact::force_function(recent, options), options));
}

void SingleThreadedTouch::tick(double dt_s, const protocol::FrameSink& frames) {
    renew();
    LiveFinger& finger = controller_.finger();
    finger.show(controller_.scene(), controller_.mill().state().tip_mm, frames);
    owed_s_ = std::min(owed_s_ + dt_s, kMostOwedS);
    const double tick_s = 1 / finger.rate_hz();
    for (; owed_s_ >= tick_s; owed_s_ -= tick_s) {
        now_s_ += tick_s;
        finger.tick(now_s_);
    }
}

}  // namespace tribo::session
