// SPDX-License-Identifier: MIT
// Runs tool moves against the stock: engagement, removed volume and collisions.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "base/parallel.hpp"
#include "field/carved/carved_view.hpp"
#include "milling/engagement/collision.hpp"
#include "milling/engagement/cut_row.hpp"
#include "milling/engagement/engagement_probe.hpp"
#include "milling/tool/cutter.hpp"
#include "motion/path/program.hpp"

namespace tribo::milling {

// One elementary move (motion::to_elementary) with one of the cutters. The move must outlive the run. A pass
// is one step and the steps that join it.
struct Step {
    const motion::Move* move;
    std::size_t cutter;
    bool joins = false;  // forms one pass with the step before it (JoinedMoves)
};

struct Collision {
    std::size_t step;
    CollisionKind kind;
    double at = 0;  // fraction of the elementary move where it begins
    Vec3 tip_mm;
};

// Results of a run of steps. The rows beyond row_count are memory for later runs.
struct Machined {
    std::vector<CutRow> rows;
    std::size_t row_count = 0;
    std::vector<Collision> collisions;
    // By step. Steps that share a sweep are one piece of the stock's surface, which the first of them begins
    // and which has the volume of all.
    std::vector<double> removed_mm3;
    std::vector<char> begins_piece;
};

struct MachiningOptions {
    double rapid_row_mm = 2;  // step of the search for the contact of a rapid that touched stock
    bool collisions = true;
};

class Machining {
  public:
    // The field, the cutters and the fixtures must outlive this object. Fixtures are tested for collisions
    // but never cut.
    Machining(field::CarvedField& stock, std::span<const Cutter> cutters,
              std::span<const std::unique_ptr<const field::Shape>> fixtures, MachiningOptions options = {},
              ParallelFor parallel = serial_for);
    ~Machining();

    // Runs the first of the steps, at least one pass: as many as are efficient to process together, on all
    // threads. Returns their number. The results depend on the steps alone, not on the threads. The first
    // step must not join an earlier one, and all steps that join the last one must be present.
    std::size_t run(std::span<const Step> steps, Machined& out);

  private:
    struct Cylinder;
    struct Sweep;
    // Adds the steps of one pass, or none of them: returns false if too many earlier shapes of this run
    // overlap its own.
    bool add_sweeps(std::span<const Step> pass);
    // Ends the pass that begins with this sweep and contains all sweeps up to the last one.
    void add_pass(std::size_t first, Machined& out);
    std::size_t pass_end(std::size_t first) const;
    std::size_t shape_end(std::size_t first) const;
    // Pose and length on the pass that begins with the sweep `pass`.
    motion::ToolPose pose_at(std::size_t pass, double at) const;
    double length_mm(std::size_t pass, double to) const;
    CutPose pose_between(std::size_t pass, double from, double to, Vec3& last_x) const;
    void measure_rows(std::size_t first, std::size_t last, std::vector<EngagementProbe>& probes,
                      Machined& out) const;
    field::CarvedView before(const Sweep& sweep) const;
    // A place on a pass, between two fractions of it, where contact begins (`into`) or ends. `x` replaces the
    // direction of travel where there is none.
    struct Turn {
        std::size_t step = 0;  // the first step of the pass
        Vec3 x;
        double before = 0, after = 0;
        bool into = false;
    };
    CutPose pose_at(const Turn& turn, double at) const;
    bool touches(const Turn& turn, double at, std::vector<EngagementProbe>& probes) const;
    bool touches_at_end(const Turn& last, const Engagement& of_last_row);
    void find_turns(const Machined& out);
    void divide_rows_at_turns(Machined& out);
    void find_contact(std::size_t number, Sweep& sweep) const;
    void find_collisions(std::size_t number, Sweep& sweep) const;
    // Of the steps from `begin` to `end` together, which touch at `place`: the step and the fraction of it at
    // which they begin to. `touches` tells of a step, or of its beginning.
    Collision first_contact(CollisionKind kind, std::size_t begin, std::size_t end, Vec3 place,
                            const std::function<bool(const motion::Move&)>& touches) const;
    void reconcile(Machined& out) const;

    field::CarvedField& stock_;
    std::span<const Cutter> cutters_;
    std::span<const std::unique_ptr<const field::Shape>> fixtures_;
    MachiningOptions options_;
    ParallelFor parallel_;
    std::vector<std::vector<EngagementProbe>> probes_;  // by share of the work, then by cutter
    std::vector<std::vector<Cylinder>> bodies_;
    Vec3 last_x_{1, 0, 0};  // stock +x until the tool has moved across its axis
    // State at the end of the earlier runs.
    struct End {
        bool in_cut = false;
        std::size_t cutter = 0;
        Vec3 tip_mm;
    } end_;
    // State of the current run.
    std::vector<Sweep> sweeps_;
    std::vector<std::unique_ptr<const field::Shape>> shapes_;
    std::vector<double> removed_;  // by shape
    std::vector<Turn> turns_;
    std::vector<CutRow> divided_;
    std::vector<std::size_t> fresh_;  // indices of the divided rows to be measured
};

}  // namespace tribo::milling
