// SPDX-License-Identifier: MIT
// The kernels of sheet_kernels.hpp; included by sheet_kernels_sse2.cpp and sheet_kernels_v3.cpp.
#include "base/simd.hpp"
#include "elastic/sheet_kernels.hpp"

namespace tribo::elastic {
namespace {

using namespace simd;

#if defined(__wasm_simd128__)
using F = F4;
#else
using F = F8;
#endif
using I = BitsOf<F>;
constexpr int kLanes = sizeof(F) / sizeof(float);

struct TileLanes {
    F way;
    I changed;
};

TRIBO_LANES float largest(F v) {
    float most = v[0];
    for (int n = 1; n < kLanes; ++n) most = v[n] > most ? v[n] : most;
    return most;
}

// Advances eight nodes by eq. 3: towards P / K by the share of the way that one step covers.
TRIBO_LANES void advance(float* e, const float* p, F compliance, F share, TileLanes& tile) {
    const F before = load<F>(e);
    const F way = load<F>(p) * compliance - before, reached = before + way * share;
    const F after = keep(magnitude(reached) >= all<F>(kLeastMm), reached);
    store(e, after);
    tile.way = max(tile.way, magnitude(way));
    tile.changed |= reinterpret_cast<I>(after) ^ reinterpret_cast<I>(before);
}

TRIBO_LANES void report(const TileLanes* lanes, int tiles, TileMotion* motion) {
    for (int t = 0; t < tiles; ++t) motion[t] = {largest(lanes[t].way), any(lanes[t].changed != I{})};
}

void step(float* e, const float* p, std::ptrdiff_t stride, int tiles, int rows, UniformStep law,
          TileMotion* motion) {
    TileLanes lanes[kMostRunTiles] = {};
    const F compliance = all<F>(law.compliance_mm_per_n), share = all<F>(law.share);
    for (int y = 0; y < rows; ++y) {
        for (int t = 0; t < tiles; ++t) {
            const std::ptrdiff_t at = y * stride + t * kTileWidth;
            TileLanes tile = lanes[t];
#pragma GCC unroll 4
            for (int x = 0; x < kTileWidth; x += kLanes) {
                advance(e + at + x, p + at + x, compliance, share, tile);
            }
            lanes[t] = tile;
        }
    }
    report(lanes, tiles, motion);
}

// table[level] of each lane, by single loads: they are as fast as a gather instruction.
TRIBO_LANES F looked_up(const float* table, const std::uint8_t* level) {
    F v;
    for (int n = 0; n < kLanes; ++n) v[n] = table[level[n]];
    return v;
}

void step_mapped(float* e, const float* p, std::ptrdiff_t stride, int tiles, int rows, MappedStep law,
                 TileMotion* motion) {
    TileLanes lanes[kMostRunTiles] = {};
    for (int y = 0; y < rows; ++y) {
        for (int t = 0; t < tiles; ++t) {
            for (int x = 0; x < kTileWidth; x += kLanes) {
                const std::ptrdiff_t at = y * stride + t * kTileWidth + x;
                advance(e + at, p + at, looked_up(law.compliance_mm_per_n, law.levels + at),
                        looked_up(law.share, law.levels + at), lanes[t]);
            }
        }
    }
    report(lanes, tiles, motion);
}

void normals(const float* e, float* nx, float* ny, NormalRows area) {
    const F rise2 = all<F>(area.rise_mm * area.rise_mm);
    for (int y = 0; y < area.rows; ++y) {
        const std::ptrdiff_t row = y * area.stride;
        const std::ptrdiff_t above = y > 0 || area.has_above ? row - area.stride : row;
        const std::ptrdiff_t below = y < area.rows - 1 || area.has_below ? row + area.stride : row;
#pragma GCC unroll 4
        for (int x = 0; x < area.columns; x += kLanes) {
            const F gx = load<F>(e + row + x - 1) - load<F>(e + row + x + 1);
            const F gy = load<F>(e + above + x) - load<F>(e + below + x);
            const F scale = all<F>(1.0f) / sqrt(gx * gx + gy * gy + rise2);
            store(nx + row + x, gx * scale);
            store(ny + row + x, gy * scale);
        }
    }
}

// 0, 1, 2 ...
TRIBO_LANES F counted() {
    F v;
    for (int n = 0; n < kLanes; ++n) v[n] = static_cast<float>(n);
    return v;
}

// Computes the nodes of `range`. `mixed`: some may lie within the contact's edge, else none does. `over`:
// replaces the old values, else adds to them.
template <bool mixed, bool over>
TRIBO_LANES void press_range(float* p, ColumnRange range, const PressRow& row) {
    const ShareLaw& law = row.law;
    const F start = all<F>(row.start), step = all<F>(row.step), miss2 = all<F>(row.miss2);
    const F edge = all<F>(law.edge), origin = all<F>(law.origin);
    const F inner_rate = all<F>(law.inner_rate), outer_rate = all<F>(law.outer_rate);
    const F reach2 = all<F>(static_cast<float>(kReach * kReach));
    const float scale = static_cast<float>(-row.force_n / (kReach * kReach * kReach * kReach));
    const F base = all<F>(law.inner_base * scale), inner_rise = all<F>((law.inner - law.outer) * scale);
    const F outer = all<F>(law.outer * scale), outer_from_centre = all<F>(law.outer_from_centre * scale);
    F steps = counted() + all<F>(static_cast<float>(range.first - row.middle));
#pragma GCC unroll 4
    for (int x = range.first; x < range.last; x += kLanes, steps += all<F>(kLanes)) {
        const F along = steps * step + start;
        const F rho2 = min(along * along + miss2, reach2);
        const F rho = sqrt(rho2), window = reach2 - rho2;
        F share;
        if constexpr (mixed) {
            // The smaller exponent is the one of the side where rho is.
            const F beyond = rho - origin;
            const I inside = rho < edge;
            const F power = exp2(min(inner_rate * beyond, outer_rate * beyond));
            share = keep(inside, base) + (outer + keep(inside, inner_rise)) * power;
        } else {
            share = outer_from_centre * exp2(outer_rate * rho);
        }
        const F pressure = share * (window * window);
        store(p + x, over ? pressure : load<F>(p + x) + pressure);
    }
}

template <bool over>
TRIBO_LANES void press_row(float* p, const PressRow& row) {
    press_range<false, over>(p, {row.reached.first, row.within.first}, row);
    press_range<true, over>(p, row.within, row);
    press_range<false, over>(p, {row.within.last, row.reached.last}, row);
}

void press(float* p, int columns, PressRow row) {
    if (!row.over) return press_row<false>(p, row);
    for (int x = 0; x < row.reached.first; x += kLanes) store(p + x, F{});
    for (int x = row.reached.last; x < columns; x += kLanes) store(p + x, F{});
    press_row<true>(p, row);
}

constexpr SheetKernels kKernels{step, step_mapped, normals, press};

}  // namespace
}  // namespace tribo::elastic
