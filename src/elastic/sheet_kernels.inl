// SPDX-License-Identifier: MIT
// The kernels of sheet_kernels.hpp; included by sheet_kernels_sse2.cpp and sheet_kernels_v3.cpp.
#include "base/simd.hpp"
#include "elastic/sheet_kernels.hpp"

namespace tribo::elastic {
namespace {

using namespace simd;

struct TileLanes {
    F8 way;
    I8 changed;
};

TRIBO_LANES float largest(F8 v) {
    float most = v[0];
    for (int n = 1; n < 8; ++n) most = v[n] > most ? v[n] : most;
    return most;
}

// Eight nodes by eq. 3: towards P / K by the share of the way that one step covers.
TRIBO_LANES void advance(float* e, const float* p, F8 compliance, F8 share, TileLanes& tile) {
    const F8 before = load(e);
    const F8 way = load(p) * compliance - before, reached = before + way * share;
    const F8 after = keep(magnitude(reached) >= splat(kLeastMm), reached);
    store(e, after);
    tile.way = max(tile.way, magnitude(way));
    tile.changed |= reinterpret_cast<I8>(after) ^ reinterpret_cast<I8>(before);
}

TRIBO_LANES void report(const TileLanes* lanes, int tiles, TileMotion* motion) {
    for (int t = 0; t < tiles; ++t) motion[t] = {largest(lanes[t].way), any(lanes[t].changed != I8{})};
}

void step(float* e, const float* p, std::ptrdiff_t stride, int tiles, int rows, UniformStep law,
          TileMotion* motion) {
    TileLanes lanes[kMostRunTiles] = {};
    const F8 compliance = splat(law.compliance_mm_per_n), share = splat(law.share);
    for (int y = 0; y < rows; ++y) {
        for (int t = 0; t < tiles; ++t) {
            const std::ptrdiff_t at = y * stride + t * kTileWidth;
            TileLanes tile = lanes[t];
            advance(e + at, p + at, compliance, share, tile);
            advance(e + at + 8, p + at + 8, compliance, share, tile);
            lanes[t] = tile;
        }
    }
    report(lanes, tiles, motion);
}

TRIBO_LANES I8 wide(const std::uint8_t* level) {
    return I8{level[0], level[1], level[2], level[3], level[4], level[5], level[6], level[7]};
}

void step_mapped(float* e, const float* p, std::ptrdiff_t stride, int tiles, int rows, MappedStep law,
                 TileMotion* motion) {
    TileLanes lanes[kMostRunTiles] = {};
    for (int y = 0; y < rows; ++y) {
        for (int t = 0; t < tiles; ++t) {
            for (int half = 0; half < kTileWidth; half += 8) {
                const std::ptrdiff_t at = y * stride + t * kTileWidth + half;
                const I8 level = wide(law.levels + at);
                advance(e + at, p + at, gather(law.compliance_mm_per_n, level), gather(law.share, level),
                        lanes[t]);
            }
        }
    }
    report(lanes, tiles, motion);
}

void normals(const float* e, float* nx, float* ny, NormalRows area) {
    const F8 per_mm = splat(area.per_mm), one = splat(1.0f);
    for (int y = 0; y < area.rows; ++y) {
        const std::ptrdiff_t row = y * area.stride;
        const std::ptrdiff_t above = y > 0 || area.has_above ? row - area.stride : row;
        const std::ptrdiff_t below = y < area.rows - 1 || area.has_below ? row + area.stride : row;
        for (int x = 0; x < area.columns; x += 8) {
            const F8 gx = (load(e + row + x - 1) - load(e + row + x + 1)) * per_mm;
            const F8 gy = (load(e + above + x) - load(e + below + x)) * per_mm;
            const F8 scale = inverse_sqrt(gx * gx + gy * gy + one);
            store(nx + row + x, gx * scale);
            store(ny + row + x, gy * scale);
        }
    }
}

constexpr F8 kSteps{0, 1, 2, 3, 4, 5, 6, 7};

void press(float* p, int columns, PressRow row) {
    const F8 last = splat(row.dx_last), spacing = splat(row.spacing), dx0 = splat(row.dx0);
    const F8 ux = splat(row.ux), u0 = splat(row.u0), vx = splat(row.vx), v0 = splat(row.v0);
    const ShareLaw& law = row.law;
    const F8 edge = splat(law.edge), origin = splat(law.origin);
    const F8 inner_rate = splat(law.inner_rate), outer_rate = splat(law.outer_rate);
    const F8 reach2 = splat(static_cast<float>(kReach * kReach));
    const float scale = static_cast<float>(-row.force_n / (kReach * kReach * kReach * kReach));
    const F8 base = splat(law.inner_base * scale);
    const F8 outer = splat(law.outer * scale), inner_rise = splat((law.inner - law.outer) * scale);
    F8 steps = kSteps;
    for (int x = 0; x < columns; x += 8, steps += splat(8.0f)) {
        const F8 dx = min(steps * spacing + dx0, last);
        const F8 u = ux * dx + u0, v = vx * dx + v0;
        const F8 rho2 = min(u * u + v * v, reach2);
        if (!any(rho2 < reach2)) continue;
        const F8 rho = sqrt(rho2), window = reach2 - rho2;
        const I8 inside = rho < edge;
        // The lesser exponent is that of the side where rho is.
        const F8 beyond = rho - origin, power = exp2(min(inner_rate * beyond, outer_rate * beyond));
        const F8 share = keep(inside, base) + (outer + keep(inside, inner_rise)) * power;
        store(p + x, load(p + x) + share * (window * window));
    }
}

constexpr SheetKernels kKernels{step, step_mapped, normals, press};

}  // namespace
}  // namespace tribo::elastic
