// SPDX-License-Identifier: MIT
// The finger of the live view: an arm that a person holds, or a hand led by a mouse, a screen or a headset's
// controller, on its servo; and its frames for the picture. Who has a clock calls tick(): a thread of its own
// (the servo), or the picture itself, several times a frame, where there are no threads.
#pragma once

#include "haptics/servo/servo.hpp"
#include "haptics/servo/simulated_hand.hpp"
#include "protocol/live_frame.hpp"
#include "session/live/live_feel.hpp"

namespace tribo::session {

class LiveFinger {
  public:
    // `arm`: null for a led hand, which begins at `start_mm`.
    LiveFinger(const LiveFeelOptions& options, std::unique_ptr<haptics::Device> arm, Vec3 start_mm);

    // The servo's; `now_s` on its own clock. False once the arm is gone. Real-time safe.
    bool tick(double now_s) noexcept;

    // The picture's, all that follows.
    LiveFeel& feel() { return feel_; }
    bool has_arm() const { return pointer_ == nullptr; }
    double rate_hz() const { return rate_hz_; }
    const haptics::DeviceLimits& limits() const { return device_->limits(); }
    // What is wrong with the arm, in words; empty: nothing.
    std::string trouble() const { return device_->trouble(); }
    // Where a led hand should be, and whether there is one; an arm leads itself.
    void lead(Vec3 aim_mm, bool down);
    // No force from the next tick on, before the next scene says so too.
    void stop(LiveScene scene);
    // Hands the scene to the servo and tells what is new of the finger and of the texture near the cutter.
    void show(LiveScene scene, Vec3 tip_mm, const protocol::FrameSink& frames);
    // Ticks, fault and forces of the servo so far; durations are its clock's to add.
    protocol::LiveServo servo() const { return seen_servo_; }

  private:
    struct Seen {
        protocol::LiveTouch touch;
        protocol::LiveServo servo;
    };

    double rate_hz_;
    haptics::PointerDevice* pointer_ = nullptr;  // the device, where it is one
    std::unique_ptr<haptics::Device> device_;
    LiveFeel feel_;
    haptics::Servo servo_;
    Snapshot<Seen> seen_;
    // The picture's.
    bool down_ = false;
    protocol::LiveServo seen_servo_;
    const contact::TextureRecord* shown_texture_ = nullptr;
    int shown_textures_set_ = 0;
    std::vector<std::uint8_t> frame_, last_finger_;
};

}  // namespace tribo::session
