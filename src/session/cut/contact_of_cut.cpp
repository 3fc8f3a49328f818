// SPDX-License-Identifier: MIT
#include "session/cut/contact_of_cut.hpp"

#include "base/math.hpp"

namespace tribo::session {

contact::ContactSample contact_of_cut(const milling::CutRow& row, const milling::RowForce& force, int edges,
                                      double t_s) {
    const milling::ToolFrame& frame = row.pose.frame;
    contact::ContactSample sample;
    sample.t_s = t_s;
    sample.position_mm = row.pose.tip_mm;
    sample.normal = frame.z;
    sample.force_n = frame.in_stock(force.peaks.mean_n);
    const double speed = row.feed_mm_per_s(), removed = row.chip_mm3_per_s();
    const double way = math::hypot(row.feed.across_mm, row.feed.down_mm);
    if (way > 0)
        sample.slip_mm_per_s =
            speed * ((row.feed.across_mm / way) * frame.x - (row.feed.down_mm / way) * frame.z);
    sample.area_mm2 = speed > 0 ? removed / speed : 0;
    sample.removed_mm3_per_s = removed;
    sample.phase_rad = row.phase_at_rad(t_s);
    sample.phase_rate_rad_per_s = row.spindle_rad_per_s();
    sample.spectrum = &force.spectrum;
    sample.edges = edges;
    return sample;
}

contact::ContactSample contact_in_air(const milling::CutRow& row, double t_s) {
    contact::ContactSample sample;
    sample.t_s = t_s;
    sample.position_mm = row.pose.tip_mm;
    sample.phase_rate_rad_per_s = row.spindle_rad_per_s();
    return sample;
}

}  // namespace tribo::session
