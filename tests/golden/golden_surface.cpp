// SPDX-License-Identifier: MIT
#include "base/hash.hpp"
#include "base/math.hpp"
#include "golden/golden.hpp"
#include "golden/golden_grooves.hpp"
#include "surface/deviation.hpp"
#include "surface/roughness.hpp"
#include "surface/textured_triangles.hpp"

namespace tribo::golden {
namespace {

void add(Hash& hash, const surface::DeviationExtreme& extreme) {
    hash.add(extreme.mm);
    hash.add(extreme.at_mm);
}

// A gentle wave under the bottoms of the grooves, above them on one side: rest, scallops and gouges.
TriangleMesh design() {
    TriangleMesh mesh;
    constexpr std::uint32_t kAcross = 9;
    for (std::uint32_t j = 0; j < kAcross; ++j) {
        for (std::uint32_t i = 0; i < kAcross; ++i) {
            const double x = 2.0 * i + 2, y = 1.5 * j + 2;
            mesh.positions.push_back({static_cast<float>(x), static_cast<float>(y),
                                      static_cast<float>(-1 + 0.04 * math::sin(0.5 * x) - 0.01 * (8 - y))});
        }
    }
    for (std::uint32_t j = 0; j + 1 < kAcross; ++j) {
        for (std::uint32_t i = 0; i + 1 < kAcross; ++i) {
            const std::uint32_t a = j * kAcross + i, b = a + 1, c = a + kAcross, d = c + 1;
            mesh.triangles.push_back({a, b, d});
            mesh.triangles.push_back({a, d, c});
        }
    }
    return mesh;
}

}  // namespace

// How a milled part differs from its design, its roughness, and the textured triangles on it.
std::uint64_t surface() {
    session::MillSession milled(grooves(), serial_for);
    if (!milled.run({})) return 0;
    const auto designed = surface::DesignedSurface::make(design());
    if (!designed) return 0;
    Hash hash;
    surface::DeviationOptions options;
    options.spacing_mm = 0.25;
    options.touch_mm = 0.05;
    options.pass_width_mm = 6;
    options.blank = &milled.stock().blank();
    const auto report = surface::compare(milled.stock(), *designed, options);
    add(hash, report.gouge);
    add(hash, report.rest);
    add(hash, report.scallop);
    for (const double value : {report.mean_mm, report.rms_mm, report.p1_mm, report.p50_mm, report.p99_mm,
                               report.rest_mm3, report.gouge_mm3, report.touched_share, report.measured_mm2})
        hash.add(value);
    hash.add(report.histogram.shares);
    hash.add(report.heights_mm);
    const auto profile = surface::height_profile(milled.stock(), {10, 4, -1}, {10, 12, -1}, {0, 0, 1}, 200);
    if (!profile) return 0;
    hash.add(*profile);
    const surface::Roughness rough = surface::roughness(*profile);
    for (const double value : {rough.ra_mm, rough.rq_mm, rough.rz_mm, rough.rt_mm}) hash.add(value);
    const auto record = surface::textured_triangles(milled.stock(), {{10, 8, -1}, {0, 0, 1}, {1, 0, 0}});
    if (!record || report.scallop.mm <= 0 || report.gouge.mm <= 0) return 0;
    hash.add(record->grooves.pitch_across_mm);
    hash.add(record->grooves.height_across_mm);
    for (const contact::TexturedTriangle& triangle : record->triangles()) {
        hash.add(triangle.normal);
        hash.add(triangle.height_mm);
    }
    return hash.value();
}

}  // namespace tribo::golden
