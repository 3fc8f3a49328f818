// SPDX-License-Identifier: MIT
// What a hand feels while a job is milled before its eyes: the surface as it stands, and in cut mode near the
// cutter the cutting force and the grooves' texture, on the program's own clock. One thread mills and shows
// pictures
// ("the picture"), one calls render() ("the servo"); neither waits for the other.
#pragma once

#include "base/hand_over.hpp"
#include "haptics/servo/swapped_force.hpp"
#include "session/feel/feel_session.hpp"

namespace tribo::session {

struct LiveFeelOptions {
    haptics::ContactOptions contact;
    double rate_hz = 1000;
    double delay_s = 0;    // of arm, driver and line, both ways together
    double finger_mm = 0;  // radius of the finger's cylinder near the cutter
};

// The state of the world at one picture.
struct LiveScene {
    double program_s = 0;
    double pace = 0;    // seconds of the program per second of the servo; 0: it stands
    bool hand = false;  // somebody holds the probe
    bool cut_mode = true, cutting_force = true;
    bool stopped = false;      // no force, whatever happens
    std::uint64_t number = 0;  // of the scene, given by LiveFeel
};

class LiveFeel final : public haptics::ForceSource {
  public:
    explicit LiveFeel(const LiveFeelOptions& options);
    ~LiveFeel() override;  // the servo has ended

    // The picture's. Without a new scene for a quarter of a second the servo's guard takes the force away.
    void show(const LiveScene& scene);
    // What is milled from now on, or null before that goes; waits for a tick to end.
    void set_session(MillSession* session);
    // The cutting force (times as in the program as it was written, see in_written_time()) and the texture of
    // the whole program.
    void set_force(contact::ForceTable table, const haptics::ForceScaling& scaling);
    void set_textures(haptics::TextureMap textures);
    // Counts the calls.
    int textures_set() const { return textures_set_; }
    // The record near the cutter in the last scene, valid until set_textures(); null: none.
    const contact::TextureRecord* texture_at(Vec3 tip_mm) const {
        return textures_[current_].nearest(tip_mm);
    }

    // The servo's. Real-time safe.
    haptics::RenderedForce render(const haptics::HandReading& hand, double now_s,
                                  double tick_s) noexcept override;
    struct Touched {
        double program_s = 0;
        Vec3 proxy_mm;
        double slip_mm_per_s = 0;
        bool contact = false, hand = false;
    };
    // Of the last render.
    const Touched& touched() const { return touched_; }

  private:
    struct Part;
    void keep_time(double now_s, double tick_s) noexcept;

    LiveFeelOptions options_;
    Snapshot<LiveScene> scenes_;
    std::uint64_t shown_ = 0;
    std::unique_ptr<Part> part_;
    Loan<Part> lent_part_;
    haptics::SwappedForce force_;
    haptics::TextureMap textures_[2];
    int current_ = 0, textures_set_ = 0;
    Loan<const haptics::TextureMap> lent_textures_;
    // The servo's.
    NearCutter near_cutter_;
    LiveScene scene_;
    double seen_s_ = 0, program_s_ = 0;
    bool begun_ = false, must_leave_ = false;
    Touched touched_;
};

// Stretches at the changed feed and speed (force_stretches) on the clock of the program as it was written.
void in_written_time(std::vector<contact::ForceStretch>& stretches, double feed_factor);

}  // namespace tribo::session
