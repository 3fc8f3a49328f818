// SPDX-License-Identifier: MIT
// Free contours (FK): elements of a plane that are described as a drawing dimensions them. What a block
// leaves open follows from its neighbours. Pure geometry, mm and radians, in x y.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "base/vec3.hpp"

namespace tribo::readers::heidenhain {

// One equation of an element, or of its place in relation to an earlier one.
struct FreeCondition {
    enum class Of {
        x,            // of the point: its coordinate is `value` from that of the reference
        y,            // likewise
        polar,        // its distance from the pole is `value`
        ray,          // it lies on the ray from the pole at the angle `value`
        direction,    // the element begins `value` radians from the direction of the reference
        parallel,     // the line is parallel to the reference, either way
        from_line,    // the line begins `value` from the line of the reference
        chord,        // start and end of the arc are `value` apart
        passes_point  // the element, thought longer, passes `point` at the distance `value`
    };
    Of of = Of::x;
    bool of_centre = false;  // of the arc's centre, not of the end
    double value = 0;
    Vec3 point;  // pole or auxiliary point
    // The earlier element whose end, or start, the value counts from; none: the origin.
    std::optional<std::size_t> reference;
    bool from_start = false;
};

struct FreeElement {
    bool is_arc = false, is_tangent = false;
    int turning = 0;                                // of an arc: +1 to the left, -1; 0: not stated
    std::optional<double> direction, size, radius;  // at its start; length, or angle of an arc
    std::vector<FreeCondition> conditions;
};

// An element whose place is known.
struct FreePiece {
    Vec3 start, end, centre;
    double direction = 0, size = 0, radius = 0;
    int turning = 0;  // 0: a line

    double exit_direction() const { return direction + turning * size; }
};

class FreeContour {
  public:
    enum class State {
        known,         // but for the end of the last element
        open,          // it depends on what follows
        contradictory  // nothing fits
    };

    // `direction`: of the element before the start; none: nothing to be tangent to.
    FreeContour(Vec3 start, std::optional<double> direction) : start_(start), direction_(direction) {}

    std::size_t size() const { return elements_.size(); }
    // Adds an element, and works out what follows from it.
    State add(FreeElement element);
    // The number of contours that fit so far.
    std::size_t choices() const { return branches_.size(); }
    // Keeps the contour `number` (from 0) of those that fit, from the shortest to the longest.
    void choose(std::size_t number);
    // True if the end of the last known element is known.
    bool has_end() const { return last_has_end_; }
    // True if all elements are known with their ends. A last arc about a known centre without any end is a
    // full circle.
    bool is_complete();
    // The elements, if one contour fits.
    std::vector<FreePiece> pieces() const;

  private:
    // A contour that fits, behind settled_.
    using Branch = std::vector<FreePiece>;
    class Group;  // elements that are worked out together

    const FreePiece& piece(const Branch& branch, std::size_t i) const {
        return i < settled_.size() ? settled_[i] : branch[i - settled_.size()];
    }
    void settle();

    Vec3 start_;
    std::optional<double> direction_;
    std::vector<FreeElement> elements_;
    std::vector<FreePiece> settled_;  // what all branches begin with
    std::vector<Branch> branches_{Branch{}};
    std::size_t known_ = 0;     // elements with a known start, direction and radius
    bool last_has_end_ = true;  // the last of these has a known end
};

}  // namespace tribo::readers::heidenhain
