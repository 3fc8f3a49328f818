// SPDX-License-Identifier: MIT
// Moves in a plane that is rolled about a rotary axis: the axis along it and z move as they are written, and
// the rotary axis turns instead of the third.
#include <cmath>

#include "base/math.hpp"
#include "motion/path/path.hpp"
#include "readers/control/path.hpp"
#include "readers/gcode/motion/arc.hpp"

namespace tribo::readers::control {
namespace {

constexpr double kParallel = 1 - 1e-9;  // cosine
constexpr double kSmallTurnRad = 1e-3;

Vec3 unit(int axis) {
    Vec3 direction;
    direction[axis] = 1;
    return direction;
}

}  // namespace

bool Path::roll(double radius_mm, int line) {
    unroll();
    Roll roll;
    roll.radius_mm = radius_mm;
    if (!machine) {
        roll_ = roll;
        return true;
    }
    switch_tip_control(false, line);
    const motion::Kinematics& kinematics = machine->kinematics();
    const motion::MachineAxis* table = nullptr;
    for (const motion::MachineAxis& axis : machine->machine().part_side) {
        if (axis.turns()) table = &axis;
    }
    if (table == nullptr || frame.is_tilted()) return false;
    roll.rotary = table->word - 'A';
    Vec3 more_rad = now_rad_;
    more_rad[roll.rotary] += kSmallTurnRad;
    // A direction along the axis of the table stays where it is while the table turns.
    const auto stays = [&](int axis) {
        return dot(kinematics.direction(unit(axis), now_rad_), kinematics.direction(unit(axis), more_rad)) >
               kParallel;
    };
    if (stays(0) == stays(1)) return false;
    roll.along = stays(0) ? 0 : 1;
    roll.around = 1 - roll.along;
    const Vec3 radial = kinematics.direction(unit(2), more_rad) - kinematics.direction(unit(2), now_rad_);
    roll.way = dot(radial, kinematics.direction(unit(roll.around), now_rad_)) < 0 ? -1 : 1;
    roll.aside_mm = known(roll.around) == Known::yes ? place_mm_[roll.around] : 0;
    place_mm_[roll.around] = roll.way * now_rad_[roll.rotary] * radius_mm;
    roll_ = roll;
    return true;
}

void Path::unroll() {
    if (roll_ && machine) {
        now_rad_ = rotary_at(place_mm_, now_rad_);
        place_mm_[roll_->around] = roll_->aside_mm;
    }
    roll_.reset();
}

Vec3 Path::linear_at(Vec3 place_mm) const {
    if (roll_ && machine) place_mm[roll_->around] = roll_->aside_mm;
    return place_mm;
}

Vec3 Path::rotary_at(Vec3 place_mm, Vec3 rotary_rad) const {
    if (roll_ && machine) rotary_rad[roll_->rotary] = roll_->way * place_mm[roll_->around] / roll_->radius_mm;
    return rotary_rad;
}

// F counts along the surface at the radius of the roll.
Result<void> Path::move_rolled(motion::Move move, Vec3 to_rad, Place place) {
    const double length = motion::path_length_mm(move);
    if (move.kind == motion::MoveKind::feed && length > 0)
        move.duration_s = 60 * length / move.feed_mm_per_min;
    const double chords = move.arc ? gcode::chord_count(*move.arc, move.start.tip_mm) : 1;
    const motion::Move whole = move;
    const Vec3 from_rad = now_rad_;
    move.arc.reset();
    move.duration_s /= chords;
    for (double i = 1; i <= chords; ++i) {
        const double t = i / chords;
        const Vec3 to = i < chords ? motion::pose_at(whole, t).tip_mm : whole.end.tip_mm;
        const Vec3 rotary_rad = from_rad + t * (to_rad - from_rad);
        motion::MachineBlock block;
        block.start_mm = linear_at(place_mm_);
        block.end_mm = linear_at(to);
        block.start_rad = rotary_at(place_mm_, now_rad_);
        block.end_rad = rotary_at(to, rotary_rad);
        place_mm_ = to;
        now_rad_ = rotary_rad;
        if (block.start_mm == block.end_mm && block.start_rad == block.end_rad) continue;
        if (auto done = run_block(block, move, place); !done) return done;
    }
    return {};
}

}  // namespace tribo::readers::control
