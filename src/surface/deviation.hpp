// SPDX-License-Identifier: MIT
// How a machined part differs from the surface it was meant to have: + material left, - gouge.
#pragma once

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
    // Distance between samples, mm; 0: as fine as kMaxSamples allows. Extremes are sharpened from the
    // samples, so the spacing decides which cusps are seen, not how exactly they are measured.
    double spacing_mm = 0;
    // A sample at most this high was touched by a pass, mm: the tolerance of the program.
    double touch_mm = 0.01;
    // Passes farther apart than this leave no scallop between them but material never reached, mm: the
    // diameter of the largest cutter.
    double pass_width_mm = 10;
    // Deviations beyond this are not searched for, mm.
    double limit_mm = 50;
    // What the part was cut from. With it, nothing outside it counts as gouged, and where its own surface
    // still stands there is no scallop; without it, samples under which no material is found are left out.
    const field::Shape* blank = nullptr;
    // Points of the machined surface (field/surface_points.hpp). With them the extremes of rest and gouge are
    // looked for from the machined side too.
    std::span<const Vec3> machined_mm = {};
};

// Shares of the measured area by deviation: bin i holds those from first_mm + i bin_mm.
struct DeviationHistogram {
    double first_mm = 0, bin_mm = 0;
    std::vector<double> shares;  // sum 1
};

struct DeviationReport {
    // Rest: material outside the design, gouge: design that is missing; how far from the nearest point of the
    // design. Scallop: a crest of rest with a pass on both
    // sides: samples that were touched and are less than half as high stand opposite each other around it
    // (scallop.hpp), no more than pass_width_mm apart; half way to the nearer one the surface has fallen by a
    // quarter on both sides; and its top is not the blank's own surface.
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
};

// Samples of one comparison, about: 10 us each, 80 bytes; and so many points of the machined surface, 2 us
// and 24 bytes.
inline constexpr std::size_t kMaxSamples = 400'000;

// Measures how far the machined part stands off the design, counted to the nearest point of the design: from
// samples of the designed surface (nearest_height.hpp), and rest and gouge from the machined side too. The
// machined field must stay as it is meanwhile. Same bits whatever `parallel` does.
DeviationReport compare(const contact::DistanceField& machined, const DesignedSurface& designed,
                        const DeviationOptions& options = {}, const ParallelFor& parallel = serial_for);

// Signed distance of each position to the designed surface, mm: the colours of a picture. NaN from reach_mm
// on.
std::vector<float> deviations_of(const TriangleMesh& machined, const DesignedSurface& designed,
                                 const ParallelFor& parallel = serial_for,
                                 double reach_mm = std::numeric_limits<double>::infinity());

}  // namespace tribo::surface
