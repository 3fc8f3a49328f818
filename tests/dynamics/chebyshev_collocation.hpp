// SPDX-License-Identifier: MIT
// A second way to the multiplier, exact but slow: one polynomial through Chebyshev points on each stretch
// between two events, one matrix for all unknowns of a period, and all of its eigenvalues. It shares only the
// force's matrices with the first.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <span>
#include <vector>

#include "base/math.hpp"
#include "dynamics/cut_feedback.hpp"
#include "dynamics/mode.hpp"

namespace tribo::dynamics::test::chebyshev {

using Complex = std::complex<double>;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Chebyshev points of the second kind on [-1, 1], ascending, with what collocation needs of them.
struct Points {
    explicit Points(int count) : x(count), weight(count), derivative(count, count) {
        for (int k = 0; k < count; ++k) {
            x[k] = -std::cos(math::kPi * k / (count - 1));
            weight[k] = (k % 2 == 0 ? 1.0 : -1.0) * (k == 0 || k == count - 1 ? 0.5 : 1.0);
        }
        for (int k = 0; k < count; ++k) {
            double sum = 0;
            for (int l = 0; l < count; ++l) {
                if (l == k) continue;
                derivative(k, l) = weight[l] / weight[k] / (x[k] - x[l]);
                sum += derivative(k, l);
            }
            derivative(k, k) = -sum;
        }
    }
    // The shares of the points in the polynomial through them at a place, by the barycentric formula.
    VectorXd shares(double at) const {
        constexpr double kSame = 1e-10;
        VectorXd share = VectorXd::Zero(x.size());
        for (Eigen::Index k = 0; k < x.size(); ++k) {
            if (std::abs(at - x[k]) < kSame) {
                share.setZero();
                share[k] = 1;
                return share;
            }
            share[k] = weight[k] / (at - x[k]);
        }
        return share / share.sum();
    }

    VectorXd x, weight;
    MatrixXd derivative;
};

// y' = lambda y + gain F . e, q = Im y.
struct Oscillator {
    Complex lambda;
    double gain;
    VectorXd along;  // the direction in the basis of the tip's displacements
};

// A stretch between two events, with contact or without.
struct Stretch {
    double from_s, to_s;
    bool cuts;
    int points = 0;  // with both ends; without contact none
    int first = 0;   // column of the displacement at its second point
    int state = 0;   // column of the oscillators at its begin
};

// An orthonormal basis of the directions of the modes, 3 x d.
inline MatrixXd basis_of(std::span<const Mode> modes) {
    constexpr double kApart = 1e-9;
    MatrixXd basis(3, 0);
    for (const Mode& mode : modes) {
        Eigen::Vector3d d(mode.direction.x, mode.direction.y, mode.direction.z);
        d.normalize();
        d -= basis * (basis.transpose() * d).eval();
        if (d.norm() < kApart) continue;
        d.normalize();
        basis.conservativeResize(3, basis.cols() + 1);
        basis.col(basis.cols() - 1) = d;
    }
    return basis;
}

class Period {
  public:
    Period(std::span<const Mode> modes, const CutFeedback& cut, int least_points)
        : cut_(cut), basis_(basis_of(modes)) {
        double fastest = 0;
        for (const Mode& mode : modes) {
            const double w = math::kTwoPi * mode.frequency_hz, z = mode.damping_ratio;
            const double damped = std::sqrt(1 - z * z);
            const Eigen::Vector3d d(mode.direction.x, mode.direction.y, mode.direction.z);
            oscillators_.push_back({{-z * w, w * damped},
                                    w / (mode.stiffness_n_per_mm * damped),
                                    basis_.transpose() * d.normalized()});
            fastest = std::max(fastest, w);
        }
        const std::vector<double>& events = cut.events_s();
        for (std::size_t n = 0; n + 1 < events.size(); ++n) {
            Stretch s{events[n], events[n + 1], cut.cuts(0.5 * (events[n] + events[n + 1]))};
            const double turn = fastest * (s.to_s - s.from_s);
            if (s.cuts) s.points = least_points + static_cast<int>(std::ceil(turn));
            s.state = size_;
            s.first = s.state + states();
            size_ = s.first + std::max(0, s.points - 1) * dimensions();
            stretches_.push_back(s);
        }
        last_state_ = size_;
        size_ += states();
    }

    // The step from one period to the next, of those unknowns of a period that the next one depends on: now *
    // y = before * y of the period before.
    MatrixXd step() {
        now_ = MatrixXd::Identity(size_, size_);
        before_ = MatrixXd::Zero(size_, size_);
        before_.block(0, last_state_, states(), states()) = MatrixXd::Identity(states(), states());
        for (std::size_t n = 0; n < stretches_.size(); ++n)
            add(stretches_[n], n + 1 < stretches_.size() ? stretches_[n + 1].state : last_state_);
        std::vector<int> kept;
        for (int n = 0; n < size_; ++n)
            if (!before_.col(n).isZero(0)) kept.push_back(n);
        const MatrixXd next = now_.partialPivLu().solve(before_(Eigen::all, kept));
        return next(kept, Eigen::all);
    }

  private:
    int dimensions() const { return static_cast<int>(basis_.cols()); }
    int modes() const { return static_cast<int>(oscillators_.size()); }
    int states() const { return 2 * modes(); }

    MatrixXd stiffness(int tooth, double t) const {
        const Matrix3 s = cut_.stiffness(tooth, t);
        Eigen::Matrix3d m;
        for (int row = 0; row < 3; ++row) {
            const Vec3& v = s[static_cast<std::size_t>(row)];
            m.row(row) << v.x, v.y, v.z;
        }
        return basis_.transpose() * m * basis_;
    }

    // A border belongs to the stretch before it, as the points do.
    const Stretch& stretch_at(double t) const {
        const auto at = std::lower_bound(stretches_.begin(), stretches_.end(), t - near_s(),
                                         [](const Stretch& s, double time) { return s.to_s < time; });
        return at == stretches_.end() ? stretches_.back() : *at;
    }
    double near_s() const { return 1e-9 * cut_.period_s(); }

    // Adds `factor` times the displacement at a time of this period (t >= 0) to `now`, or of the one before
    // it to `before`.
    template <class Rows>
    void add_displacement(double t, const MatrixXd& factor, Rows&& now, Rows&& before) const {
        const int d = dimensions();
        const bool old = t < near_s();
        const Stretch& s = stretch_at(old ? t + cut_.period_s() : t);
        if (!s.cuts) return;
        const Points points(s.points);
        const double since = (old ? t + cut_.period_s() : t) - s.from_s;
        const VectorXd share = points.shares(2 * since / (s.to_s - s.from_s) - 1);
        Rows& to = old ? before : now;
        for (int i = 0; i < modes(); ++i)
            to.col(s.state + 2 * i + 1) +=
                share[0] * factor * oscillators_[static_cast<std::size_t>(i)].along;
        for (int k = 1; k < s.points; ++k) to.middleCols(s.first + (k - 1) * d, d) += share[k] * factor;
    }

    void add(const Stretch& s, int next_state) {
        const int d = dimensions();
        const double lasts = s.to_s - s.from_s;
        for (int i = 0; i < modes(); ++i) {
            const Complex whole = std::exp(oscillators_[static_cast<std::size_t>(i)].lambda * lasts);
            now_.block(next_state + 2 * i, s.state + 2 * i, 2, 2) << -whole.real(), whole.imag(),
                -whole.imag(), -whole.real();
        }
        if (!s.cuts) return;
        const Points points(s.points);
        const int count = s.points - 1;
        // The force at the points, of the unknowns now and before.
        MatrixXd force_now = MatrixXd::Zero(count * d, size_),
                 force_before = MatrixXd::Zero(count * d, size_);
        for (int l = 0; l < count; ++l) {
            const double share = 0.5 * (points.x[l + 1] + 1), t = s.from_s + lasts * share;
            // At its end the cut of the stretch is that of its inside.
            const double inside = s.from_s + lasts * std::min(share, 1 - 1e-9);
            for (int tooth = 0; tooth < cut_.teeth(); ++tooth) {
                const MatrixXd factor = stiffness(tooth, inside);
                if (factor.isZero(0)) continue;
                force_now.block(l * d, s.first + l * d, d, d) += factor;
                add_displacement(t - cut_.delay_s(tooth), -factor, force_now.middleRows(l * d, d),
                                 force_before.middleRows(l * d, d));
            }
        }
        // The answers of the oscillators at the points to the force at the points.
        MatrixXd answer = MatrixXd::Zero(count * d, count * d), end = MatrixXd::Zero(states(), count * d);
        for (int i = 0; i < modes(); ++i) {
            const Oscillator& o = oscillators_[static_cast<std::size_t>(i)];
            Eigen::MatrixXcd system =
                (2 / lasts * points.derivative.bottomRightCorner(count, count)).cast<Complex>();
            system.diagonal().array() -= o.lambda;
            const Eigen::MatrixXcd y = o.gain * system.partialPivLu().inverse();
            const MatrixXd spread = o.along * o.along.transpose();
            for (int l = 0; l < count; ++l) {
                for (int k = 0; k < count; ++k) answer.block(k * d, l * d, d, d) += y(k, l).imag() * spread;
                end.block(2 * i, l * d, 1, d) = y(count - 1, l).real() * o.along.transpose();
                end.block(2 * i + 1, l * d, 1, d) = y(count - 1, l).imag() * o.along.transpose();
            }
            for (int k = 0; k < count; ++k) {
                const Complex free = std::exp(o.lambda * (0.5 * lasts * (points.x[k + 1] + 1)));
                now_.block(s.first + k * d, s.state + 2 * i, d, 1) -= free.imag() * o.along;
                now_.block(s.first + k * d, s.state + 2 * i + 1, d, 1) -= free.real() * o.along;
            }
        }
        now_.middleRows(s.first, count * d) -= answer * force_now;
        before_.middleRows(s.first, count * d) += answer * force_before;
        now_.middleRows(next_state, states()) -= end * force_now;
        before_.middleRows(next_state, states()) += end * force_before;
    }

    const CutFeedback& cut_;
    MatrixXd basis_, now_, before_;
    std::vector<Oscillator> oscillators_;
    std::vector<Stretch> stretches_;
    int size_ = 0, last_state_ = 0;
};

}  // namespace tribo::dynamics::test::chebyshev

namespace tribo::dynamics::test {

// A stretch has `least_points` and one more for each radian of the fastest mode.
inline double multiplier_by_chebyshev(std::span<const Mode> modes, const CutFeedback& cut,
                                      int least_points = 50) {
    return chebyshev::Period(modes, cut, least_points).step().eigenvalues().cwiseAbs().maxCoeff();
}

}  // namespace tribo::dynamics::test
