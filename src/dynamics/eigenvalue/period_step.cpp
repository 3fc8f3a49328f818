// SPDX-License-Identifier: MIT
#include "dynamics/eigenvalue/period_step.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"

namespace tribo::dynamics {
namespace {

// Shares of a period.
constexpr double kSame = 1e-9;

bool has_one_delay(const CutFeedback& cut) {
    for (int tooth = 0; tooth < cut.teeth(); ++tooth)
        if (std::abs(cut.delay_s(tooth) - cut.period_s()) > kSame * cut.period_s()) return false;
    return true;
}

// For a piece in which the fastest mode turns by so much. The error in the states at its end is a number
// times turn^(2 points + 1); these turns keep it below 1e-11 of the states.
const GaussPoints& points_for(double turn_rad, bool one_delay) {
    static const GaussPoints three(3), four(4), five(5), six(6), eight(8), twelve(12);
    if (!one_delay) return twelve;
    return turn_rad < 0.2   ? three
           : turn_rad < 1   ? four
           : turn_rad < 1.5 ? five
           : turn_rad < 2.2 ? six
                            : eight;
}

}  // namespace

PeriodStep::PeriodStep(std::span<const Mode> modes, const CutFeedback& cut)
    : cut_(cut), oscillators_(modes), one_delay_(has_one_delay(cut)) {
    constexpr double kMostTurn = 4;  // rad
    const std::vector<double>& events = cut.events_s();
    for (std::size_t n = 0; n + 1 < events.size(); ++n) {
        const double lasts = events[n + 1] - events[n], middle = 0.5 * (events[n] + events[n + 1]);
        if (!cut.cuts(middle)) {
            pieces_.push_back({events[n], lasts, false, answers_.size()});
            answers_.push_back(oscillators_.without_force(lasts));
            continue;
        }
        // The cut stiffens what vibrates.
        const double turn = oscillators_.fastest(cut.spring(middle)) * lasts;
        const auto count = static_cast<std::size_t>(std::ceil(turn / kMostTurn));
        const double piece = lasts / static_cast<double>(count);
        const GaussPoints& points = points_for(turn / static_cast<double>(count), one_delay_);
        for (std::size_t k = 0; k < count; ++k) {
            pieces_.push_back({events[n] + static_cast<double>(k) * piece, piece, true, answers_.size(),
                               &points, displacements_});
            displacements_ += points.x.size() * oscillators_.dimensions();
        }
        most_points_ = std::max(most_points_, points.x.size());
        answers_.push_back(oscillators_.answer(piece, points));
    }
    for (Piece& piece : pieces_)
        if (piece.cuts) add_matrix(piece);
}

// The matrix, by columns: displacements at the points and states at the end, over the states at the begin and
// the delayed forces at the points; with one delay over the displacements a period ago instead.
void PeriodStep::add_matrix(Piece& piece) {
    const Oscillators::Answer& answer = answers_[piece.answer];
    const GaussPoints& points = *piece.points;
    const std::size_t p = points.x.size(), d = oscillators_.dimensions(), n = p * d;
    const std::size_t s = states(), width = n + s + n;
    std::vector<double> spring(n * d);  // force over the displacement at the same time, p times d x d
    piece.link = links_.size();
    for (std::size_t l = 0; l < p; ++l) {
        const double t = piece.from_s + points.x[l] * piece.lasts_s;
        for (int tooth = 0; tooth < cut_.teeth(); ++tooth) {
            const std::array<double, 9> force = oscillators_.reduced(cut_.stiffness(tooth, t));
            if (force == std::array<double, 9>{}) continue;
            for (std::size_t k = 0; k < d * d; ++k) spring[l * d * d + k] += force[k];
            if (!one_delay_) add_link(l, t - cut_.delay_s(tooth), force);
        }
    }
    piece.links = links_.size() - piece.link;
    springs_.insert(springs_.end(), spring.begin(), spring.end());
    // u = free y + moved (S u - h) with the delayed forces h.
    std::vector<double> system(n * width);
    for (std::size_t r = 0; r < n; ++r) {
        double* row = &system[r * width];
        for (std::size_t at = 0; at < n; at += d)
            for (std::size_t a = at; a < at + d; ++a)
                for (std::size_t b = 0; b < d; ++b)
                    row[at + b] -= answer.moved[r * n + a] * spring[a * d + b];
        row[r] += 1;
        for (std::size_t c = 0; c < s; ++c) row[n + c] = answer.free[r * s + c];
        for (std::size_t c = 0; c < n; ++c) row[n + s + c] = -answer.moved[r * n + c];
    }
    eliminate(n, width, system.data());
    piece.matrix = matrices_.size();
    matrices_.resize(matrices_.size() + (n + s) * (s + n));
    double* matrix = &matrices_[piece.matrix];
    std::vector<double> force(n);  // S u - h
    for (std::size_t c = 0; c < s + n; ++c) {
        double* column = matrix + c * (n + s);
        for (std::size_t r = 0; r < n; ++r) column[r] = system[r * width + n + c];
        for (std::size_t at = 0; at < n; at += d) {
            for (std::size_t a = at; a < at + d; ++a) {
                force[a] = a + s == c ? -1 : 0;
                for (std::size_t b = 0; b < d; ++b) force[a] += spring[a * d + b] * column[at + b];
            }
        }
        for (std::size_t i = 0; i < s; ++i) {
            column[n + i] = i / 2 == c / 2 ? answer.decay[2 * i + c % 2] : 0;
            for (std::size_t r = 0; r < n; ++r) column[n + i] += answer.end[i * n + r] * force[r];
        }
    }
    if (!one_delay_) return;
    std::vector<double> over(d * (n + s));
    for (std::size_t l = 0; l < p; ++l) {
        double* columns = matrix + (s + l * d) * (n + s);
        std::fill(over.begin(), over.end(), 0.0);
        for (std::size_t a = 0; a < d; ++a)
            for (std::size_t b = 0; b < d; ++b)
                for (std::size_t r = 0; r < n + s; ++r)
                    over[b * (n + s) + r] += columns[a * (n + s) + r] * spring[(l * d + a) * d + b];
        std::copy(over.begin(), over.end(), columns);
    }
}

void PeriodStep::add_link(std::size_t point, double t_s, const std::array<double, 9>& stiffness) {
    // The tooth before cut there, or began or ended to.
    const bool last_period = t_s < 0;
    const double t = last_period ? t_s + cut_.period_s() : t_s;
    const Piece* nearest = nullptr;
    double least = cut_.period_s();
    for (const Piece& piece : pieces_) {
        const double apart = std::max(piece.from_s - t, t - piece.from_s - piece.lasts_s);
        if (!piece.cuts || apart >= least) continue;
        nearest = &piece;
        least = apart;
    }
    if (nearest == nullptr || least > kSame * cut_.period_s()) return;
    Link link{point, last_period, nearest->first, std::vector<double>(nearest->points->x.size()), stiffness};
    nearest->points->shares((t - nearest->from_s) / nearest->lasts_s, link.share.data());
    links_.push_back(std::move(link));
}

void PeriodStep::delayed_forces(const Piece& piece, const double* from, const double* to,
                                double* forces) const {
    const std::size_t d = oscillators_.dimensions();
    std::fill_n(forces, piece.points->x.size() * d, 0.0);
    for (std::size_t k = piece.link; k < piece.link + piece.links; ++k) {
        const Link& link = links_[k];
        const double* displacement = (link.last_period ? from : to) + link.first;
        for (std::size_t b = 0; b < d; ++b) {
            double u = 0;
            for (std::size_t l = 0; l < link.share.size(); ++l) u += link.share[l] * displacement[l * d + b];
            for (std::size_t a = 0; a < d; ++a) forces[link.point * d + a] += link.stiffness[a * d + b] * u;
        }
    }
}

std::vector<PeriodStep::Impulse> PeriodStep::impulses(std::span<const std::complex<double>> vibration,
                                                      std::complex<double> multiplier) const {
    const std::size_t d = oscillators_.dimensions();
    // The period before had a multiplier-th of it. Not now / multiplier: it differs between systems.
    const double size2 = multiplier.real() * multiplier.real() + multiplier.imag() * multiplier.imag();
    const std::complex<double> back = std::conj(multiplier) / size2;
    std::array<std::vector<double>, 2> now, before;  // real and imaginary parts
    for (std::size_t n = 0; n < displacements_; ++n) {
        const std::complex<double> u = vibration[n], last = u * back;
        now[0].push_back(u.real());
        now[1].push_back(u.imag());
        before[0].push_back(last.real());
        before[1].push_back(last.imag());
    }
    std::vector<Impulse> found;
    std::array<std::vector<double>, 2> delayed;
    for (std::vector<double>& forces : delayed) forces.resize(most_points_ * d);
    for (const Piece& piece : pieces_) {
        if (!piece.cuts) continue;
        if (!one_delay_) {
            for (const std::size_t part : {0U, 1U})
                delayed_forces(piece, before[part].data(), now[part].data(), delayed[part].data());
        }
        for (std::size_t l = 0; l < piece.points->x.size(); ++l) {
            const std::size_t at = piece.first + l * d;
            const double* spring = &springs_[at * d];
            Impulse impulse{piece.from_s + piece.points->x[l] * piece.lasts_s, {}};
            for (std::size_t a = 0; a < d; ++a) {
                std::array<double, 2> force{};
                for (const std::size_t part : {0U, 1U}) {
                    if (!one_delay_) force[part] = -delayed[part][l * d + a];
                    for (std::size_t b = 0; b < d; ++b) {
                        const double chip = now[part][at + b] - (one_delay_ ? before[part][at + b] : 0);
                        force[part] += spring[a * d + b] * chip;
                    }
                }
                const double lasts_s = piece.points->weight[l] * piece.lasts_s;
                impulse.ns[a] = {lasts_s * force[0], lasts_s * force[1]};
            }
            found.push_back(impulse);
        }
    }
    return found;
}

void PeriodStep::advance(const double* from, double* to) const {
    const std::size_t d = oscillators_.dimensions(), s = states();
    double* state = to + displacements_;
    std::copy_n(from + displacements_, s, state);
    std::vector<double> input(s + most_points_ * d), output(s + most_points_ * d);
    for (const Piece& piece : pieces_) {
        std::copy_n(state, s, input.begin());
        if (!piece.cuts) {
            const std::vector<double>& decay = answers_[piece.answer].decay;
            for (std::size_t i = 0; i < s; ++i)
                state[i] = decay[2 * i] * input[i / 2 * 2] + decay[2 * i + 1] * input[i / 2 * 2 + 1];
            continue;
        }
        const std::size_t n = piece.points->x.size() * d;
        if (one_delay_) {
            std::copy_n(from + piece.first, n, input.begin() + static_cast<std::ptrdiff_t>(s));
        } else {
            delayed_forces(piece, from, to, &input[s]);
        }
        std::fill_n(output.begin(), n + s, 0.0);
        const double* column = &matrices_[piece.matrix];
        for (std::size_t c = 0; c < s + n; ++c, column += n + s)
            for (std::size_t r = 0; r < n + s; ++r) output[r] += column[r] * input[c];
        std::copy_n(output.begin(), n, to + piece.first);
        std::copy_n(output.begin() + static_cast<std::ptrdiff_t>(n), s, state);
    }
}

}  // namespace tribo::dynamics
