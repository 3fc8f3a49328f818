// SPDX-License-Identifier: MIT
// The discrete Fourier transform, for learning. Allocates nothing; any thread.
#pragma once

#include <complex>
#include <span>

namespace tribo::noise {

// In place, sum of x[n] e^(-2 pi i k n / N); the length N is a power of two. Radix 2 (Cooley and Tukey 1965).
void fourier(std::span<std::complex<double>> x);

}  // namespace tribo::noise
