// SPDX-License-Identifier: MIT
// Areas of a plane within closed contours of lines and arcs, and the rings at a distance from their edge. The
// edges are offset, split where they cross, and kept as far as they keep the distance. Pure geometry, mm.
#pragma once

#include <cstddef>
#include <vector>

#include "readers/gcode/motion/contour.hpp"

namespace tribo::readers::control {

// A closed contour: each element begins where the one before it ends.
using Ring = std::vector<gcode::Element>;

class Area {
  public:
    // The area within any of the pockets and outside of all islands.
    Area(std::vector<Ring> pockets, std::vector<Ring> islands);
    // The area within an odd number of the contours: one within another is an island.
    explicit Area(std::vector<Ring> contours);

    bool has(gcode::Point p) const;
    // Distance of the nearest point of the edge.
    double to_edge(gcode::Point p) const;
    // The closed lines at a distance from the edge, with the area that is farther from it on their left.
    std::vector<Ring> rings_at(double distance) const;
    // True if a straight way keeps the distance from the edge.
    bool keeps(gcode::Point from, gcode::Point to, double distance) const;
    std::size_t size() const { return edge_.size(); }

  private:
    void find_edge();

    std::vector<Ring> pockets_, islands_;
    bool alternates_ = false;           // pockets_ are islands of each other
    std::vector<gcode::Element> edge_;  // with the area on their left
};

}  // namespace tribo::readers::control
