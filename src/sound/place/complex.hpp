// SPDX-License-Identifier: MIT
// Complex numbers of spectra, with arithmetic that is the same on every compiler. Any thread; no allocation.
#pragma once

#include <complex>

namespace tribo::sound {

using Complex = std::complex<double>;

// std::complex's own product may call a library function that tests for infinities.
inline Complex product(Complex a, Complex b) {
    return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

inline double squared(Complex a) {
    return a.real() * a.real() + a.imag() * a.imag();
}

}  // namespace tribo::sound
