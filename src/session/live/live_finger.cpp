// SPDX-License-Identifier: MIT
#include "session/live/live_finger.hpp"

#include <utility>

namespace tribo::session {
namespace {

std::unique_ptr<haptics::Device> arm_or_hand(std::unique_ptr<haptics::Device> arm, Vec3 start_mm,
                                             double rate_hz, haptics::PointerDevice*& led) {
    if (arm) return arm;
    auto hand = std::make_unique<haptics::PointerDevice>(start_mm, 1 / rate_hz);
    led = hand.get();
    return hand;
}

// Returns the force that each triangle adds at the press depth of the force field.
protocol::LiveTexture texture_message(double t_s, const contact::TextureRecord* texture) {
    protocol::LiveTexture told{t_s, {}};
    if (texture == nullptr) return told;
    const haptics::ForceFieldOptions felt;
    const double press_mm = felt.texture_press_mm;
    for (const contact::TexturedTriangle& t : texture->triangles()) {
        const Vec3 lift_mm = (press_mm + t.height_mm) * t.normal - press_mm * texture->normal;
        told.triangles.push_back({t.corners_mm, felt.texture_stiffness_n_per_mm * lift_mm});
    }
    return told;
}

}  // namespace

LiveFinger::LiveFinger(const LiveForceOptions& options, std::unique_ptr<haptics::Device> arm, Vec3 start_mm)
    : rate_hz_(options.rate_hz),
      device_(arm_or_hand(std::move(arm), start_mm, options.rate_hz, pointer_)),
      force_source_(options),
      servo_(*device_, force_source_, safety_limits(*device_, options.rate_hz),
             pointer_ != nullptr ? 0 : options.delay_s) {}

bool LiveFinger::tick(double now_s) noexcept {
    const haptics::ServoTick tick = servo_.tick(now_s);
    const LiveForceSource::TouchState& touch = force_source_.touch_state();
    Seen& seen = seen_.back();
    seen.touch.t_s = touch.program_s;
    seen.touch.probe_mm = tick.position_mm;
    seen.touch.proxy_mm = touch.proxy_mm;
    seen.touch.force_n = tick.force_n;
    seen.touch.slip_mm_per_s = touch.slip_mm_per_s;
    seen.touch.contact = touch.contact;
    seen.touch.hand = touch.hand;
    seen.servo.ticks = static_cast<std::uint32_t>(servo_.ticks());
    seen.servo.fault = static_cast<std::uint32_t>(tick.fault);
    seen.servo.rate_hz = rate_hz_;
    seen.servo.force_limit_n = servo_.safety().limits().max_force_n;
    seen.servo.largest_force_n = servo_.max_force_n();
    seen_.publish();
    return servo_.is_device_connected();
}

void LiveFinger::set_pointer(Vec3 aim_mm, bool down) {
    if (pointer_ == nullptr) return;
    if (down) pointer_->set_target(aim_mm);
    down_ = down;
}

void LiveFinger::stop(LiveScene scene) {
    scene.stopped = true;
    force_source_.show(scene);
}

void LiveFinger::show(LiveScene scene, Vec3 tip_mm, const protocol::FrameSink& frames) {
    scene.hand = has_arm() || down_;
    force_source_.show(scene);
    const Seen& seen = seen_.read();
    seen_servo_ = seen.servo;
    protocol::LiveTouch touch = seen.touch;
    touch.hand = scene.hand && touch.hand;
    touch.cut_mode = scene.cut_mode;
    touch.cutting_force = scene.cutting_force;
    touch.stopped = scene.stopped;
    // Without a hand the message contains no motion.
    if (!touch.hand) touch = {0, {}, {}, {}, 0, false, touch.cutting_force, touch.cut_mode, touch.stopped};
    protocol::write_frame(touch, frame_);
    if (frame_ != last_finger_) {
        frames(frame_);
        std::swap(frame_, last_finger_);
    }
    const contact::TextureRecord* texture = force_source_.texture_at(tip_mm);
    if (texture == shown_texture_ && force_source_.textures_set() == shown_textures_set_) return;
    if (texture == nullptr && shown_texture_ == nullptr) return;
    shown_texture_ = texture;
    shown_textures_set_ = force_source_.textures_set();
    protocol::write_frame(texture_message(scene.program_s, texture), frame_);
    frames(frame_);
}

}  // namespace tribo::session
