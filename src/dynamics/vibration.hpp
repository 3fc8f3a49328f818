// SPDX-License-Identifier: MIT
// A tool and a part that vibrate while they cut, step by step in time, with teeth that leave the cut.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/vec3.hpp"
#include "dynamics/mode.hpp"
#include "milling/engagement/engagement.hpp"
#include "milling/force/edge_force.hpp"
#include "milling/tool/cutter.hpp"

namespace tribo::dynamics {

struct VibrationSample {
    Vec3 displacement_mm;  // of the tool against the part
    Vec3 force_n;          // on the tool
};

// The chip of a tooth is the least distance by which it stands beyond the surfaces of the teeth before it,
// each where the tool was displaced then; where that is negative there is none (Tlusty and Ismail 1981). So
// teeth jump out of the cut, and chatter stays bounded. Frame and signs as in milling/force/edge_force.hpp:
// x along the feed, y to its left, z to the shank.
//
// A step turns the modes exactly under a constant force: that of the middle of the step, for the displacement
// which the force before foretells there. Samples stand in the middles of the steps. One thread.
class Vibration {
  public:
    // At rest. `cutter` and `coefficients` must pass their check(). rate_hz: samples per second, some tens of
    // times the frequency of each mode. Directions of the modes in the frame of the cut.
    Vibration(std::span<const Mode> modes, const milling::Cutter& cutter,
              const milling::CuttingCoefficients& coefficients, double rate_hz);

    // The cut from the next sample on: bands of the lateral edge, mean feed per tooth >= 0, speed > 0 with at
    // least four samples from tooth to tooth. What the teeth left before stays. Allocates for more bands or a
    // lower speed than before.
    void engage(std::span<const milling::EngagementBand> bands, double feed_per_tooth_mm, double spindle_rpm);

    // The next sample. The first is at rest, with flute 0 on y. Real-time safe.
    VibrationSample step();

    // Rotation of the next sample, from 0 on.
    double rotation_rad() const { return rotation_rad_; }

  private:
    // A mode with its state. Half a step turns (q, v), and adds push times the force along the mode.
    struct Oscillator {
        Vec3 direction;
        double q_by_q, q_by_v, v_by_q, v_by_v, q_push, v_push;
        double q_mm = 0, v_mm_per_s = 0;

        void pass_half_a_step();
        void push(double force_n);
    };
    // A part of a band, on the cylinder or on the rounded part, over which the edge lags little.
    struct Slice {
        milling::EngagementBand band;
        bool round;
    };
    // A tooth that passed before: how far back, and by how much this tooth stands beyond its surface now.
    struct Passage {
        double back_rad = 0;
        std::size_t cursor = 0;  // the sample before it
        Vec3 beyond_mm{};
    };

    void add_slices(const milling::EngagementBand& band, bool round);
    void remember(double rotation_rad, Vec3 displacement_mm);
    Vec3 displacement_at(Passage& passage) const;
    Vec3 cutting_force(Vec3 displacement_mm);
    milling::TurnLaw chip(std::size_t tooth, double rotation_rad, double lag_rad,
                          const milling::ProfilePoint& at) const;
    Vec3 cylinder_force(std::size_t tooth, const milling::EngagementBand& band) const;
    Vec3 round_force(std::size_t tooth, const milling::EngagementBand& band) const;
    std::size_t place(std::size_t sample) const { return sample & (displacement_mm_.size() - 1); }
    double tip_rad(std::size_t tooth) const { return rotation_rad_ + phase_rad_[tooth]; }

    milling::Cutter cutter_;
    milling::CuttingCoefficients coefficients_;
    double rate_hz_, lag_per_mm_;
    std::vector<Oscillator> oscillators_;
    std::vector<double> phase_rad_;  // of each tooth ahead of flute 0
    // The teeth before a tooth, the last first: `memory_` of them for each tooth, or for all if they are alike.
    std::size_t memory_;
    bool alike_;
    std::vector<Passage> passages_;
    std::vector<Slice> slices_;
    double feed_mm_per_rad_ = 0, step_rad_ = 0;
    // The samples so far in rings, whose length is a power of two.
    std::vector<double> sample_rad_;
    std::vector<Vec3> displacement_mm_;
    std::size_t samples_ = 0;
    double rotation_rad_ = 0;
    Vec3 force_n_{};
};

}  // namespace tribo::dynamics
