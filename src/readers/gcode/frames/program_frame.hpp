// SPDX-License-Identifier: MIT
// Coordinates that a program writes turned, scaled, mirrored or polar (G68, G51, G51.1, G16): from the
// written point to the point in the axes of the program. The order is that of Fanuc controls: mirror image,
// scaling, rotation. The centre of a rotation is written, too, so it is mirrored and scaled; a mirror image
// turns the other way.
#pragma once

#include <array>
#include <optional>

#include "base/result.hpp"
#include "base/vec3.hpp"

namespace tribo::readers::gcode {

class Command;
struct State;
class Output;

enum class Plane { xy, zx, yz };  // G17 G18 G19

struct ProgramFrame {
    bool is_polar = false;
    double radius_mm = 0, angle_deg = 0;  // the last polar words
    Vec3 pole_mm;                         // they count from here: zero, or the tip at a radius in G91

    std::array<std::optional<double>, 3> mirror_mm{};  // place of the mirror along each axis
    Vec3 scale{1, 1, 1}, scale_centre_mm;
    Plane turn_plane = Plane::xy;
    double turn_deg = 0;
    Vec3 turn_centre_mm;  // as written

    // True if written points are those in the axes of the program.
    bool is_plain() const;
    Vec3 placed(Vec3 written) const;
    // Inverse of placed().
    Vec3 written(Vec3 placed) const;
    // placed() for the difference of two points.
    Vec3 placed_offset(Vec3 offset) const;
    // placed() of a direction: mirrored and turned, not scaled.
    Vec3 placed_direction(Vec3 direction) const;
    // placed() of a level along an axis that no rotation moves (the depth of a cycle).
    double placed_level(double level, int axis) const;
    // True if a left turn in the plane becomes a right one.
    bool is_mirrored(Plane plane) const;
    // Scale in the plane; absent: not the same for both of its axes.
    std::optional<double> scale_in(Plane plane) const;

  private:
    Vec3 placed_unturned(Vec3 written) const;
    double placed_turn_deg() const;
};

// G15 G16, G50 G51, G50.1 G51.1, G68 G69 and tilted planes of the block, with their words.
Result<void> set_program_frame(Command& command, State& state, Output& output);

// Takes the coordinate words of the block in this frame: changes `written`, the point where the tip is, to
// the point where it goes, and says in `known` which coordinates are known then.
Result<void> write_target(Command& command, State& state, Output& output, Vec3& written,
                          std::array<bool, 3>& known);

}  // namespace tribo::readers::gcode
