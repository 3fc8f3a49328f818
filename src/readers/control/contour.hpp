// SPDX-License-Identifier: MIT
// A contour as Heidenhain and Siemens programs write it: elements in the plane of the frame, with the corners
// RND and CHF between them, with APPR and DEP at its ends, and with radius compensation. It is collected
// until its end is known, because every one of these depends on the element that follows. Pure geometry, mm.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "motion/path/program.hpp"
#include "readers/control/path.hpp"
#include "readers/gcode/motion/contour.hpp"

namespace tribo::readers::control {

// What each element takes over from its block.
struct ContourWords {
    bool rapid = false;
    std::optional<double> feed_mm_per_min;
    double spindle_rpm = 0;
    int tool = 0;
    Place place;
};

// APPR and DEP: a line along the contour, a line normal to it, an arc that touches it, or a line and an arc
// that touches both.
enum class ContourEnd { line_tangent, line_normal, circle, line_circle };

struct ContourEndShape {
    ContourEnd shape = ContourEnd::line_tangent;
    Vec3 point;            // first contour point of APPR; end of DEP LCT, and z of DEP
    double length_mm = 0;  // LEN
    double radius_mm = 0;  // R
    double turn_rad = 0;   // CCA
    ContourWords way;      // APPR: words of the way to the auxiliary point
};

// A contour that a cycle follows: a way to a point of the plane, with the corner behind it.
struct ContourStep {
    Vec3 to;
    std::optional<motion::Arc> arc;
    double corner_mm = 0;
    bool is_chamfer = false, is_own_length = false;
};

class Contour {
  public:
    bool is_open() const { return is_open_; }
    bool has_approach() const { return approach_.has_value(); }
    // The programmed end of the contour; also after its end, until the tool leaves the offset path.
    const std::optional<Vec3>& programmed() const { return programmed_; }
    void leave() { programmed_.reset(); }
    void stay_at(Vec3 programmed) { programmed_ = programmed; }
    std::size_t size() const { return pieces_.size(); }

    // Opens a contour at the tip. `left_mm`: offset of the tool's centre, to the left. Its first line is the
    // way to the contour if `has_entry`.
    void open(Vec3 tip, int side, double radius_mm, bool has_entry);
    void approach(const ContourEndShape& shape, const ContourWords& words);
    void add(Vec3 to, const std::optional<motion::Arc>& arc, const ContourWords& words);
    // Adds the steps behind the first one, at a height.
    void add_steps(const std::vector<ContourStep>& steps, double z, const ContourWords& words);
    // The size of a chamfer is what it takes from each element, or its own length.
    void corner(double size_mm, bool is_chamfer, const ContourWords& words, bool is_own_length = false);
    // Removes a corner that no element follows.
    void drop_corner() {
        if (!pieces_.empty() && pieces_.back().is_corner) pieces_.pop_back();
    }
    // Ends the contour with DEP. Returns the position after it.
    void depart(const ContourEndShape& shape, const ContourWords& words);

    // The elements in the plane, with their corners, without compensation and ends.
    Result<std::vector<gcode::Element>> elements(const Path& path) const;
    // Where the approach begins: the tool goes there first.
    Result<Vec3> begin(const Path& path) const;
    // Moves the tool along the contour, and closes it.
    Result<void> run(Path& path);

  private:
    struct Piece {
        gcode::Element element;  // start = end: along the tool axis
        double from_z = 0, to_z = 0;
        bool is_corner = false, is_chamfer = false, is_own_length = false;
        double size_mm = 0;
        ContourWords words;

        bool is_flat() const { return element.is_arc() || !(element.start == element.end); }
    };
    using Pieces = std::vector<Piece>;

    Result<Pieces> work_out(const Path& path) const;
    Result<Pieces> with_corners(const Path& path) const;
    Result<Pieces> offset(const Path& path, const Pieces& pieces) const;
    Result<void> join(const Path& path, const Piece& before, const Piece& next, Piece piece, Pieces& done,
                      std::size_t last) const;
    Result<Pieces> approached(const Path& path, Pieces pieces) const;
    Result<void> append_departure(const Path& path, Pieces& pieces) const;

    bool is_open_ = false, has_entry_ = false;
    int side_ = 0;
    double left_mm_ = 0;
    Vec3 start_;  // tip at the opening
    Pieces pieces_;
    std::optional<ContourEndShape> approach_, departure_;
    ContourWords approach_words_, departure_words_;
    std::optional<Vec3> programmed_;
};

}  // namespace tribo::readers::control
