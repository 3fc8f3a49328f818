// SPDX-License-Identifier: MIT
// Source of the kernels, included once by each build of them.
#include "base/simd.hpp"
#include "noise/noise_kernels.hpp"

namespace tribo::noise {
namespace {

using simd::F8;
using U8 = std::uint32_t __attribute__((vector_size(32)));

TRIBO_LANES U8 splat_u(std::uint32_t v) {
    return U8{v, v, v, v, v, v, v, v};
}

// A bijection of 32 bits with little bias (found by search, C. Wellons 2018, "lowbias32").
TRIBO_LANES U8 mixed(U8 x) {
    x ^= x >> 16;
    x *= 0x7feb352dU;
    x ^= x >> 15;
    x *= 0x846ca68bU;
    return x ^ (x >> 16);
}

// The sum of the four bytes of a hash, bent by the cubic term of Cornish and Fisher 1938, as
// base/noise_hash.hpp does with 16-bit parts. The sum of four even integers 0 ... 255 has variance 65535 / 3;
// z is scaled to variance 1 and a z^3 + (1 - 3 a) z to a kurtosis of 3.
constexpr float kUnit = 0.006765875087F;  // sqrt(3 / 65535)
constexpr float kMean = 510.0F;
constexpr float kCubic = 0.0186423825F;
constexpr float kLinear = 0.9490332781F;

TRIBO_LANES F8 gaussian_of(U8 x) {
    // Bytes 0 and 2, 1 and 3 side by side, then both pairs into one 16-bit sum.
    const U8 pairs = (x & 0x00ff00ffU) + ((x >> 8) & 0x00ff00ffU);
    const U8 sum = (pairs + (pairs >> 16)) & 0xffffU;
    const F8 z = (__builtin_convertvector(reinterpret_cast<simd::I8>(sum), F8) - kMean) * kUnit;
    return z * (kLinear + kCubic * z * z);
}

void gaussian(std::uint32_t key, std::uint32_t first, float* out, int count) {
    const U8 lanes = {0, 1, 2, 3, 4, 5, 6, 7};
    const U8 stream = splat_u(key);
    U8 counter = lanes + splat_u(first);
    for (int n = 0; n < count; n += 8) {
        simd::store(out + n, gaussian_of(mixed(mixed(counter) ^ stream)));
        counter += 8U;
    }
}

void bands(BandSection* sections, int section_count, const std::uint32_t* keys, std::uint32_t first,
           const float* gain, const float* step, float* out, int count) {
    U8 streams;
    std::memcpy(&streams, keys, sizeof streams);
    F8 level = simd::load(gain);
    const F8 slope = simd::load(step);
    for (int n = 0; n < count; ++n) {
        F8 x = gaussian_of(mixed(mixed(splat_u(first + static_cast<std::uint32_t>(n))) ^ streams));
        for (int k = 0; k < section_count; ++k) {
            BandSection& s = sections[k];
            const F8 y = simd::load(s.b0) * x + simd::load(s.s1);
            simd::store(s.s1, simd::load(s.b1) * x - simd::load(s.a1) * y + simd::load(s.s2));
            simd::store(s.s2, simd::load(s.b2) * x - simd::load(s.a2) * y);
            x = y;
        }
        level += slope;
        x *= level;
        float lane[8];
        simd::store(lane, x);
        out[n] = ((lane[0] + lane[4]) + (lane[1] + lane[5])) + ((lane[2] + lane[6]) + (lane[3] + lane[7]));
    }
}

void all_pole(const float* predictor, int order, const float* response, float gain, const float* x, float* y,
              int count) {
    for (int n = 0; n < count; n += kFilterBlock) {
        float* const now = y + n;
        // The block's own samples count as zeros for now: what remains is the past alone.
        const F8 zero = {};
        simd::store(now, zero);
        simd::store(now + 8, zero);
        // Two chains a half block, so that additions need not wait for each other and all sums stay in
        // registers; the oldest lags first, as the youngest samples have only just been stored.
        F8 low[2] = {simd::load(x + n) * gain, zero};
        F8 high[2] = {simd::load(x + n + 8) * gain, zero};
        int k = order;
        for (; k > 1; k -= 2) {
            const float a = predictor[k - 1], b = predictor[k - 2];
            low[0] -= simd::load(now - k) * a;
            high[0] -= simd::load(now - k + 8) * a;
            low[1] -= simd::load(now - k + 1) * b;
            high[1] -= simd::load(now - k + 9) * b;
        }
        if (k > 0) {
            low[0] -= simd::load(now - 1) * predictor[0];
            high[0] -= simd::load(now + 7) * predictor[0];
        }
        float drive[kFilterBlock];
        simd::store(drive, low[0] + low[1]);
        simd::store(drive + 8, high[0] + high[1]);
        F8 out_low[2] = {}, out_high[2] = {};
        for (int j = 0; j < kFilterBlock; j += 2) {
            for (int chain = 0; chain < 2; ++chain) {
                const float d = drive[j + chain];
                if (j < 8) out_low[chain] += simd::load(response + 15 - j - chain) * d;
                out_high[chain] += simd::load(response + 23 - j - chain) * d;
            }
        }
        simd::store(now, out_low[0] + out_low[1]);
        simd::store(now + 8, out_high[0] + out_high[1]);
    }
}

void mix(const float* y, float from, float to, float* out, int count) {
    const float step = (to - from) / static_cast<float>(count);
    const F8 lanes = {1, 2, 3, 4, 5, 6, 7, 8};
    F8 index = lanes;
    for (int n = 0; n < count; n += 8) {
        simd::store(out + n, simd::load(out + n) + simd::load(y + n) * (from + step * index));
        index += 8.0F;
    }
}

constexpr NoiseKernels kKernels{gaussian, all_pole, bands, mix};

}  // namespace
}  // namespace tribo::noise
