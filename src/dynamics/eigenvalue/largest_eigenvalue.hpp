// SPDX-License-Identifier: MIT
// The largest eigenvalue of a linear map that is given by what it does.
#pragma once

#include <complex>
#include <cstddef>
#include <functional>
#include <vector>

namespace tribo::dynamics {

struct Eigenpair {
    std::complex<double> value = 0;
    std::vector<std::complex<double>> vector;  // of length 1; empty where the images vanish
};

// Arnoldi's method: the map on the space that a vector and its images span. The space grows until the
// residual of the largest eigenvalue in it is below 1e-10 of that value. The step of a vibration is smooth,
// so that a few images do (Saad, Numerical Methods for Large Eigenvalue Problems, ch. 6). `map` takes an
// array of `size` numbers to another one. The first vector is zero but for its last `inputs` numbers. Any
// thread; allocates.
Eigenpair largest_eigenvalue(std::size_t size, std::size_t inputs,
                             const std::function<void(const double* from, double* to)>& map);

}  // namespace tribo::dynamics
