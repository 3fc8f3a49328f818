// SPDX-License-Identifier: MIT
// Lanes: the same formula for one double and for eight floats at once, with GCC/Clang vector extensions. One
// source serves SSE2, AVX2, NEON and WebAssembly with the same bits. Functions are always inlined and have
// internal linkage: otherwise the linker could use the code of a file compiled for a newer processor on an
// older one.
#pragma once

#include <cmath>
#include <cstdint>
#include <type_traits>

#if defined(__SSE2__)
#include <immintrin.h>
#elif defined(__wasm_simd128__)
#include <wasm_simd128.h>
#endif

namespace tribo::simd {
namespace {

#define TRIBO_LANES [[gnu::always_inline, maybe_unused]] inline
// Lanes go to and from memory by __builtin_memcpy. The checked std::memcpy of a hardened build
// (_FORTIFY_SOURCE) keeps g++ from holding them in registers: a sound source then takes a quarter longer.

using F8 = float __attribute__((vector_size(32)));
using I8 = int __attribute__((vector_size(32)));
using S8 = short __attribute__((vector_size(16)));
using B8 = signed char __attribute__((vector_size(8)));
#if defined(__wasm_simd128__)
// Four lanes: the size of WebAssembly registers. Loops that keep many values are faster with these there.
using F4 = float __attribute__((vector_size(16)));
using I4 = int __attribute__((vector_size(16)));
#endif

// The type of a comparison of two T.
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

TRIBO_LANES F8 splat(float f) {
    return F8{f, f, f, f, f, f, f, f};
}

template <class T>
    requires std::is_floating_point_v<T>
TRIBO_LANES T select(bool m, T a, T b) {
    return m ? a : b;
}
TRIBO_LANES F8 select(I8 m, F8 a, F8 b) {
    return m ? a : b;
}

#if !defined(__AVX__) && (defined(__SSE2__) || defined(__wasm_simd128__))
// Applies an operation that the processor has for four lanes to both halves of eight.
template <class Operation>
TRIBO_LANES F8 by_halves(F8 a, F8 b, Operation operation) {
#if defined(__SSE2__)
    using F4 = __m128;
#else
    using F4 = v128_t;
#endif
    F4 x[2], y[2];
    __builtin_memcpy(x, &a, sizeof a);
    __builtin_memcpy(y, &b, sizeof b);
    x[0] = operation(x[0], y[0]);
    x[1] = operation(x[1], y[1]);
    __builtin_memcpy(&a, x, sizeof a);
    return a;
}
#endif

// b < a ? b : a, and a < b ? b : a: the behaviour of the instructions, also for equal values and NaN.
template <class T>
TRIBO_LANES T min(T a, T b) {
#if defined(__AVX__)
    if constexpr (std::is_same_v<T, F8>) {
        return reinterpret_cast<F8>(_mm256_min_ps(reinterpret_cast<__m256>(b), reinterpret_cast<__m256>(a)));
    }
#elif defined(__SSE2__)
    if constexpr (std::is_same_v<T, F8>) {
        return by_halves(a, b, [](__m128 x, __m128 y) { return _mm_min_ps(y, x); });
    }
#elif defined(__wasm_simd128__)
    if constexpr (std::is_same_v<T, F8>) {
        return by_halves(a, b, [](v128_t x, v128_t y) { return wasm_f32x4_pmin(x, y); });
    }
#endif
    return select(b < a, b, a);
}
template <class T>
TRIBO_LANES T max(T a, T b) {
#if defined(__AVX__)
    if constexpr (std::is_same_v<T, F8>) {
        return reinterpret_cast<F8>(_mm256_max_ps(reinterpret_cast<__m256>(b), reinterpret_cast<__m256>(a)));
    }
#elif defined(__SSE2__)
    if constexpr (std::is_same_v<T, F8>) {
        return by_halves(a, b, [](__m128 x, __m128 y) { return _mm_max_ps(y, x); });
    }
#elif defined(__wasm_simd128__)
    if constexpr (std::is_same_v<T, F8>) {
        return by_halves(a, b, [](v128_t x, v128_t y) { return wasm_f32x4_pmax(x, y); });
    }
#endif
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
    __builtin_memcpy(half, &a, sizeof a);
    half[0] = _mm_sqrt_ps(half[0]);
    half[1] = _mm_sqrt_ps(half[1]);
    __builtin_memcpy(&a, half, sizeof a);
    return a;
#elif defined(__wasm_simd128__)
    v128_t half[2];
    __builtin_memcpy(half, &a, sizeof a);
    half[0] = wasm_f32x4_sqrt(half[0]);
    half[1] = wasm_f32x4_sqrt(half[1]);
    __builtin_memcpy(&a, half, sizeof a);
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
// True if it holds in any lane.
TRIBO_LANES bool any(bool m) {
    return m;
}
TRIBO_LANES bool any(I8 m) {
#if defined(__AVX__)
    return _mm256_movemask_ps(reinterpret_cast<__m256>(m)) != 0;
#elif defined(__wasm_simd128__)
    v128_t half[2];
    __builtin_memcpy(half, &m, sizeof m);
    return wasm_v128_any_true(wasm_v128_or(half[0], half[1]));
#elif defined(__SSE2__)
    __m128 half[2];
    __builtin_memcpy(half, &m, sizeof m);
    return _mm_movemask_ps(_mm_or_ps(half[0], half[1])) != 0;
#else
    long long part[4];
    __builtin_memcpy(part, &m, sizeof m);
    return (part[0] | part[1] | part[2] | part[3]) != 0;
#endif
}

// True if it holds in every lane.
TRIBO_LANES bool every(bool m) {
    return m;
}
TRIBO_LANES bool every(I8 m) {
    return !any(~m);
}

// Returns the right neighbour of each lane; the last lane keeps its value.
TRIBO_LANES F8 next(F8 v) {
    return __builtin_shufflevector(v, v, 1, 2, 3, 4, 5, 6, 7, 7);
}

// The integer vector of the same size as the float vector F.
template <class F>
using BitsOf = decltype(F{} < F{});

// f in every lane of F.
template <class F>
TRIBO_LANES F all(float f) {
    return f - F{};
}
// a where the mask holds, else 0.
template <class F>
TRIBO_LANES F keep(BitsOf<F> m, F a) {
    return reinterpret_cast<F>(m & reinterpret_cast<BitsOf<F>>(a));
}
// |a|; the zero is always positive.
template <class F>
TRIBO_LANES F magnitude(F a) {
    return reinterpret_cast<F>(reinterpret_cast<BitsOf<F>>(a) & 0x7fffffff);
}

// 2^x for x in -126..126, with an error within 4e-7 of it.
template <class F>
TRIBO_LANES F exp2(F x) {
    // Adding this leaves the nearest integer in the lowest bits.
    const F shift = all<F>(0x1.8p23f);
    const F shifted = x + shift, part = x - (shifted - shift);
    // Chebyshev, degree 5, in nested form with the fewest operations: a loop over many x has other operations
    // to run meanwhile.
    F power = all<F>(1.340043217e-3f) * part + all<F>(9.676037098e-3f);
    power = power * part + all<F>(5.550327214e-2f);
    power = power * part + all<F>(0.2402210736f);
    power = power * part + all<F>(0.6931472067f);
    power = power * part + all<F>(1.0f);
    const int mantissa_bits = 23;
    return reinterpret_cast<F>(reinterpret_cast<BitsOf<F>>(power) +
                               (reinterpret_cast<BitsOf<F>>(shifted) << mantissa_bits));
}

#if defined(__wasm_simd128__)
TRIBO_LANES F4 min(F4 a, F4 b) {
    return reinterpret_cast<F4>(wasm_f32x4_pmin(reinterpret_cast<v128_t>(a), reinterpret_cast<v128_t>(b)));
}
TRIBO_LANES F4 max(F4 a, F4 b) {
    return reinterpret_cast<F4>(wasm_f32x4_pmax(reinterpret_cast<v128_t>(a), reinterpret_cast<v128_t>(b)));
}
TRIBO_LANES F4 sqrt(F4 a) {
    return reinterpret_cast<F4>(wasm_f32x4_sqrt(reinterpret_cast<v128_t>(a)));
}
TRIBO_LANES bool any(I4 m) {
    return wasm_v128_any_true(reinterpret_cast<v128_t>(m));
}
TRIBO_LANES void store(float* p, F4 v) {
    __builtin_memcpy(p, &v, sizeof v);
}
#endif

// A mask for 16-bit lanes.
TRIBO_LANES S8 narrow(I8 m) {
    return __builtin_convertvector(m, S8);
}

template <class F = F8>
TRIBO_LANES F load(const float* p) {
    F v;
    __builtin_memcpy(&v, p, sizeof v);
    return v;
}
TRIBO_LANES void store(float* p, F8 v) {
    __builtin_memcpy(p, &v, sizeof v);
}

}  // namespace
}  // namespace tribo::simd
