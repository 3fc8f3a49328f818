// SPDX-License-Identifier: MIT
// The modes as oscillators, and their answer to a force in a short piece of time.
#pragma once

#include <array>
#include <complex>
#include <span>
#include <vector>

#include "dynamics/cut_feedback.hpp"
#include "dynamics/eigenvalue/collocation.hpp"
#include "dynamics/mode.hpp"

namespace tribo::dynamics {

// Displacements have as many numbers as the directions of the modes span: 1 to 3. The state of an oscillator
// is (q, q' / w). Matrices by rows.
class Oscillators {
  public:
    explicit Oscillators(std::span<const Mode> modes);

    std::size_t dimensions() const { return basis_.size(); }
    std::size_t states() const { return 2 * oscillators_.size(); }
    // S in the displacements, dimensions() x dimensions() of the nine.
    std::array<double, 9> reduced(const Matrix3& stiffness) const;
    // The highest natural frequency with a spring beside each, rad/s.
    double fastest(double spring_n_per_mm) const;
    // The displacement over a force e^(s t), dimensions() x dimensions() of the nine, mm/N.
    std::array<std::complex<double>, 9> compliance(std::complex<double> s_per_s) const;

    // What happens in a piece of time; n = points x dimensions().
    struct Answer {
        // The state of each oscillator at the end over that at the begin, 2 x 2 each.
        std::vector<double> decay;
        // With forces at Gauss points:
        std::vector<double> free;   // displacements at the points over the states at the begin, n x states()
        std::vector<double> moved;  // displacements at the points over the forces there, n x n
        std::vector<double> end;    // states at the end over the forces, states() x n
    };
    Answer without_force(double lasts_s) const;
    Answer answer(double lasts_s, const GaussPoints& points) const;

  private:
    struct Oscillator {
        double w, damping, stiffness;
        std::array<double, 3> along{};  // the direction in the basis
    };
    std::vector<Vec3> basis_;  // orthonormal
    std::vector<Oscillator> oscillators_;
};

}  // namespace tribo::dynamics
