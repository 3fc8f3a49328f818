// SPDX-License-Identifier: MIT
// A tool that vibrates, and beside it the same one that does not bend: what the vibration adds to the force.
#pragma once

#include <array>
#include <complex>
#include <optional>
#include <span>

#include "dynamics/vibration.hpp"

namespace tribo::session {

// Time in which a free vibration falls to a ten-thousandth: it has died out. 0 without modes.
double ring_s(std::span<const dynamics::Mode> modes);

// Both stand on the same teeth. Where the tool moves farther than kLargestDisplacement (simulated_cut.hpp)
// times the diameter, the modes are held there. One thread.
class BendingTool {
  public:
    // At rest. Modes in the frame of the vibration, in which the feed goes along `feed` (of length 1);
    // rotation as in dynamics::Vibration. `steps`: of the vibration in a sample. `compared`: added_n() may be
    // asked for.
    BendingTool(std::span<const dynamics::Mode> modes, const milling::Cutter& cutter,
                const milling::CuttingCoefficients& coefficients, double rate_hz, int steps,
                double rotation_rad, std::complex<double> feed, bool compared);

    // As dynamics::Vibration::engage(), with the modes turned. Allocates when that does.
    void engage(std::span<const dynamics::Mode> modes, std::span<const milling::EngagementBand> bands,
                const milling::ToolTravel& per_tooth, double spindle_rpm, std::complex<double> feed);
    // Another speed of the spindle, as dynamics::Vibration::turn_at().
    void turn_at(double spindle_rpm);
    // The modes come to rest.
    void calm() { vibration_.scale_modes(0); }

    // The next sample. This and what follows is real-time safe.
    void next();
    // What the vibration added to the force in it, along the feed and to its left. Where the feed turns, that
    // frame follows in some milliseconds.
    std::array<float, 2> added_n() const;
    // Displacement in its last step, in the frame of the vibration, and the rotation of flute 0 there.
    Vec3 displaced_mm() const { return displaced_mm_; }
    double displaced_at_rad() const { return displaced_at_rad_; }
    // Displacement after the last step, and the largest of all since reset_largest().
    double displacement_mm() const { return displacement_mm_; }
    double largest_mm() const { return largest_mm_; }
    // The tool was held since then.
    bool was_held() const { return held_; }
    void reset_largest();
    // Of the next sample.
    double rotation_rad() const { return vibration_.rotation_rad(); }

  private:
    dynamics::Vibration vibration_;
    std::optional<dynamics::Vibration> rigid_;
    int steps_;
    double most_mm_;
    // Direction of the feed; smoothed once, and twice.
    std::complex<double> feed_now_;
    std::array<std::complex<double>, 2> feed_;
    Vec3 added_n_{};  // mean of the steps, in the frame of the vibration
    Vec3 displaced_mm_{};
    double displaced_at_rad_ = 0, displacement_mm_ = 0, largest_mm_ = 0;
    bool held_ = false;
};

}  // namespace tribo::session
