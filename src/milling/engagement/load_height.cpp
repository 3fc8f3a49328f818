// SPDX-License-Identifier: MIT
#include "milling/engagement/load_height.hpp"

namespace tribo::milling {

double load_height_mm(const Engagement& engagement) {
    double moment = 0, weight = 0;
    for (const EngagementBand& band : engagement.bands) {
        const double area = (band.z1_mm - band.z0_mm) * (band.exit_rad - band.entry_rad);
        weight += area;
        moment += area * 0.5 * (band.z0_mm + band.z1_mm);
    }
    return weight > 0 ? moment / weight : 0;
}

}  // namespace tribo::milling
