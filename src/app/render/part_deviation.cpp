// SPDX-License-Identifier: MIT
#include "app/render/part_deviation.hpp"

#include <algorithm>
#include <cmath>

#include "field/shape/surface_points.hpp"

namespace tribo::app {

surface::DeviationReport part_deviation(const session::MillSession& session,
                                        const surface::DesignedSurface& designed,
                                        const surface::FormError& form_error, const ParallelFor& parallel,
                                        bool all_places) {
    surface::DeviationOptions options;
    options.pass_width_mm = 0;
    for (const milling::Cutter& c : session.setup().cutters) {
        options.pass_width_mm = std::max(options.pass_width_mm, c.diameter_mm);
    }
    options.blank = &session.stock().blank();
    // The positions of cusps are refined from the samples, so a spacing of one cell is enough.
    options.spacing_mm = std::max(session.setup().cell_mm,
                                  std::sqrt(designed.area_mm2() / static_cast<double>(surface::kMaxSamples)));
    const std::vector<Vec3> points = field::surface_points(session.stock(), surface::kMaxSamples, parallel);
    options.machined_mm = points;
    options.all_places = all_places;
    const surface::SurfaceWithFormError bent(session.stock(), form_error);
    const contact::DistanceField& machined =
        form_error.empty() ? session.stock() : static_cast<const contact::DistanceField&>(bent);
    return surface::compare(machined, designed, options, parallel);
}

}  // namespace tribo::app
