// SPDX-License-Identifier: MIT
// Finds the stretches of a cutter's meridian on which it meets material.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "field/carved/carved_view.hpp"
#include "milling/tool/cut_pose.hpp"
#include "milling/tool/cutter_profile.hpp"
#include "milling/tool/material_arcs.hpp"

namespace tribo::milling {

// From s0 to s1 along the meridian, mm.
struct MeridianStretch {
    double s0_mm = 0, s1_mm = 0;
    bool engaged = false;
};

// Divides a part of the envelope into rows along the meridian (finer towards its ends) and 64 columns around
// the axis. A cell is engaged if it moves outward and lies in material at one of some places, at most 2 mm
// and one cell of the grid apart; where nothing else meets, also at the ends of what moves outward. Where no
// border can be near, whole patches of cells are decided at once, so that few cells are looked at. The result
// depends on the material alone. Keeps scratch space: one thread at a time; no allocation after the first
// calls.
class ContactScout {
  public:
    explicit ContactScout(const Cutter& cutter);

    // Appends the engaged stretches between s0 and s1 in order, each with the row without contact before and
    // after it. The range must lie within the bottom, within the corner or on the cylinder; on a profile
    // within one part.
    void look(const field::CarvedView& stock, const CutPose& pose, double s0_mm, double s1_mm,
              std::vector<MeridianStretch>& out);

  private:
    static constexpr int kColumns = 64;
    struct Patch {
        int row0, row1, column0, column1;
    };
    void set_rows(double s0, double s1, double cell);
    void set_windows(const CutPose& pose);
    void drop_emptied_cells(const field::CarvedView& stock, const CutPose& pose);
    void search(const field::CarvedView& stock, const CutPose& pose, Patch patch);
    bool meets_at_end(const field::CarvedView& stock, const CutPose& pose, int row) const;
    int parts_of(double radius_mm) const;
    bool meets(const field::CarvedView& stock, const AxisCircle& circle, int column, double clear_mm) const;
    double middle(int row) const {
        const auto n = static_cast<std::size_t>(row);
        return 0.5 * (borders_[n] + borders_[n + 1]);
    }

    CutterProfile profile_;
    double radius_mm_, length_mm_;
    std::vector<double> borders_;         // of the rows, one more than these
    std::vector<std::uint64_t> windows_;  // by row: the columns that move outward
    std::vector<TurnWindow> ends_;        // by row
    std::vector<char> engaged_;           // by row
    double widest_part_mm_ = 0;           // of a column
    double front_ = 0;                    // the column in the middle of the last window
};

}  // namespace tribo::milling
