// SPDX-License-Identifier: MIT
// A response as a sum of modes and two residual terms, and its refinement by least squares. Private to the
// fit of modes (mode_fit.hpp).
#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

namespace tribo::dynamics {

// A measured response in its band.
struct Response {
    std::vector<double> hz;               // > 0, rising
    std::vector<std::complex<double>> h;  // times `scale`: of the size of 1
    std::vector<double> weight;           // of an error; at first measured()
    double scale = 1;                     // the largest measured response is 1 then
    double power = 0;                     // sum of squares of the weighted response
    double step_hz = 0;                   // typical distance of the points
    double first_hz = 0, last_hz = 0;
    std::size_t points = 0;  // before they were averaged
    int derivatives = 0;

    // From `hz` and `h`, at least two of them: averages, scales and weighs. `derivatives`: of the
    // displacement, that were measured.
    void prepare(int derivatives, std::size_t most_points);
    // What is measured over the displacement, 1 at the end of the band.
    double measured(double hz) const;
    // A narrower mode lies between the points.
    double least_damping(double hz) const;
};

// 1 / (1 - r^2 + 2 i zeta r).
std::complex<double> unit_answer(double ratio, double damping);

class ModalModel {
  public:
    struct Mode {
        double hz = 0, damping = 0;
        double compliance = 0;  // > 0, in the scale of the response
        double peak() const { return compliance / (2 * damping); }
    };

    // Keeps a reference. Without modes.
    explicit ModalModel(const Response& response);

    void add(const Mode& mode);
    void remove(std::size_t mode);
    // Two modes of half the compliance, each half a bandwidth to its side.
    void split(std::size_t mode);
    // After the weights of the response have changed.
    void look_again() { sum_of_squares_ = squares_of_errors(); }
    // Levenberg-Marquardt, until nothing is gained any more or for so many steps.
    void refine(int most_steps = 40);

    const std::vector<Mode>& modes() const { return modes_; }
    double sum_of_squares() const { return sum_of_squares_; }
    // The response less the model.
    std::vector<std::complex<double>> errors() const;

  private:
    double squares_of_errors() const;
    void normal_equations(std::vector<double>& matrix, std::vector<double>& right) const;
    void step(std::span<const double> by);

    const Response* response_;
    std::vector<Mode> modes_;
    double constant_ = 0, line_ = 0;  // line_: times 1 / Hz^2
    double sum_of_squares_ = 0;
};

}  // namespace tribo::dynamics
