// SPDX-License-Identifier: MIT
// The pile of a carpet or of velvet: hairs that lean where a finger has brushed over them, and rise slowly. A
// grid with one node for each kPileNodes x kPileNodes nodes of the sheet, because a finger brushes a patch
// and not a pixel. One thread at a time; only the constructor allocates memory.
#pragma once

#include <span>
#include <vector>

#include "elastic/contact_ellipse.hpp"
#include "elastic/sheet.hpp"

namespace tribo::elastic {

inline constexpr int kPileNodes = 4;

class Pile {
  public:
    explicit Pile(const SheetSize& sheet);

    // A contact that touches() has come to its place from (dx, dy) mm before it. Hairs under it turn towards
    // the direction of the motion, the more the longer it has brushed them, and most in its middle.
    // The patch is taken as upright, whatever its angle.
    void brush(const ContactEllipse& contact, double dx_mm, double dy_mm);
    // Lets the hairs rise for `duration_s`. Returns false if all stand.
    bool rise(double duration_s);

    int width() const { return width_; }
    int height() const { return height_; }
    // x and y of each node's lean, row by row from the top; a length of 1 is the most.
    std::span<const float> leans() const { return leans_; }

  private:
    int width_, height_;
    double node_width_mm_, node_height_mm_;
    bool leaning_ = false;
    std::vector<float> leans_;
};

}  // namespace tribo::elastic
