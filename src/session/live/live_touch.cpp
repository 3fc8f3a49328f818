// SPDX-License-Identifier: MIT
#include "session/live/live_touch.hpp"

#include <algorithm>

#include "session/feel/feel_session.hpp"

namespace tribo::session {
namespace {

// The most of a servo's time that is made up for at once.
constexpr double kMostOwedS = 0.1;
// Force and texture are made anew this often, from what was cut since this long before the clock, of the
// servo's time.
constexpr double kRenewS = 0.1, kBehindS = 0.15;
constexpr std::size_t kMostStretches = 400;

}  // namespace

SingleThreadedTouch::SingleThreadedTouch(LiveMill& mill)
    : mill_(mill), finger_(options_, nullptr, mill.session().stock().blank().bounds_mm().max) {
    mill_.watch([this](MillSession* session) {
        finger_.feel().set_session(session);
        stretches_ = 0;
        renewed_s_ = -1;
    });
}

SingleThreadedTouch::~SingleThreadedTouch() {
    mill_.watch({});
    finger_.feel().set_session(nullptr);
}

LiveScene SingleThreadedTouch::scene() const {
    LiveScene s;
    s.program_s = mill_.clock_s();
    s.pace = mill_.pace();
    s.cut_mode = settings_.cut_mode;
    s.cutting_force = settings_.cutting_force;
    s.stopped = settings_.stopped;
    return s;
}

void SingleThreadedTouch::set(const LiveTouchSettings& settings) {
    settings_ = settings;
    renewed_s_ = -1;
    stretches_ = 0;
    if (settings_.stopped) finger_.stop(scene());
}

void SingleThreadedTouch::renew() {
    const auto all = mill_.record().rows();
    if (all.size() == stretches_ || mill_.pace() <= 0 || now_s_ - renewed_s_ < kRenewS) return;
    renewed_s_ = now_s_;
    stretches_ = all.size();
    const double from = mill_.clock_s() - kBehindS * mill_.pace();
    std::size_t first = all.size() > kMostStretches ? all.size() - kMostStretches : 0;
    while (first < all.size() && all[first].end_s < from) ++first;
    const auto cut = all.subspan(first);
    finger_.feel().set_textures(texture_map(cut, mill_.session().stock(), serial_for));
    auto recent = force_stretches(cut, mill_.session().setup(), mill_.change());
    in_written_time(recent, mill_.change().feed_factor);
    contact::ForceTableOptions options;
    options.hand_per_tool = settings_.force_scale;
    options.most_jnd = settings_.jnd;
    haptics::ForceScaling scaling;
    scaling.gain = settings_.force_scale;
    scaling.limit_n = finger_.limits().max_force_n;
    finger_.feel().set_force(contact::build_force_table(contact::force_function(recent, options), options),
                             scaling);
}

void SingleThreadedTouch::tick(double dt_s, const protocol::FrameSink& frames) {
    renew();
    finger_.show(scene(), mill_.state().tip_mm, frames);
    owed_s_ = std::min(owed_s_ + dt_s, kMostOwedS);
    const double tick_s = 1 / options_.rate_hz;
    for (; owed_s_ >= tick_s; owed_s_ -= tick_s) {
        now_s_ += tick_s;
        finger_.tick(now_s_);
    }
}

}  // namespace tribo::session
