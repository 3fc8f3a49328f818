// SPDX-License-Identifier: MIT
// Lanes: the same formula for one double and for eight floats at once, with GCC/Clang vector extensions, so
// that one source serves SSE2, AVX2, NEON and WebAssembly with the same bits. Functions are always inlined
// and of internal linkage: a file compiled for a newer processor must not lend its code to one that is not.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <type_traits>

#if defined(__SSE2__)
#include <immintrin.h>
#elif defined(__wasm_simd128__)
#include <wasm_simd128.h>
#endif

namespace tribo::simd {
namespace {

#define TRIBO_LANES [[gnu::always_inline, maybe_unused]] inline

using F8 = float __attribute__((vector_size(32)));
using I8 = int __attribute__((vector_size(32)));
using S8 = short __attribute__((vector_size(16)));

// What a comparison of two T gives.
template <class T>
struct MaskOf {
    using type = bool;
};
template <>
struct MaskOf<F8> {
    using type = I8;
};
template <class T>
using Mask = typename MaskOf<T>::type;

template <class T>
TRIBO_LANES T broadcast(double v) {
    if constexpr (std::is_same_v<T, double>) {
        return v;
    } else {
        const auto f = static_cast<float>(v);
        return F8{f, f, f, f, f, f, f, f};
    }
}

template <class T>
    requires std::is_floating_point_v<T>
TRIBO_LANES T select(bool m, T a, T b) {
    return m ? a : b;
}
TRIBO_LANES F8 select(I8 m, F8 a, F8 b) {
    return m ? a : b;
}

template <class T>
TRIBO_LANES T min(T a, T b) {
    return select(b < a, b, a);
}
template <class T>
TRIBO_LANES T max(T a, T b) {
    return select(a < b, b, a);
}
template <class T>
TRIBO_LANES T abs(T a) {
    return max(a, -a);
}

TRIBO_LANES double sqrt(double a) {
    return std::sqrt(a);
}
TRIBO_LANES F8 sqrt(F8 a) {
#if defined(__AVX__)
    return reinterpret_cast<F8>(_mm256_sqrt_ps(reinterpret_cast<__m256>(a)));
#elif defined(__SSE2__)
    __m128 half[2];
    std::memcpy(half, &a, sizeof a);
    half[0] = _mm_sqrt_ps(half[0]);
    half[1] = _mm_sqrt_ps(half[1]);
    std::memcpy(&a, half, sizeof a);
    return a;
#elif defined(__wasm_simd128__)
    v128_t half[2];
    std::memcpy(half, &a, sizeof a);
    half[0] = wasm_f32x4_sqrt(half[0]);
    half[1] = wasm_f32x4_sqrt(half[1]);
    std::memcpy(&a, half, sizeof a);
    return a;
#else
    for (int n = 0; n < 8; ++n) a[n] = std::sqrt(a[n]);
    return a;
#endif
}

TRIBO_LANES bool both(bool a, bool b) {
    return a && b;
}
TRIBO_LANES I8 both(I8 a, I8 b) {
    return a & b;
}
TRIBO_LANES bool either(bool a, bool b) {
    return a || b;
}
TRIBO_LANES I8 either(I8 a, I8 b) {
    return a | b;
}
// Whether it holds in any lane.
TRIBO_LANES bool any(bool m) {
    return m;
}
TRIBO_LANES bool any(I8 m) {
#if defined(__AVX__)
    return _mm256_movemask_ps(reinterpret_cast<__m256>(m)) != 0;
#elif defined(__SSE2__)
    __m128 half[2];
    std::memcpy(half, &m, sizeof m);
    return _mm_movemask_ps(_mm_or_ps(half[0], half[1])) != 0;
#else
    long long part[4];
    std::memcpy(part, &m, sizeof m);
    return (part[0] | part[1] | part[2] | part[3]) != 0;
#endif
}

// Each lane's right neighbour; the last lane stays.
TRIBO_LANES F8 next(F8 v) {
    return __builtin_shufflevector(v, v, 1, 2, 3, 4, 5, 6, 7, 7);
}

// A mask for lanes of 16 bits.
TRIBO_LANES S8 narrow(I8 m) {
    return __builtin_convertvector(m, S8);
}

TRIBO_LANES S8 splat(std::uint16_t v) {
    const auto s = static_cast<short>(v);
    return S8{s, s, s, s, s, s, s, s};
}
TRIBO_LANES S8 load(const std::uint16_t* p) {
    S8 v;
    std::memcpy(&v, p, sizeof v);
    return v;
}
TRIBO_LANES void store(std::uint16_t* p, S8 v) {
    std::memcpy(p, &v, sizeof v);
}
TRIBO_LANES F8 splat(float f) {
    return F8{f, f, f, f, f, f, f, f};
}
TRIBO_LANES F8 load(const float* p) {
    F8 v;
    std::memcpy(&v, p, sizeof v);
    return v;
}
TRIBO_LANES void store(float* p, F8 v) {
    std::memcpy(p, &v, sizeof v);
}

}  // namespace
}  // namespace tribo::simd
