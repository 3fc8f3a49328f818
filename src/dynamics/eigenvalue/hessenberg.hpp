// SPDX-License-Identifier: MIT
// The eigenvalues of a small matrix.
#pragma once

#include <complex>
#include <cstddef>
#include <vector>

namespace tribo::dynamics {

// Of a real matrix of `size` rows, one after the other, with zeros below its lower diagonal. In no order.
// By the QR algorithm with double shifts (Francis 1961; Wilkinson and Reinsch, Handbook
// for Automatic Computation II/14). Any thread; allocates.
std::vector<std::complex<double>> hessenberg_eigenvalues(std::vector<double> matrix, std::size_t size);

}  // namespace tribo::dynamics
