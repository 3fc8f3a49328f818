// SPDX-License-Identifier: MIT
#include "session/live/live_force_source.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tribo::session {
namespace {

// Share of the program clock error that a tick corrects. Scenes come with the pictures, 60 times a second and
// not evenly; the teeth must not stutter.
constexpr double kClockPull = 0.005;
// If the clocks differ by more than this, in servo seconds, the program clock is set.
constexpr double kClockJumpS = 0.05;

}  // namespace

struct LiveForceSource::Part {
    Part(MillSession& session, const haptics::ContactOptions& options)
        : reader(session.read_stock()), touch(*reader, options), track(session.setup()) {}
    std::unique_ptr<field::FieldReader> reader;
    SurfaceContact touch;
    CutterTrack track;
};

LiveForceSource::LiveForceSource(const LiveForceOptions& options)
    : options_(options),
      force_(options.rate_hz),
      cutter_force_(force_, options.finger_mm, 1 / options.rate_hz) {
    options_.contact.tick_s = 1 / options.rate_hz;
}

LiveForceSource::~LiveForceSource() = default;

void LiveForceSource::show(const LiveScene& scene) {
    scenes_.back() = scene;
    scenes_.back().number = ++shown_;
    scenes_.publish();
}

void LiveForceSource::set_session(MillSession* session) {
    lent_part_.lend(nullptr);
    part_.reset();
    if (session == nullptr) return;
    part_ = std::make_unique<Part>(*session, options_.contact);
    lent_part_.lend(part_.get());
}

void LiveForceSource::set_force(contact::ForceTable table, const haptics::ForceScaling& scaling) {
    force_.replace(std::move(table), scaling);
}

void LiveForceSource::set_textures(haptics::TextureMap textures) {
    const int next = 1 - current_;
    textures_[next] = std::move(textures);
    lent_textures_.lend(&textures_[next]);
    current_ = next;
    ++textures_set_;
}

// Advances the program clock by the servo clock at the current pace, and corrects it towards the clock of the
// scenes.
void LiveForceSource::keep_time(double now_s, double tick_s) noexcept {
    const LiveScene& newest = scenes_.read();
    if (!begun_ || newest.number != scene_.number) {
        scene_ = newest;
        seen_s_ = now_s;
    }
    const double aim = scene_.program_s + scene_.pace * (now_s - seen_s_);
    const double on = program_s_ + scene_.pace * tick_s;
    const bool jump = !begun_ || std::abs(aim - on) > kClockJumpS * std::max(1.0, scene_.pace);
    program_s_ = jump ? aim : on + kClockPull * (aim - on);
    begun_ = true;
}

haptics::RenderedForce LiveForceSource::render(const haptics::HandReading& hand, double now_s,
                                               double tick_s) noexcept {
    keep_time(now_s, tick_s);
    haptics::RenderedForce felt;
    felt.simulation_s = seen_s_;
    touch_state_ = {program_s_, hand.position_mm, 0, false, scene_.hand};
    const Loan<Part>::Use part(lent_part_);
    const Loan<const haptics::TextureMap>::Use textures(lent_textures_);
    if (part.get() == nullptr) return felt;
    part.get()->reader->refresh();
    if (!scene_.hand) {
        // The next contact begins at the position of the hand.
        part.get()->touch.reset();
        must_leave_ = false;
        return felt;
    }
    const haptics::ProbeContact contact = part.get()->touch.update(hand);
    touch_state_.proxy_mm = contact.proxy_mm;
    touch_state_.slip_mm_per_s = length(contact.slip_mm_per_s);
    touch_state_.contact = contact.in_contact;

    // A stopped cutter does not cut.
    cutter_force_.switch_cutting(scene_.cut_mode && scene_.cutting_force && scene_.pace > 0);
    if (scene_.pace > 0) force_.set_pace(scene_.pace);
    const haptics::FieldForce near_cutter =
        cutter_force_.render(hand, program_s_, part.get()->track, textures.get());

    // If the surface returned under a pressing hand, it would push the hand away. The hand must leave first.
    if (scene_.stopped) must_leave_ = true;
    if (!contact.in_contact && !scene_.stopped) must_leave_ = false;
    if (scene_.stopped) return felt;
    if (!must_leave_) felt.contact_n = contact.force_n;
    felt.driven_n = near_cutter.total_n();
    felt.touching = (contact.in_contact && !must_leave_) || squared_length(near_cutter.cutting_n) > 0;
    return felt;
}

void to_program_time(std::vector<contact::ForceStretch>& stretches, double feed_factor) {
    for (contact::ForceStretch& s : stretches) {
        s.start_s *= feed_factor;
        s.end_s *= feed_factor;
        s.rate_rad_per_s /= feed_factor;
    }
}

}  // namespace tribo::session
