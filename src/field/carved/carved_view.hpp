// SPDX-License-Identifier: MIT
// A carved field as it will be after some more shapes are carved. With this view the engagement of many moves
// can be measured at once, before any of them has cut.
#pragma once

#include <optional>
#include <span>

#include "field/carved/carved_field.hpp"

namespace tribo::field {

// A shape that is not carved yet, and a box around it.
struct PendingShape {
    const Shape* shape;
    Box3 bounds_mm;
};

// Refers to the field and the shapes, which must not change. Any number of threads.
class CarvedView {
  public:
    // Not explicit: a field is also a view of itself.
    CarvedView(const CarvedField& field, std::span<const PendingShape> pending = {})
        : field_(field), pending_(pending) {}

    const CarvedField& field() const { return field_; }
    // As in CarvedField.
    double distance_mm(Vec3 point_mm) const;
    bool is_material(Vec3 point_mm, double skin_mm = 0) const;
    double clear_way_mm(Vec3 point_mm, double enough_mm) const;
    // Returns a shape that has left or will leave no material at the point, but for a skin; null if none is
    // known.
    const Shape* emptied_by(Vec3 point_mm, double skin_mm) const;
    // Returns the node of material that lies deepest in `shape`, if any is deeper than `depth_mm`: the place
    // where a tool holder or a fixture collides. Finds overlaps down to about a cell. On a grid so fine that
    // near_mm of the field is less than `depth_mm`, that depth is enough.
    std::optional<Vec3> overlap(const Shape& shape, double depth_mm) const;

  private:
    const CarvedField& field_;
    std::span<const PendingShape> pending_;
};

}  // namespace tribo::field
