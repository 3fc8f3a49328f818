// SPDX-License-Identifier: MIT
// The kernels of ear_kernels.hpp; included by ear_kernels_sse2.cpp and ear_kernels_v3.cpp.
#include "base/simd.hpp"
#include "sound/place/ear_kernels.hpp"

namespace tribo::sound {
namespace {

using namespace simd;

constexpr int kFrames = 64, kLanes = 8;
constexpr F8 kEach{0, 1, 2, 3, 4, 5, 6, 7};

TRIBO_LANES F8 time_of(int frame) {
    return (splat(static_cast<float>(frame)) + kEach) * splat(1.0f / kFrames);
}

TRIBO_LANES F8 at(Course c, F8 t) {
    return splat(c.c0) + t * (splat(c.c1) + t * splat(c.c2));
}

// Lane n: the sum of the lanes of p[n].
TRIBO_LANES F8 sums(const F8* p) {
    F8 pair[4];
    for (int n = 0; n < 4; ++n) {
        const F8 a = p[2 * n], b = p[2 * n + 1];
        pair[n] = __builtin_shufflevector(a, b, 0, 8, 1, 9, 4, 12, 5, 13) +
                  __builtin_shufflevector(a, b, 2, 10, 3, 11, 6, 14, 7, 15);
    }
    F8 four[2];
    for (int n = 0; n < 2; ++n) {
        const F8 a = pair[2 * n], b = pair[2 * n + 1];
        four[n] = __builtin_shufflevector(a, b, 0, 1, 8, 9, 4, 5, 12, 13) +
                  __builtin_shufflevector(a, b, 2, 3, 10, 11, 6, 7, 14, 15);
    }
    return __builtin_shufflevector(four[0], four[1], 0, 1, 2, 3, 8, 9, 10, 11) +
           __builtin_shufflevector(four[0], four[1], 4, 5, 6, 7, 12, 13, 14, 15);
}

void read(const float* line, const InterpolatorTable& table, Course delay, Course gain, float* out) {
    // Where each frame reads, first for all of them: sums then need not wait for addresses.
    alignas(32) int from[kFrames], row[kFrames];
    for (int frame = 0; frame < kFrames; frame += kLanes) {
        const F8 place = (splat(static_cast<float>(frame)) + kEach) - at(delay, time_of(frame));
        I8 whole = __builtin_convertvector(place, I8);
        whole += __builtin_convertvector(whole, F8) > place;  // a mask is -1 where it holds
        const F8 share = (place - __builtin_convertvector(whole, F8)) * splat(float{kInterpolatorRows});
        const I8 nearest = __builtin_convertvector(share + splat(0.5f), I8) * kInterpolatorTaps;
        __builtin_memcpy(from + frame, &whole, sizeof whole);
        __builtin_memcpy(row + frame, &nearest, sizeof nearest);
    }
    const float* first = line - (kInterpolatorAhead - 1);
    for (int frame = 0; frame < kFrames; frame += kLanes) {
        F8 products[kLanes];
        for (int n = 0; n < kLanes; ++n) {
            const float* x = first + from[frame + n];
            const float* c = table.data() + row[frame + n];
            products[n] = load(c) * load(x) + load(c + 8) * load(x + 8);
        }
        store(out + frame, at(gain, time_of(frame)) * sums(products));
    }
}

// The width of a register: which lanes go together changes no sum.
#if defined(__AVX__)
using Wide = F8;
#else
using Wide = float __attribute__((vector_size(16)));
#endif
constexpr int kWide = sizeof(Wide) / sizeof(float);

TRIBO_LANES Wide wide(const float* p) {
    Wide v;
    __builtin_memcpy(&v, p, sizeof v);
    return v;
}
TRIBO_LANES Wide all(float f) {
    return f - Wide{};
}
// Loaded once and kept: compilers would rather load again than spend a register.
TRIBO_LANES Wide kept(const float* p) {
    Wide v = wide(p);
#if defined(__SSE2__)
    asm("" : "+x"(v));
#endif
    return v;
}
TRIBO_LANES void put(float* p, Wide v) {
    __builtin_memcpy(p, &v, sizeof v);
}

// sum[b] += the taps k and k + 8, of frame `frame` + kWide b on: what one tap sees at a frame the other sees
// 8 frames on, so two taps are worth one walk through x. Few blocks keep two sums each, or additions would
// wait for one another.
template <int kBlocks>
TRIBO_LANES void add_taps(const float* x, const float* h, int from, int to, Wide* sum) {
    constexpr int kOn = kLanes / kWide;
    Wide apart[kBlocks]{};
    Wide* other = kBlocks > 4 ? sum : apart;
    for (int first = from; first < to; first += 2 * kLanes) {
        for (int k = first; k < first + kLanes; ++k) {
            const Wide c = all(h[k]), later = all(h[k + kLanes]);
            for (int b = -kOn; b < kBlocks; ++b) {
                const Wide v = kept(x - k + kWide * b);
                if (b >= 0) sum[b] += c * v;
                if (b + kOn < kBlocks) other[b + kOn] += later * v;
            }
        }
    }
    if (kBlocks <= 4) {
        for (int b = 0; b < kBlocks; ++b) sum[b] += apart[b];
    }
}

void convolve_still(const float* x, const float* h, int taps, float* out) {
    constexpr int kBlocks = 8;
    for (int frame = 0; frame < kFrames; frame += kWide * kBlocks) {
        Wide sum[kBlocks]{};
        add_taps<kBlocks>(x + frame, h, 0, taps, sum);
        for (int b = 0; b < kBlocks; ++b) {
            float* o = out + frame + kWide * b;
            put(o, wide(o) + sum[b]);
        }
    }
}

void convolve(const float* x, const float* from, const float* to, int taps, float* out) {
    constexpr int kBlocks = 4;
    const int gliding = taps < kGlidingTaps ? taps : kGlidingTaps;
    alignas(32) float way[kHeadTaps], late[kHeadTaps], time[kFrames];
    for (int k = 0; k < taps; k += kLanes) store(way + k, load(to + k) - load(from + k));
    for (int n = 0; n < kFrames; n += kLanes) store(time + n, time_of(n));
    for (int frame = 0; frame < kFrames; frame += kWide * kBlocks) {
        if (frame % kStandingFrames == 0) {
            const F8 middle = splat((static_cast<float>(frame) + 0.5f * kStandingFrames) / kFrames);
            for (int k = gliding; k < taps; k += kLanes)
                store(late + k, load(from + k) + middle * load(way + k));
        }
        Wide start[kBlocks]{}, moved[kBlocks]{};
        // Taps k and k + 8 together, as above.
        constexpr int kOn = kLanes / kWide;
        for (int first = 0; first < gliding; first += 2 * kLanes) {
            for (int k = first; k < first + kLanes; ++k) {
                const Wide c = all(from[k]), d = all(way[k]);
                const Wide later_c = all(from[k + kLanes]), later_d = all(way[k + kLanes]);
                const float* back = x + frame - k;
                for (int b = -kOn; b < kBlocks; ++b) {
                    const Wide v = kept(back + kWide * b);
                    if (b >= 0) {
                        start[b] += c * v;
                        moved[b] += d * v;
                    }
                    if (b + kOn < kBlocks) {
                        start[b + kOn] += later_c * v;
                        moved[b + kOn] += later_d * v;
                    }
                }
            }
        }
        for (int b = 0; b < kBlocks; ++b) start[b] += wide(time + frame + kWide * b) * moved[b];
        add_taps<kBlocks>(x + frame, late, gliding, taps, start);
        for (int b = 0; b < kBlocks; ++b) {
            float* o = out + frame + kWide * b;
            put(o, wide(o) + start[b]);
        }
    }
}

void blend(const float* const* five, const float* weight, int taps, float* out) {
    const F8 w0 = splat(weight[0]), w1 = splat(weight[1]), w2 = splat(weight[2]), w3 = splat(weight[3]),
             w4 = splat(weight[4]);
    const auto four = [&](int k) {
        return (w0 * load(five[0] + k) + w1 * load(five[1] + k)) +
               (w2 * load(five[2] + k) + w3 * load(five[3] + k));
    };
    if (weight[4] == 0) {  // outside of the head
        for (int k = 0; k < taps; k += kLanes) store(out + k, four(k));
    } else {
        for (int k = 0; k < taps; k += kLanes) store(out + k, four(k) + w4 * load(five[4] + k));
    }
}

constexpr EarKernels kKernels{read, convolve, convolve_still, blend};

}  // namespace
}  // namespace tribo::sound
