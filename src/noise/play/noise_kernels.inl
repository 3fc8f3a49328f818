// SPDX-License-Identifier: MIT
// Source of the kernels, included once by each build of them.
#include "base/simd.hpp"
#include "noise/play/noise_kernels.hpp"

namespace tribo::noise {
namespace {

#if defined(__AVX__)
// Eight lanes in one register.
using F = simd::F8;
using U = std::uint32_t __attribute__((vector_size(32)));
TRIBO_LANES F splat(float v) {
    return F{v, v, v, v, v, v, v, v};
}
TRIBO_LANES U splat(std::uint32_t v) {
    return U{v, v, v, v, v, v, v, v};
}
TRIBO_LANES F to_float(U v) {
    return __builtin_convertvector(reinterpret_cast<simd::I8>(v), F);
}
#else
// Eight lanes in two registers, spelt out: g++ keeps a vector that is wider than its registers in memory.
using F4 = float __attribute__((vector_size(16)));
using U4 = std::uint32_t __attribute__((vector_size(16)));
using I4 = int __attribute__((vector_size(16)));
struct F {
    F4 low, high;
};
struct U {
    U4 low, high;
};
#define TRIBO_TWICE(TYPE, OPERATOR)                            \
    TRIBO_LANES TYPE operator OPERATOR(TYPE a, TYPE b) {       \
        return {a.low OPERATOR b.low, a.high OPERATOR b.high}; \
    }
TRIBO_TWICE(F, +)
TRIBO_TWICE(F, -)
TRIBO_TWICE(F, *)
TRIBO_TWICE(U, +)
TRIBO_TWICE(U, *)
TRIBO_TWICE(U, ^)
TRIBO_TWICE(U, &)
#undef TRIBO_TWICE
TRIBO_LANES U operator>>(U a, int bits) {
    return {a.low >> bits, a.high >> bits};
}
TRIBO_LANES F splat(float v) {
    const F4 half{v, v, v, v};
    return {half, half};
}
TRIBO_LANES U splat(std::uint32_t v) {
    const U4 half{v, v, v, v};
    return {half, half};
}
TRIBO_LANES F to_float(U v) {
    return {__builtin_convertvector(reinterpret_cast<I4>(v.low), F4),
            __builtin_convertvector(reinterpret_cast<I4>(v.high), F4)};
}
#endif

TRIBO_LANES F load(const float* p) {
    F v;
    __builtin_memcpy(&v, p, sizeof v);
    return v;
}
TRIBO_LANES U load(const std::uint32_t* p) {
    U v;
    __builtin_memcpy(&v, p, sizeof v);
    return v;
}
TRIBO_LANES void store(float* p, F v) {
    __builtin_memcpy(p, &v, sizeof v);
}

// A bijection of 32 bits with little bias (found by search, C. Wellons 2018, "lowbias32").
TRIBO_LANES U mixed(U x) {
    x = x ^ (x >> 16);
    x = x * splat(0x7feb352dU);
    x = x ^ (x >> 15);
    x = x * splat(0x846ca68bU);
    return x ^ (x >> 16);
}

// The sum of the four bytes of a hash, bent by the cubic term of Cornish and Fisher 1938, as
// base/noise_hash.hpp does with 16-bit parts. The sum of four even integers 0 ... 255 has variance 65535 / 3;
// z is scaled to variance 1 and a z^3 + (1 - 3 a) z to a kurtosis of 3.
constexpr float kUnit = 0.006765875087F;  // sqrt(3 / 65535)
constexpr float kMean = 510.0F;
constexpr float kCubic = 0.0186423825F;
constexpr float kLinear = 0.9490332781F;

TRIBO_LANES F gaussian_of(U x) {
    // Bytes 0 and 2, 1 and 3 side by side, then both pairs into one 16-bit sum.
    const U halves = splat(0x00ff00ffU);
    const U pairs = (x & halves) + ((x >> 8) & halves);
    const U sum = (pairs + (pairs >> 16)) & splat(0xffffU);
    const F z = (to_float(sum) - splat(kMean)) * splat(kUnit);
    return z * (splat(kLinear) + splat(kCubic) * z * z);
}

constexpr std::uint32_t kLanes[8] = {0, 1, 2, 3, 4, 5, 6, 7};

void gaussian(std::uint32_t key, std::uint32_t first, float* out, int count) {
    U counter = load(kLanes) + splat(first);
    for (int n = 0; n < count; n += 8) {
        store(out + n, gaussian_of(mixed(counter ^ splat(key))));
        counter = counter + splat(8U);
    }
}

void bands(BandSection* sections, int section_count, const std::uint32_t* keys, std::uint32_t first,
           const float* gain, const float* step, float* out, int count) {
    const U streams = load(keys);
    F level = load(gain);
    const F slope = load(step);
    for (int n = 0; n < count; ++n) {
        F x = gaussian_of(mixed(splat(first + static_cast<std::uint32_t>(n)) ^ streams));
        for (int k = 0; k < section_count; ++k) {
            BandSection& s = sections[k];
            const F y = load(s.b0) * x + load(s.s1);
            store(s.s1, load(s.b1) * x - load(s.a1) * y + load(s.s2));
            store(s.s2, load(s.b2) * x - load(s.a2) * y);
            x = y;
        }
        level = level + slope;
        float lane[8];
        store(lane, x * level);
        out[n] = ((lane[0] + lane[4]) + (lane[1] + lane[5])) + ((lane[2] + lane[6]) + (lane[3] + lane[7]));
    }
}

void all_pole(const float* predictor, int order, const float* response, float gain, const float* x, float* y,
              int count) {
    for (int n = 0; n < count; n += kFilterBlock) {
        float* const now = y + n;
        // The block's own samples count as zeros for now: what remains is the past alone.
        const F zero = splat(0.0F);
        store(now, zero);
        store(now + 8, zero);
        // Two chains a half block, so that additions need not wait for each other and all sums stay in
        // registers; the oldest lags first, as the youngest samples have only just been stored.
        F low = load(x + n) * splat(gain), high = load(x + n + 8) * splat(gain), low_2 = zero, high_2 = zero;
        int k = order;
        for (; k > 1; k -= 2) {
            const F a = splat(predictor[k - 1]), b = splat(predictor[k - 2]);
            low = low - load(now - k) * a;
            high = high - load(now - k + 8) * a;
            low_2 = low_2 - load(now - k + 1) * b;
            high_2 = high_2 - load(now - k + 9) * b;
        }
        if (k > 0) {
            const F a = splat(predictor[0]);
            low = low - load(now - 1) * a;
            high = high - load(now + 7) * a;
        }
        float drive[kFilterBlock];
        store(drive, low + low_2);
        store(drive + 8, high + high_2);
        low = low_2 = high = high_2 = zero;
        // The first half drives both halves, the second half itself alone.
        for (int j = 0; j < 8; j += 2) {
            const F d = splat(drive[j]), e = splat(drive[j + 1]);
            low = low + load(response + 15 - j) * d;
            high = high + load(response + 23 - j) * d;
            low_2 = low_2 + load(response + 14 - j) * e;
            high_2 = high_2 + load(response + 22 - j) * e;
        }
        for (int j = 8; j < kFilterBlock; j += 2) {
            high = high + load(response + 23 - j) * splat(drive[j]);
            high_2 = high_2 + load(response + 22 - j) * splat(drive[j + 1]);
        }
        store(now, low + low_2);
        store(now + 8, high + high_2);
    }
}

void mix(const float* y, float from, float to, float* out, int count) {
    const float step = (to - from) / static_cast<float>(count);
    F index = to_float(load(kLanes)) + splat(1.0F);
    for (int n = 0; n < count; n += 8) {
        store(out + n, load(out + n) + load(y + n) * (splat(from) + splat(step) * index));
        index = index + splat(8.0F);
    }
}

constexpr NoiseKernels kKernels{gaussian, all_pole, bands, mix};

}  // namespace
}  // namespace tribo::noise
