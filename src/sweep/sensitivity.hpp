// SPDX-License-Identifier: MIT
// Sobol' indices: the share of the variance of a result that an input causes alone (first order), and with
// all others (total). One thread at a time; allocates in the constructor only.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace tribo::sweep {

struct SobolIndex {
    double first = 0, total = 0;
};

// Takes the results of a plan of the design `sobol`, a block at a time, in any order.
class Sensitivity {
  public:
    explicit Sensitivity(std::size_t inputs);

    // The results of one block of k + 2 cases, in the order of the plan. A block with a NaN is left out.
    void add(std::span<const double> block);

    std::uint64_t blocks() const { return blocks_; }
    // Mean and variance of the result, from the cases A and B.
    double mean() const;
    double variance() const;
    // One per input, after Saltelli et al. 2010, table 2 (b) and (f). Errors of the sample may bring an index
    // a little below 0 or above 1. All 0 where the variance is 0 within rounding.
    std::vector<SobolIndex> indices() const;

  private:
    std::uint64_t blocks_ = 0;
    double origin_ = 0;  // the first result; results are summed relative to it
    double sum_ = 0, squares_ = 0;
    struct Sums {
        double first = 0, total = 0;
    };
    std::vector<Sums> sums_;
};

}  // namespace tribo::sweep
