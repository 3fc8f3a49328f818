// SPDX-License-Identifier: MIT
// Force source of the live view: contact with the part as milled so far; in cut mode also the cutting force
// and the texture of the grooves near the cutter, at program time. The picture thread mills and shows
// pictures; the servo thread calls render(). Neither waits for the other.
#pragma once

#include "base/hand_over.hpp"
#include "haptics/servo/force_table_player.hpp"
#include "session/feel/feel_session.hpp"

namespace tribo::session {

struct LiveForceOptions {
    haptics::ContactOptions contact;
    double rate_hz = 1000;
    double delay_s = 0;    // round trip of arm, driver and connection
    double finger_mm = 0;  // radius of the finger cylinder near the cutter
};

// State of the scene at one picture.
struct LiveScene {
    double program_s = 0;
    double pace = 0;    // program seconds per servo second; 0: paused
    bool hand = false;  // a hand holds the probe
    bool cut_mode = true, cutting_force = true;
    bool stopped = false;      // no force at all
    std::uint64_t number = 0;  // set by LiveForceSource
};

class LiveForceSource final : public haptics::ForceSource {
  public:
    explicit LiveForceSource(const LiveForceOptions& options);
    ~LiveForceSource() override;  // after the servo has stopped

    // Picture thread. Without a new scene for 0.25 s the safety guard switches the force off.
    void show(const LiveScene& scene);
    // Sets the session that mills, or null before it is destroyed. Waits for the end of a tick.
    void set_session(MillSession* session);
    // Cutting force (program times, see to_program_time()) and texture of the whole program.
    void set_force(contact::ForceTable table, const haptics::ForceScaling& scaling);
    void set_textures(haptics::TextureMap textures);
    // Number of calls of set_textures().
    int textures_set() const { return textures_set_; }
    // The nearest texture record, valid until set_textures(); null: none.
    const contact::TextureRecord* texture_at(Vec3 tip_mm) const {
        return textures_[current_].nearest(tip_mm);
    }

    // Servo thread. Real-time safe.
    haptics::RenderedForce render(const haptics::HandReading& hand, double now_s,
                                  double tick_s) noexcept override;
    struct TouchState {
        double program_s = 0;
        Vec3 proxy_mm;
        double slip_mm_per_s = 0;
        bool contact = false, hand = false;
    };
    // Of the last render().
    const TouchState& touch_state() const { return touch_state_; }

  private:
    struct Part;
    void keep_time(double now_s, double tick_s) noexcept;

    LiveForceOptions options_;
    Snapshot<LiveScene> scenes_;
    std::uint64_t shown_ = 0;
    std::unique_ptr<Part> part_;
    Loan<Part> lent_part_;
    haptics::ForceTablePlayer force_;
    haptics::TextureMap textures_[2];
    int current_ = 0, textures_set_ = 0;
    Loan<const haptics::TextureMap> lent_textures_;
    // Servo thread.
    CutterForceRenderer cutter_force_;
    LiveScene scene_;
    double seen_s_ = 0, program_s_ = 0;
    bool begun_ = false, must_leave_ = false;
    TouchState touch_state_;
};

// Converts the times of force_stretches() at a changed feed to program times.
void to_program_time(std::vector<contact::ForceStretch>& stretches, double feed_factor);

}  // namespace tribo::session
