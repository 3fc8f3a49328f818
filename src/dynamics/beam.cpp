// SPDX-License-Identifier: MIT
#include "dynamics/beam.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "base/math.hpp"

namespace tribo::dynamics {
namespace {

constexpr double kElements = 200;  // of a part
// An element and a joint reach from their first unknown three further: displacement and turn of two nodes.
constexpr std::size_t kBand = 3;

using Element = std::array<std::array<double, 4>, 4>;

// A symmetric matrix with its entries up to kBand beside the diagonal.
class BandMatrix {
  public:
    explicit BandMatrix(std::size_t size) : rows_(size) {}

    std::size_t size() const { return rows_.size(); }
    // The entry of row and row - back.
    double& at(std::size_t row, std::size_t back) { return rows_[row][back]; }

    void add(std::size_t first, const Element& element) {
        for (std::size_t row = 0; row < 4; ++row)
            for (std::size_t column = 0; column <= row; ++column)
                at(first + row, row - column) += element[row][column];
    }
    std::vector<double> times(const std::vector<double>& x) const {
        std::vector<double> y(size());
        for (std::size_t row = 0; row < size(); ++row) {
            y[row] += rows_[row][0] * x[row];
            for (std::size_t back = 1; back <= std::min(kBand, row); ++back) {
                y[row] += rows_[row][back] * x[row - back];
                y[row - back] += rows_[row][back] * x[row];
            }
        }
        return y;
    }
    // Becomes the lower factor of Cholesky; the matrix must be positive definite.
    void factor() {
        for (std::size_t row = 0; row < size(); ++row) {
            for (std::size_t back = std::min(kBand, row); back-- > 0;) {
                const std::size_t column = row - back - 1;
                double sum = at(row, back + 1);
                for (std::size_t k = back + 2; k <= std::min(kBand, row); ++k)
                    sum -= at(row, k) * at(column, k - back - 1);
                at(row, back + 1) = sum / at(column, 0);
            }
            double sum = at(row, 0);
            for (std::size_t k = 1; k <= std::min(kBand, row); ++k) sum -= at(row, k) * at(row, k);
            assert(sum > 0);
            at(row, 0) = std::sqrt(sum);
        }
    }
    // After factor().
    std::vector<double> solve(std::vector<double> x) const {
        for (std::size_t row = 0; row < size(); ++row) {
            for (std::size_t back = 1; back <= std::min(kBand, row); ++back)
                x[row] -= rows_[row][back] * x[row - back];
            x[row] /= rows_[row][0];
        }
        for (std::size_t row = size(); row-- > 0;) {
            x[row] /= rows_[row][0];
            for (std::size_t back = 1; back <= std::min(kBand, row); ++back)
                x[row - back] -= rows_[row][back] * x[row];
        }
        return x;
    }

  private:
    std::vector<std::array<double, kBand + 1>> rows_;
};

// Of displacement and turn at both ends of a piece of a section.
struct BeamElement {
    Element stiffness, mass;

    BeamElement(const BeamSection& section, double l) {
        const BeamMaterial& m = section.material;
        const double d2 = section.diameter_mm * section.diameter_mm;
        const double area = math::kPi / 4 * d2, inertia = math::kPi / 64 * d2 * d2;
        const double shear = 6 * (1 + m.poisson) / (7 + 6 * m.poisson);
        const double ei = m.young_n_per_mm2 * inertia;
        const double f = 12 * ei * 2 * (1 + m.poisson) / (shear * m.young_n_per_mm2 * area * l * l);
        const auto symmetric = [](double scale, std::array<double, 10> lower) {
            Element e;
            std::size_t n = 0;
            for (std::size_t row = 0; row < 4; ++row)
                for (std::size_t column = 0; column <= row; ++column)
                    e[row][column] = e[column][row] = scale * lower[n++];
            return e;
        };
        stiffness = symmetric(ei / ((1 + f) * l * l * l),
                              {12,                      //
                               6 * l, (4 + f) * l * l,  //
                               -12, -6 * l, 12,         //
                               6 * l, (2 - f) * l * l, -6 * l, (4 + f) * l * l});
        const double a = 13.0 / 35 + 7 * f / 10 + f * f / 3, b = 9.0 / 70 + 3 * f / 10 + f * f / 6;
        const double c = (11.0 / 210 + 11 * f / 120 + f * f / 24) * l;
        const double e = (13.0 / 420 + 3 * f / 40 + f * f / 24) * l;
        const double g = (1.0 / 105 + f / 60 + f * f / 120) * l * l;
        const double h = (1.0 / 140 + f / 60 + f * f / 120) * l * l;
        mass = symmetric(m.density_t_per_mm3 * area * l / ((1 + f) * (1 + f)),
                         {a, c, g, b, e, a, -e, -h, -c, g});
        // The mass against turning.
        const double p = 6.0 / 5, q = (1.0 / 10 - f / 2) * l;
        const double r = (2.0 / 15 + f / 6 + f * f / 3) * l * l, s = (-1.0 / 30 - f / 6 + f * f / 6) * l * l;
        const Element turning = symmetric(m.density_t_per_mm3 * inertia / ((1 + f) * (1 + f) * l),
                                          {p, q, r, -p, -q, p, q, s, -q, r});
        for (std::size_t row = 0; row < 4; ++row)
            for (std::size_t column = 0; column < 4; ++column) mass[row][column] += turning[row][column];
    }
};

struct Assembled {
    BandMatrix stiffness, mass;
};

std::size_t pieces(const BeamPart& part, const BeamSection& section) {
    double whole = 0;
    for (const BeamSection& s : part.sections) whole += s.length_mm;
    return static_cast<std::size_t>(std::ceil(kElements * section.length_mm / whole));
}

Assembled assemble(std::span<const BeamPart> parts) {
    std::size_t nodes = 0;
    for (const BeamPart& part : parts) {
        ++nodes;
        for (const BeamSection& section : part.sections) nodes += pieces(part, section);
    }
    Assembled all{BandMatrix(2 * nodes), BandMatrix(2 * nodes)};
    std::size_t first = 0;  // unknown of the node
    for (const BeamPart& part : parts) {
        for (const BeamSection& section : part.sections) {
            const std::size_t count = pieces(part, section);
            const BeamElement element(section, section.length_mm / static_cast<double>(count));
            for (std::size_t n = 0; n < count; ++n, first += 2) {
                all.stiffness.add(first, element.stiffness);
                all.mass.add(first, element.mass);
            }
        }
        const double across = part.joint.across_n_per_mm, turn = part.joint.turn_nmm_per_rad;
        if (&part == &parts.back()) {
            all.stiffness.at(first, 0) += across;
            all.stiffness.at(first + 1, 0) += turn;
        } else {
            all.stiffness.add(first, {{{across, 0, -across, 0},
                                       {0, turn, 0, -turn},
                                       {-across, 0, across, 0},
                                       {0, -turn, 0, turn}}});
        }
        first += 2;
    }
    return all;
}

double product(const std::vector<double>& x, const std::vector<double>& y) {
    double sum = 0;
    for (std::size_t n = 0; n < x.size(); ++n) sum += x[n] * y[n];
    return sum;
}

void add_times(std::vector<double>& x, double factor, const std::vector<double>& y) {
    for (std::size_t n = 0; n < x.size(); ++n) x[n] += factor * y[n];
}

}  // namespace

std::vector<BendingMode> bending_modes(std::span<const BeamPart> parts, std::size_t count) {
    constexpr int kMostSteps = 1000;
    constexpr double kSettled = 1e-12;  // of the squared frequency, in a step
    Assembled beam = assemble(parts);
    beam.stiffness.factor();
    const std::size_t size = beam.mass.size();
    std::vector<BendingMode> modes;
    std::vector<std::vector<double>> shapes, inertias;  // of unit modal mass; the mass times that
    while (modes.size() < std::min(count, size)) {
        std::vector<double> shape(size), inertia;
        shape[0] = 1;  // a load at the tip: every mode that the tip feels answers
        inertia = shape;
        double square = 0;
        for (int step = 0; step < kMostSteps; ++step) {
            shape = beam.stiffness.solve(inertia);
            for (std::size_t n = 0; n < shapes.size(); ++n)
                add_times(shape, -product(inertias[n], shape), shapes[n]);
            inertia = beam.mass.times(shape);
            const double scale = 1 / std::sqrt(product(shape, inertia));
            for (std::size_t n = 0; n < size; ++n) {
                shape[n] *= scale;
                inertia[n] *= scale;
            }
            const double before = square;
            // The last shape had unit mass: of what solve() made of it, only the scale is left.
            square = scale;
            if (step > 1 && std::abs(square - before) <= kSettled * square) break;
        }
        modes.push_back({std::sqrt(square) / math::kTwoPi, square / (shape[0] * shape[0])});
        shapes.push_back(std::move(shape));
        inertias.push_back(std::move(inertia));
    }
    return modes;
}

}  // namespace tribo::dynamics
