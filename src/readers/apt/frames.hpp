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
// TRNTYP/LOCAL in the frame of CSYS. TRACUT transforms the points as written. TRANS is added last. ORIGIN
// gives the position of the part in the machine and has no effect on the points. A header with a matrix works
// like MSYS.
class Frames {
  public:
    Result<void> set_machine_frame(const Statement& statement, double unit_mm, bool any_points,
                                   Report& report);
    // MCSYS/ ..., POINT,x,y,z,VECTOR,i,j,k,VECTOR,i,j,k of Autodesk: origin, x and y, as in MSYS.
    Result<void> set_work_frame(const Statement& statement, double unit_mm, bool any_points, Report& report);
    Result<void> set_frame(const Statement& statement, double unit_mm, Report& report);
    Result<void> set_frame_type(const Statement& statement, Report& report);
    Result<void> set_translation(const Statement& statement, double unit_mm, Report& report);
    Result<void> set_origin(const Statement& statement, Report& report);
    // The matrix in the header of Creo or CATIA: the points that follow are written in this system.
    Result<void> set_header_frame(const Statement& statement, double unit_mm, bool any_points,
                                  Report& report);
    // TRACUT/ with a matrix of twelve numbers, (MATRIX/TRANSL,x,y,z), (MATRIX/XYROT,angle) or NOMORE.
    Result<void> set_transform(const Statement& statement, double unit_mm, Report& report);
    // Called with each point, before to_program() is used. Creo writes points in the system of the machine,
    // or in that of the operation. The points of a turned operation tell which: with an axis it is the
    // machine's.
    void settle(bool point_has_axis, Report& report);

    // Moves what follows as a copy of what was written before.
    void set_copy(const Frame& copy) {
        copy_ = copy;
        update();
    }

    const Frame& to_program() const { return to_program_; }

  private:
    enum class Type { unsaid, world, local };
    void update();

    std::optional<Frame> first_, first_header_;
    std::optional<Frame> unsettled_;  // of a header of Creo, until the next point
    int unsettled_line_ = 0;
    Frame header_, machine_, local_, transform_, copy_, to_program_;
    Vec3 translation_mm_;
    Type type_ = Type::unsaid;
};

}  // namespace tribo::readers::apt
