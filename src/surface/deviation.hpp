// SPDX-License-Identifier: MIT
// Deviations of a machined part from the designed surface: + material left, - gouge.
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "base/parallel.hpp"
#include "contact/distance_field.hpp"
#include "field/shape/shape.hpp"
#include "surface/designed_surface.hpp"
#include "surface/machined_side.hpp"

namespace tribo::surface {

struct DeviationOptions {
    // Distance between samples, mm; 0: as fine as kMaxSamples allows. Extremes are refined from the samples.
    // The spacing therefore decides which cusps are found, not how accurately they are measured.
    double spacing_mm = 0;
    // A sample at most this high along its normal was touched by a pass, mm: the tolerance of the program.
    double touch_mm = 0.01;
    // Passes farther apart than this, mm, leave no scallop between them but unreached material: the diameter
    // of the largest cutter.
    double pass_width_mm = 10;
    // Deviations beyond this are not searched for, mm.
    double limit_mm = 50;
    // The blank of the part. With it, nothing outside it counts as gouged, and its remaining surface counts
    // as no scallop. Without it, samples without material below them are left out.
    const field::Shape* blank = nullptr;
    // Keeps crests and gouged points from all over the part, not the extremes alone: of the samples on
    // scallops the highest one in each cube of three spacings.
    bool all_places = false;
    // Points of the machined surface (field/surface_points.hpp). With them, the extremes of rest and gouge
    // are also searched from the machined side.
    std::span<const Vec3> machined_mm = {};
};

// Shares of the measured area by deviation: bin i begins at first_mm + i bin_mm.
struct DeviationHistogram {
    double first_mm = 0, bin_mm = 0;
    std::vector<double> shares;  // sum 1
};

// A sample on a scallop: points of the machined surface at it, and half way to the pass on each side.
struct Crest {
    double height_mm = 0;
    std::array<Vec3, 3> machined_mm;
};

// A point of the machined surface inside the design, >= 0.
struct GougedPoint {
    double mm = 0;
    Vec3 machined_mm;
};

struct DeviationReport {
    // Rest: material outside the design. Gouge: missing material of the design. Both are distances to the
    // nearest point of the design. Scallop: a crest of rest with a pass on both sides. Its conditions:
    // touched samples less than half as high are opposite each other around it (scallop.hpp), at most
    // pass_width_mm apart; half way to the nearer one the surface has fallen by a quarter on both sides; and
    // its top is not the surface of the blank.
    DeviationExtreme gouge, rest, scallop;
    double mean_mm = 0, rms_mm = 0;               // by area, signed
    double p1_mm = 0, p50_mm = 0, p99_mm = 0;     // percentiles by area, signed
    double rest_mm3 = 0, gouge_mm3 = 0;           // heights times areas
    double touched_share = 0;                     // of the measured area
    double measured_mm2 = 0, unmeasured_mm2 = 0;  // unmeasured: outside the blank, or beyond limit_mm
    double spacing_mm = 0;
    DeviationHistogram histogram;
    std::vector<SurfaceSample> samples;  // measured ones
    std::vector<float> heights_mm;       // one per sample, signed
    // With all_places: the samples on scallops, and the gouged ones of the given points of the machined
    // surface. The extremes are among them.
    std::vector<Crest> crests;
    std::vector<GougedPoint> gouges;
};

// Approximate number of samples of one comparison (10 us and 80 bytes each), and of points of the machined
// surface (2 us and 24 bytes each).
inline constexpr std::size_t kMaxSamples = 400'000;

// Measures the distance of the machined part from the design, to the nearest point of the design: from
// samples of the designed surface (nearest_height.hpp), and for rest and gouge also from the machined side.
// The machined field must not change meanwhile. The bits do not depend on `parallel`.
DeviationReport compare(const contact::DistanceField& machined, const DesignedSurface& designed,
                        const DeviationOptions& options = {}, const ParallelFor& parallel = serial_for);

// Returns the signed distance of each position to the designed surface, mm, for the colours of a picture. NaN
// from reach_mm on.
std::vector<float> deviations_of(const TriangleMesh& machined, const DesignedSurface& designed,
                                 const ParallelFor& parallel = serial_for,
                                 double reach_mm = std::numeric_limits<double>::infinity());

}  // namespace tribo::surface
