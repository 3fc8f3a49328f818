// SPDX-License-Identifier: MIT
#include "readers/control/helix.hpp"

#include "base/math.hpp"

namespace tribo::readers::control {

Result<Vec3> mill_helix(const Helix& helix, Vec3 from, const PocketMove& go) {
    const Vec3 centre = helix.centre;
    const double side = helix.is_outside ? -helix.way : helix.way;
    const double lead = helix.is_outside ? -helix.lead : helix.lead;
    const Vec3 begin{centre.x + helix.radius - 2 * lead, centre.y, helix.from_z};
    const Vec3 lead_centre{centre.x + helix.radius - lead, centre.y, 0};
    Vec3 now = from;
    const auto to = [&](Vec3 place, std::optional<double> feed) {
        now = place;
        return go(place, feed, {});
    };
    const auto turn = [&](Vec3 about, double turn_rad, double z) {
        const Turn turned = turn_about(now, about, turn_rad, z);
        now = turned.to;
        return go(turned.to, helix.feed, turned.arc);
    };
    auto done = to({begin.x, begin.y, from.z}, {});
    if (done) done = to(begin, helix.plunge);
    if (done) done = turn(lead_centre, side * math::kPi, helix.from_z);
    if (done) done = turn(centre, helix.way * helix.turns * math::kTwoPi, helix.to_z);
    if (!done) return std::unexpected(done.error());
    const double share = (helix.radius - lead) / helix.radius;
    const Vec3 out_centre{centre.x + (now.x - centre.x) * share, centre.y + (now.y - centre.y) * share, 0};
    done = turn(out_centre, side * math::kPi, helix.to_z);
    if (!done) return std::unexpected(done.error());
    return now;
}

}  // namespace tribo::readers::control
