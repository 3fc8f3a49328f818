// SPDX-License-Identifier: MIT
// A carved field as it will be once some more shapes are taken out of it: what a cutter meets may so be
// looked at for many moves at once, before any of them has cut.
#pragma once

#include <optional>
#include <span>

#include "field/carved/carved_field.hpp"

namespace tribo::field {

// A shape that is still to be carved, and a box around it.
struct PendingShape {
    const Shape* shape;
    Box3 bounds_mm;
};

// Refers to the field and the shapes, which must stay as they are. Any number of threads.
class CarvedView {
  public:
    // Not explicit: a field is a view of itself.
    CarvedView(const CarvedField& field, std::span<const PendingShape> pending = {})
        : field_(field), pending_(pending) {}

    const CarvedField& field() const { return field_; }
    // As of CarvedField.
    double distance_mm(Vec3 point_mm) const;
    bool is_material(Vec3 point_mm, double skin_mm = 0) const;
    double clear_way_mm(Vec3 point_mm, double enough_mm) const;
    // The node of material that lies deepest in `shape`, if any does by more than `depth_mm`: what a tool
    // holder or a fixture would run into. Sees overlaps down to about a cell.
    std::optional<Vec3> overlap(const Shape& shape, double depth_mm) const;

  private:
    const CarvedField& field_;
    std::span<const PendingShape> pending_;
};

}  // namespace tribo::field
