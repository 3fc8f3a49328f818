// SPDX-License-Identifier: MIT
// Coordinate systems of APT: transform the points of a statement to the frame of the program.
#pragma once

#include <optional>

#include "base/vec3.hpp"
#include "readers/apt/lexer.hpp"
#include "readers/apt/report.hpp"

namespace tribo::readers::apt {

// Right-handed, orthonormal.
struct Frame {
    Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, origin_mm;

    Vec3 turn(Vec3 v) const { return v.x * x + v.y * y + v.z * z; }
    Vec3 point(Vec3 p) const { return origin_mm + turn(p); }
    Frame inverse() const;
    Frame operator*(const Frame& inner) const {
        return {turn(inner.x), turn(inner.y), turn(inner.z), point(inner.origin_mm)};
    }
};

// The frame of the program is that of its first MSYS. Points of a later MSYS are transformed to it. CSYS
// defines a rotated plane: with TRNTYP/WORLD the points are still given in the frame of the program, with
// TRNTYP/LOCAL in the frame of CSYS. TRANS is added last. ORIGIN gives the position of the part in the
// machine and has no effect on the points.
class Frames {
  public:
    Result<void> set_machine_frame(const Statement& statement, double unit_mm, bool any_points,
                                   Report& report);
    Result<void> set_frame(const Statement& statement, double unit_mm, Report& report);
    Result<void> set_frame_type(const Statement& statement, Report& report);
    Result<void> set_translation(const Statement& statement, double unit_mm, Report& report);
    Result<void> set_origin(const Statement& statement, Report& report);

    const Frame& to_program() const { return to_program_; }

  private:
    enum class Type { unsaid, world, local };
    void update();

    std::optional<Frame> first_;
    Frame machine_, local_, to_program_;
    Vec3 translation_mm_;
    Type type_ = Type::unsaid;
};

}  // namespace tribo::readers::apt
