// SPDX-License-Identifier: MIT
// The deviation of a milled part from its designed surface.
#pragma once

#include "base/parallel.hpp"
#include "session/cut/mill_session.hpp"
#include "surface/designed_surface.hpp"
#include "surface/deviation.hpp"
#include "surface/form_error.hpp"

namespace tribo::app {

// With what bending left on the part (`form_error` may be empty). The session has run. `all_places`: as in
// DeviationOptions.
surface::DeviationReport part_deviation(const session::MillSession& session,
                                        const surface::DesignedSurface& designed,
                                        const surface::FormError& form_error, const ParallelFor& parallel,
                                        bool all_places = false);

}  // namespace tribo::app
