// SPDX-License-Identifier: MIT
// Cutting force by brute force, for tests: every point of every flute is stepped in time, and its chip is the
// way back along the envelope's normal to where the block ends or an earlier tooth has passed. Only the data
// types and the signs of docs/force.md are shared with the engine: no engagement, no grid, no chip formula.
//
// Material is what lies in the block and no tooth has passed. The teeth of the last turns are looked at one
// by one, each where it truly was when it came past; older cuts as the whole tool at many instants.
#pragma once

#include <vector>

#include "base/vec3.hpp"
#include "milling/tool/coefficients.hpp"
#include "milling/tool/cutter.hpp"
#include "motion/path/program.hpp"

namespace tribo::session {

struct SteppingOptions {
    int angles = 480;         // instants of a turn
    int lateral = 120;        // points of an edge up to `height_mm`
    int bottom = 50;          // points of an edge of the flat bottom
    double height_mm = 10;    // above the tip; nothing cuts higher up
    double history_mm = 0.1;  // apart stand the instants of older cuts, of the fastest point up there
};

// Force on the tool over one turn, in the tool's frame of docs/force.md, N and N mm.
struct TurnOfForce {
    Vec3 mean_n, peak_n;  // a component's peak is its extreme of largest size, signed
    double peak_xy_n = 0;
    double mean_torque_nmm = 0, peak_torque_nmm = 0;
};

class FluteStepping {
  public:
    // Straight moves (the axis may turn) without rapids, that join end to start; each takes its duration_s,
    // or its length at its feed.
    FluteStepping(const milling::Cutter& cutter, const milling::CuttingCoefficients& coefficients, Box3 block,
                  std::vector<motion::Move> moves, double rpm);

    // Of the turn whose middle is at that time.
    TurnOfForce turn_at(double time_s, const SteppingOptions& options = {}) const;

  private:
    // Spindle axis at an instant. Directions across it are told by their angle clockwise from e1, seen from
    // the shank.
    struct Pose {
        Vec3 tip, axis, e1, e2;
        Vec3 across(double angle) const;
    };
    struct EdgePoint {
        std::size_t flute;
        double radius, height, angle;  // angle behind flute 0, of the tool's own axis
        double width;                  // along the profile
        double normal_out, normal_up;  // outward normal of the envelope
        double edge_out, edge_up;      // along the profile to the end that leads
    };
    struct Instant {
        Vec3 tip, axis;
    };
    // A place seen from the tool.
    struct Place {
        double radius, height, angle;
    };

    Pose pose_at(double time_s) const;
    Place place_at(double time_s, Vec3 q) const;
    double outside(double radius, double height) const;
    double outside_pass(double time_s, double edge_angle, Vec3 q) const;
    bool cut_long_ago(Vec3 q, const std::vector<Instant>& history) const;
    bool in_block(Vec3 q) const;
    double chip(double time_s, const EdgePoint& point, Vec3 q, Vec3 normal, double longest,
                const std::vector<Instant>& history) const;
    std::vector<EdgePoint> edge_points(const SteppingOptions& options) const;
    std::vector<Instant> history(double until_s, const SteppingOptions& options) const;

    milling::Cutter cutter_;
    milling::CuttingCoefficients k_;
    Box3 block_;
    std::vector<motion::Move> moves_;
    std::vector<double> start_s_;  // of each move, and the end of the last
    std::vector<Vec3> e1_;         // at the start of each move
    std::vector<double> ahead_;    // of each flute before flute 0, rad
    double spin_;                  // rad/s
};

}  // namespace tribo::session
