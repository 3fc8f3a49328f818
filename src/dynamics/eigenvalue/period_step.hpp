// SPDX-License-Identifier: MIT
// The linear step that takes a small vibration from one period of a cut to the next.
#pragma once

#include <array>
#include <complex>
#include <span>
#include <vector>

#include "dynamics/cut_feedback.hpp"
#include "dynamics/eigenvalue/collocation.hpp"
#include "dynamics/eigenvalue/oscillators.hpp"

namespace tribo::dynamics {

// A vibration is the displacements at Gauss points of the contact of one period, and the states of the
// oscillators at its end. The period is cut at its events, and stretches with contact into short pieces. In a
// piece the answers of the oscillators to the force are polynomials, their free vibration is exact. Where
// the tooth before stands a whole period ago, its displacement is known at the same points, and multipliers
// converge twice as fast as the polynomials (Hairer and Wanner, Solving ODEs II, IV.5). Any thread;
// allocates.
class PeriodStep {
  public:
    // `cut` must outlive this object.
    PeriodStep(std::span<const Mode> modes, const CutFeedback& cut);

    // Numbers of a vibration; the states are the last ones.
    std::size_t size() const { return displacements_ + oscillators_.states(); }
    std::size_t states() const { return oscillators_.states(); }
    // One period on. Two arrays of size() numbers that do not overlap.
    void advance(const double* from, double* to) const;

    // The force of the cut over a short time.
    struct Impulse {
        double t_s;                              // in the period
        std::array<std::complex<double>, 3> ns;  // in the displacements of oscillators()
    };
    // At the Gauss points, of a vibration that a period multiplies by `multiplier`: an eigenvector of
    // advance().
    std::vector<Impulse> impulses(std::span<const std::complex<double>> vibration,
                                  std::complex<double> multiplier) const;
    const Oscillators& oscillators() const { return oscillators_; }

  private:
    struct Piece {
        double from_s, lasts_s;
        bool cuts;
        std::size_t answer;  // in answers_
        const GaussPoints* points = nullptr;
        std::size_t first = 0;   // of its displacements
        std::size_t matrix = 0;  // in matrices_: see add_matrix
        std::size_t link = 0, links = 0;
    };
    // A delayed force where the tooth before stands elsewhere in the pattern of the pitches.
    struct Link {
        std::size_t point;                // of the piece
        bool last_period;                 // the displacement is of the period before
        std::size_t first;                // displacement of the piece that it comes from
        std::vector<double> share;        // of the points of that piece
        std::array<double, 9> stiffness;  // force over displacement
    };

    void add_matrix(Piece& piece);
    void add_link(std::size_t point, double t_s, const std::array<double, 9>& stiffness);
    void delayed_forces(const Piece& piece, const double* from, const double* to, double* forces) const;

    const CutFeedback& cut_;
    const Oscillators oscillators_;
    const bool one_delay_;  // of the whole period
    std::vector<Oscillators::Answer> answers_;
    std::vector<Piece> pieces_;
    std::vector<Link> links_;
    std::vector<double> matrices_;
    std::vector<double> springs_;  // force over displacement at each point, by pieces
    std::size_t displacements_ = 0, most_points_ = 0;
};

}  // namespace tribo::dynamics
