// SPDX-License-Identifier: MIT
// The finger of the live view, with its servo and its frames. It is a haptic arm, or a device driven by a
// mouse, a touch screen or a VR controller. The servo thread calls tick(). Without threads the picture calls
// it, several times per frame.
#pragma once

#include "haptics/servo/servo.hpp"
#include "haptics/servo/simulated_hand.hpp"
#include "protocol/live_frame.hpp"
#include "session/live/live_force_source.hpp"

namespace tribo::session {

class LiveFinger {
  public:
    // `arm`: null for a pointer device, which starts at `start_mm`.
    LiveFinger(const LiveForceOptions& options, std::unique_ptr<haptics::Device> arm, Vec3 start_mm);

    // Servo thread. `now_s`: servo time. False after the arm is disconnected. Real-time safe.
    bool tick(double now_s) noexcept;

    // All following functions: picture thread.
    LiveForceSource& force_source() { return force_source_; }
    bool has_arm() const { return pointer_ == nullptr; }
    double rate_hz() const { return rate_hz_; }
    const haptics::DeviceLimits& limits() const { return device_->limits(); }
    // Problem of the arm, as text; empty: none.
    std::string trouble() const { return device_->trouble(); }
    // Position of the pointer and whether it is pressed. Ignored with an arm.
    void set_pointer(Vec3 aim_mm, bool down);
    // Switches the force off from the next tick on, before the next show().
    void stop(LiveScene scene);
    // Gives the scene to the servo. Sends frames for changes of the finger and of the texture near the
    // cutter.
    void show(LiveScene scene, Vec3 tip_mm, const protocol::FrameSink& frames);
    // Ticks, fault and forces of the servo so far. The caller adds the durations.
    protocol::LiveServo servo() const { return seen_servo_; }

  private:
    struct Seen {
        protocol::LiveTouch touch;
        protocol::LiveServo servo;
    };

    double rate_hz_;
    haptics::PointerDevice* pointer_ = nullptr;  // device_ if it is a pointer device, else null
    std::unique_ptr<haptics::Device> device_;
    LiveForceSource force_source_;
    haptics::Servo servo_;
    Snapshot<Seen> seen_;
    // Picture thread.
    bool down_ = false;
    protocol::LiveServo seen_servo_;
    const contact::TextureRecord* shown_texture_ = nullptr;
    int shown_textures_set_ = 0;
    std::vector<std::uint8_t> frame_, last_finger_;
};

}  // namespace tribo::session
