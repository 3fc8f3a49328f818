// SPDX-License-Identifier: MIT
// One tool move after the other against the stock: what the teeth meet, what is lost, what runs into what.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "field/carved_field.hpp"
#include "milling/cutter.hpp"
#include "milling/engagement_probe.hpp"
#include "motion/program.hpp"

namespace tribo::milling {

// A stretch of one move short enough for one engagement.
struct CutRow {
    double from = 0, to = 0;  // fractions of the elementary move
    double length_mm = 0;     // of the tip path
    CutPose pose;             // in the middle
    Engagement engagement;    // in the middle
    double chip_mm3 = 0;      // chip area times length: what the engagement says is cut
    double removed_mm3 = 0;   // this row's share of what the stock lost in the move
};

enum class CollisionKind { rapid_through_stock, shank, holder, tool_in_fixture, holder_in_fixture };
const char* name(CollisionKind kind);  // as in summary.json

struct Collision {
    CollisionKind kind;
    double at = 0;  // fraction of the elementary move
    Vec3 tip_mm;
};

struct MachiningOptions {
    double row_mm = 0.5;      // longest row
    double rapid_row_mm = 2;  // how far apart a rapid that touched stock is searched for the place
    bool collisions = true;
};

class Machining {
  public:
    // The field and the cutters must outlive it. Fixtures are only ever tested, never cut.
    Machining(field::CarvedField& stock, std::span<const Cutter> cutters,
              std::vector<std::unique_ptr<field::CarvedField>> fixtures, MachiningOptions options = {});

    // Runs one elementary move (motion::to_elementary) of cutter number `cutter` in the span: rows go to
    // rows[first...] (grown as needed, reused otherwise), their count is returned; collisions are appended.
    // Rapids give no rows.
    std::size_t run(const motion::Move& move, std::size_t cutter, std::vector<CutRow>& rows,
                    std::size_t first, std::vector<Collision>& collisions);

  private:
    // One step of shank or holder: a cylinder whose lower end stands `height_mm` above the tip.
    struct Cylinder {
        CollisionKind in_stock;
        Cutter solid;
        double height_mm = 0;
    };
    void measure_rows(const motion::Move& move, std::size_t cutter, std::vector<CutRow>& rows,
                      std::size_t first, std::size_t count);
    CutPose pose_between(const motion::Move& move, double from, double to);
    double first_contact(const motion::Move& move, std::size_t cutter);
    void check_collisions(const motion::Move& move, std::size_t cutter, const field::Shape& sweep,
                          std::vector<Collision>& collisions);

    field::CarvedField& stock_;
    std::span<const Cutter> cutters_;
    std::vector<std::unique_ptr<field::CarvedField>> fixtures_;
    MachiningOptions options_;
    std::vector<EngagementProbe> probes_;
    std::vector<std::vector<Cylinder>> bodies_;
    Vec3 last_x_{1, 0, 0};  // stock +x until the tool has moved across its axis
};

}  // namespace tribo::milling
