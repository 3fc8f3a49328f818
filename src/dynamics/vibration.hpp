// SPDX-License-Identifier: MIT
// A tool and a part that vibrate while they cut, step by step in time, with teeth that leave the cut.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec3.hpp"
#include "dynamics/engaged_zone.hpp"
#include "dynamics/mode.hpp"
#include "milling/engagement/engagement.hpp"
#include "milling/force/edge_force.hpp"
#include "milling/tool/cutter.hpp"

namespace tribo::dynamics {

struct VibrationSample {
    Vec3 displacement_mm;  // of the tool against the part
    Vec3 force_n;          // on the tool
};

// Samples per second that are enough for a cut: 20 to a cycle of each mode, 8 from tooth to tooth.
double enough_rate_hz(std::span<const Mode> modes, const milling::Cutter& cutter, double spindle_rpm);

// The chip of a tooth is the distance by which it stands beyond the surface that the teeth before it left,
// each where the tool was displaced then: the least over those since one that cut there. Where it is negative
// there is no chip (Tlusty and Ismail 1981). So teeth jump out of the cut, and chatter stays bounded. Frame
// and signs as in milling/force/edge_force.hpp: x along the feed, y to its left, z to the shank.
//
// A step turns the modes exactly under a constant force: that of the middle of the step, for the displacement
// which the force before foretells there. Samples stand in the middles of the steps. One thread.
class Vibration {
  public:
    // At rest, with flute 0 at `rotation_rad` from y. `cutter` and `coefficients` must pass their check().
    // rate_hz: samples per second, some tens of times the frequency of each mode. Directions of the modes in
    // the frame of the vibration; no modes: a rigid tool.
    Vibration(std::span<const Mode> modes, const milling::Cutter& cutter,
              const milling::CuttingCoefficients& coefficients, double rate_hz, double rotation_rad = 0);

    // The cut from the next sample on: bands of the lateral edge, mean travel per tooth, speed > 0 with at
    // least four samples from tooth to tooth. Bands and travel are in the frame of the feed, whose x is
    // `feed_rad` from that of the vibration, counterclockwise seen from the shank. What the teeth left before
    // stays. Allocates for more bands or a lower speed than before.
    void engage(std::span<const milling::EngagementBand> bands, const milling::ToolTravel& per_tooth,
                double spindle_rpm, double feed_rad = 0);
    // Other directions of the modes, as many as there are: the frame of the vibration turned against them.
    void turn_modes(std::span<const Mode> modes);

    // Multiplies displacement and speed of the modes.
    void scale_modes(double factor);

    // The next sample. The first is at rest. Real-time safe.
    VibrationSample step();

    // Rotation of the next sample, from that at the start on.
    double rotation_rad() const { return rotation_rad_; }

  private:
    // A mode between two middles of steps. The force along it pushes the state there; then it turns freely to
    // the next middle, while the force still acts.
    struct Oscillator {
        Vec3 direction;
        double q_push, v_push;
        double q_by_q, q_by_v, q_by_force, v_by_q, v_by_v, v_by_force;
        double q_mm = 0, v_mm_per_s = 0;  // before the push
    };
    // A piece of the cylinder: its middle lags behind the tip of the edge.
    struct Piece {
        double height_mm = 0, middle_mm = 0, lag_sine = 0, lag_cosine = 1;
        milling::HalfSpan half;
    };
    // A point of the rounded part, with the length of edge for which it stands.
    struct Node {
        milling::ProfilePoint at;
        double lag_rad = 0, lag_sine = 0, lag_cosine = 1, length_mm = 0;
    };
    static constexpr std::size_t kNodes = 4;
    using Nodes = std::array<Node, kNodes>;
    // A part of a band, on the cylinder or on the rounded part, over which the edge lags little.
    struct Slice {
        milling::EngagementBand band;
        bool round = false;
        double entry_rad = 0;  // in the first turn
        double span_rad = 0;   // of its edge
        double low_rad = 0;    // rotation of the tip at which the last end of the edge enters
        Piece piece;           // all of it, on the cylinder
        Nodes nodes;           // all of it, on the rounded part
    };
    // A bit for each of the first 64 teeth: it cut wherever it was engaged. Others count as not having cut.
    using Teeth = std::uint64_t;
    // Where the tool stands against the part: by its feed and by its displacement.
    struct Place {
        Vec3 tip_mm;
        double turn_x_rad = 0, turn_y_rad = 0;  // of the axis
    };
    struct Sample {
        double rotation_rad = 0;
        Place place{};
        Teeth cut = 0;
    };
    // A tooth that passed before: how far back, and by how much this tooth stands beyond its surface now.
    struct Passage {
        double back_rad = 0, back_samples = 0;
        std::array<double, 4> weights{};  // of the samples around it while the speed does not change
        Place beyond{};
        Teeth cut = 0;
        std::size_t known_at = 0;  // number of the sample after which the two above were computed
    };

    void add_slices(const milling::EngagementBand& band, bool round);
    void keep(std::size_t samples);
    const Sample& sample(std::size_t number) const { return past_[number & (past_.size() - 1)]; }
    // The k-th tooth before this one at its place, 0: the one just before it.
    const Passage& passage(std::size_t tooth, std::size_t k);
    void look_back(Passage& passage) const;
    // sum += times * place
    void add(Place& sum, double times, const Place& place) const;
    Vec3 cutting_force();
    // The law of the surface that stands highest at this rotation.
    milling::TurnLaw chip(std::size_t tooth, double sine, double cosine, double lag_rad,
                          const milling::ProfilePoint& at);
    Vec3 straight_force(std::size_t tooth);
    Piece piece_of(EngagedZone zone) const;
    Nodes nodes_of(EngagedZone zone) const;
    Vec3 slice_force(std::size_t tooth, const Slice& slice);
    Vec3 cylinder_force(std::size_t tooth, const Piece& piece);
    Vec3 round_force(std::size_t tooth, const Nodes& nodes);
    double tip_sine(std::size_t tooth) const {
        return turn_sine_ * phase_cosine_[tooth] + turn_cosine_ * phase_sine_[tooth];
    }
    double tip_cosine(std::size_t tooth) const {
        return turn_cosine_ * phase_cosine_[tooth] - turn_sine_ * phase_sine_[tooth];
    }
    void stands_clear(std::size_t tooth) { cut_ &= ~bit(tooth); }
    static Teeth bit(std::size_t tooth) { return tooth < 64 ? Teeth{1} << tooth : 0; }
    double tip_rad(std::size_t tooth) const { return rotation_rad_ + phase_rad_[tooth]; }

    milling::Cutter cutter_;
    milling::CuttingCoefficients coefficients_;
    double rate_hz_, lag_per_mm_;
    bool straight_;  // a cylinder without helix: one angle for all bands
    std::vector<Oscillator> oscillators_;
    // Of each tooth ahead of flute 0, and the run-out of a straight one.
    std::vector<double> phase_rad_, phase_sine_, phase_cosine_, runout_mm_;
    // For each tooth, or for all if they are alike: kMostPassages, the last first, of which passages_ fit.
    static constexpr std::size_t kMostPassages = 16;
    bool alike_;
    std::vector<Passage> before_;
    std::size_t passages_ = 1;
    std::vector<Slice> slices_;
    Place feed_per_rad_{}, fed_{};  // by the feed alone
    bool turns_ = false;            // the axis has turned
    double step_rad_ = 0, step_sine_ = 0, step_cosine_ = 1;
    // The samples so far in a ring, whose length is a power of two; from even_from_ on at the same speed.
    std::vector<Sample> past_;
    std::size_t samples_ = 0, even_from_ = 0;
    // Rotation of flute 0 at the start; at the next sample; the same in the turn.
    double first_rad_, rotation_rad_, turn_rad_, turn_sine_ = 0, turn_cosine_ = 1;
    Vec3 force_n_{}, displacement_mm_{};
    Teeth cut_ = 0;
};

}  // namespace tribo::dynamics
