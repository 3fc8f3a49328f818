// SPDX-License-Identifier: MIT
#include "dynamics/modal_model.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/math.hpp"

namespace tribo::dynamics {
namespace {

using Complex = std::complex<double>;

constexpr double kMostDamping = 0.5;
constexpr std::size_t kPerMode = 3;    // logarithms of frequency, damping and compliance
constexpr std::size_t kResiduals = 2;  // the last unknowns

// Solves a symmetric positive matrix, row by row, in place. False where it is not positive.
bool solve(std::vector<double>& a, std::vector<double>& x) {
    const std::size_t count = x.size();
    for (std::size_t c = 0; c < count; ++c) {
        for (std::size_t r = c; r < count; ++r) {
            double sum = a[r * count + c];
            for (std::size_t k = 0; k < c; ++k) sum -= a[r * count + k] * a[c * count + k];
            if (r == c) {
                if (!(sum > 0)) return false;
                a[c * count + c] = std::sqrt(sum);
            } else {
                a[r * count + c] = sum / a[c * count + c];
            }
        }
    }
    for (std::size_t r = 0; r < count; ++r) {
        for (std::size_t k = 0; k < r; ++k) x[r] -= a[r * count + k] * x[k];
        x[r] /= a[r * count + r];
    }
    for (std::size_t r = count; r-- > 0;) {
        for (std::size_t k = r + 1; k < count; ++k) x[r] -= a[k * count + r] * x[k];
        x[r] /= a[r * count + r];
    }
    return true;
}

Complex times(Complex a, Complex b) {
    return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

}  // namespace

Complex unit_answer(double ratio, double damping) {
    const double re = 1 - ratio * ratio, im = 2 * damping * ratio;
    const double size = 1 / (re * re + im * im);
    return {re * size, -im * size};
}

void Response::prepare(int measured_derivatives, std::size_t most_points) {
    derivatives = measured_derivatives;
    points = hz.size();
    first_hz = hz.front();
    last_hz = hz.back();
    if (const std::size_t group = (points + most_points - 1) / most_points; group > 1) {
        std::size_t count = 0;
        for (std::size_t from = 0; from < points; from += group, ++count) {
            const std::size_t to = std::min(points, from + group);
            double sum_hz = 0;
            Complex sum{};
            for (std::size_t n = from; n < to; ++n) {
                sum_hz += hz[n];
                sum += h[n];
            }
            hz[count] = sum_hz / static_cast<double>(to - from);
            h[count] = sum / static_cast<double>(to - from);
        }
        hz.resize(count);
        h.resize(count);
    }
    step_hz = (last_hz - first_hz) / static_cast<double>(hz.size() - 1);
    weight.clear();
    for (const double f : hz) weight.push_back(measured(f));
    double largest = 0;
    for (std::size_t n = 0; n < hz.size(); ++n)
        largest = std::max(largest, weight[n] * math::hypot(h[n].real(), h[n].imag()));
    scale = 1 / largest;
    power = 0;
    for (std::size_t n = 0; n < hz.size(); ++n) {
        h[n] *= scale;
        power += weight[n] * weight[n] * std::norm(h[n]);
    }
}

double Response::measured(double f) const {
    double ratio = 1;
    for (int n = 0; n < derivatives; ++n) ratio *= f / last_hz;
    return ratio;
}

double Response::least_damping(double f) const {
    return std::min(kMostDamping, 0.25 * step_hz / f);
}

ModalModel::ModalModel(const Response& response) : response_(&response) {
    sum_of_squares_ = squares_of_errors();
}

void ModalModel::add(const Mode& mode) {
    modes_.push_back(mode);
    sum_of_squares_ = squares_of_errors();
}

void ModalModel::remove(std::size_t mode) {
    modes_.erase(modes_.begin() + static_cast<std::ptrdiff_t>(mode));
    sum_of_squares_ = squares_of_errors();
}

void ModalModel::split(std::size_t mode) {
    Mode other = modes_[mode];
    other.compliance /= 2;
    other.damping *= 0.7;
    Mode& one = modes_[mode] = other;
    one.hz *= 1 - one.damping;
    other.hz *= 1 + other.damping;
    add(other);
}

std::vector<Complex> ModalModel::errors() const {
    std::vector<Complex> left = response_->h;
    for (std::size_t n = 0; n < left.size(); ++n) {
        const double f = response_->hz[n];
        left[n] -= constant_ + line_ / (f * f);
        for (const Mode& mode : modes_) left[n] -= mode.compliance * unit_answer(f / mode.hz, mode.damping);
    }
    return left;
}

double ModalModel::squares_of_errors() const {
    const std::vector<Complex> left = errors();
    double sum = 0;
    for (std::size_t n = 0; n < left.size(); ++n)
        sum += response_->weight[n] * response_->weight[n] * std::norm(left[n]);
    return sum;
}

void ModalModel::normal_equations(std::vector<double>& matrix, std::vector<double>& right) const {
    const std::size_t count = kPerMode * modes_.size() + kResiduals;
    matrix.assign(count * count, 0);
    right.assign(count, 0);
    std::vector<double> re(count), im(count);  // derivatives of the model at a point
    const double first = response_->hz.front();
    for (std::size_t n = 0; n < response_->hz.size(); ++n) {
        const double f = response_->hz[n], w = response_->weight[n];
        Complex left = response_->h[n] - (constant_ + line_ / (f * f));
        std::size_t at = 0;
        const auto put = [&](Complex d) {
            re[at] = w * d.real();
            im[at] = w * d.imag();
            ++at;
        };
        for (const Mode& mode : modes_) {
            const double r = f / mode.hz, zr = 2 * mode.damping * r;
            const Complex g = unit_answer(r, mode.damping), ag = mode.compliance * g, agg = times(ag, g);
            left -= ag;
            put(times(agg, {-2 * r * r, zr}));
            put(times(agg, {0, -zr}));
            put(ag);
        }
        put(1);
        put(first * first / (f * f));
        left *= w;
        for (std::size_t row = 0; row < count; ++row) {
            right[row] += re[row] * left.real() + im[row] * left.imag();
            for (std::size_t c = 0; c <= row; ++c)
                matrix[row * count + c] += re[row] * re[c] + im[row] * im[c];
        }
    }
}

void ModalModel::step(std::span<const double> by) {
    std::size_t at = 0;
    for (Mode& mode : modes_) {
        // Longer ones leave the place where the derivatives hold.
        mode.hz *= math::exp(std::clamp(by[at++], -0.1, 0.1));
        mode.damping *= math::exp(std::clamp(by[at++], -1.0, 1.0));
        mode.compliance *= math::exp(std::clamp(by[at++], -2.0, 2.0));
        const double first = response_->first_hz, last = response_->last_hz;
        mode.hz = std::clamp(mode.hz, 0.7 * first, 1.4 * last);
        mode.damping = std::clamp(mode.damping, response_->least_damping(mode.hz), kMostDamping);
        mode.compliance = std::clamp(mode.compliance, 1e-12, 1e12);
    }
    constant_ += by[at++];
    line_ += by[at++] * response_->hz.front() * response_->hz.front();
}

void ModalModel::refine(int most_steps) {
    constexpr double kGain = 1e-9;  // of the sum of squares, less of which ends the refinement
    double damp = 1e-3;
    std::vector<double> matrix, right, damped, by;
    int idle = 0;
    for (int n = 0; n < most_steps && idle < 2; ++n) {
        normal_equations(matrix, right);
        const std::size_t count = right.size();
        for (;;) {
            damped = matrix;
            by = right;
            for (std::size_t k = 0; k < count; ++k) damped[k * count + k] *= 1 + damp;
            ModalModel trial = *this;
            bool better = false;
            if (solve(damped, by)) {
                trial.step(by);
                trial.sum_of_squares_ = trial.squares_of_errors();
                better = trial.sum_of_squares_ < sum_of_squares_;
            }
            if (better) {
                idle = trial.sum_of_squares_ > (1 - kGain) * sum_of_squares_ ? idle + 1 : 0;
                *this = std::move(trial);
                damp = std::max(1e-9, damp / 10);
                break;
            }
            damp *= 10;
            if (damp > 1e8) return;
        }
    }
}

}  // namespace tribo::dynamics
