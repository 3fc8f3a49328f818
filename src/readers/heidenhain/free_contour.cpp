// SPDX-License-Identifier: MIT
// A chain of elements from a known start has few unknowns: the direction where it is not tangent, the radius
// where it is not given, and the length or angle. Each statement of a block is one equation. The shortest run
// of elements with enough equations is solved by damped Newton steps (Levenberg 1944, Marquardt 1963) from
// many places, so that all contours that fit are found.
#include "readers/heidenhain/free_contour.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/math.hpp"

namespace tribo::readers::heidenhain {
namespace {

using Of = FreeCondition::Of;

constexpr std::size_t kMostUnknowns = 10;
constexpr std::size_t kMostBranches = 64;
constexpr std::size_t kMostOpenSenses = 2;  // arcs without DR that are worked out together
constexpr int kMostSteps = 80;
// Statements of a drawing have three or four decimals: what they contradict each other by, mm.
constexpr double kFitMm = 5e-3;
constexpr double kSameMm = 1e-3, kSameRad = 1e-4;
constexpr double kShortestMm = 1e-6;
constexpr double kIsolated = 1e-9;  // least pivot of the scaled normal matrix
constexpr double kAngleMm = 10;     // what an equation of angles counts, mm per radian

double cross_z(Vec3 a, Vec3 b) {
    return a.x * b.y - a.y * b.x;
}

Vec3 towards(double angle) {
    return {math::cos(angle), math::sin(angle), 0};
}

double length_of(const FreePiece& piece) {
    return piece.turning == 0 ? piece.size : piece.radius * piece.size;
}

bool states_end(const FreeElement& element) {
    return std::any_of(element.conditions.begin(), element.conditions.end(), [](const FreeCondition& c) {
        const bool is_point = c.of == Of::x || c.of == Of::y || c.of == Of::polar || c.of == Of::ray;
        return (is_point && !c.of_centre) || c.of == Of::chord;
    });
}

bool states_centre(const FreeElement& element) {
    return std::any_of(element.conditions.begin(), element.conditions.end(),
                       [](const FreeCondition& c) { return c.of_centre; });
}

// The i-th number of the Halton sequence of a prime base, in (0, 1): places that fill a box evenly.
double halton(std::size_t i, std::size_t base) {
    double value = 0, share = 1;
    for (++i; i > 0; i /= base) {
        share /= static_cast<double>(base);
        value += share * static_cast<double>(i % base);
    }
    return value;
}

// Ends of a piece from its start, direction, radius and size.
void close(FreePiece& piece) {
    if (piece.turning == 0) {
        piece.end = piece.start + piece.size * towards(piece.direction);
        return;
    }
    const Vec3 along = towards(piece.direction);
    const double side = piece.turning * piece.radius;
    piece.centre = piece.start + side * Vec3{-along.y, along.x, 0};
    const Vec3 out = towards(piece.exit_direction());
    piece.end = piece.centre - side * Vec3{-out.y, out.x, 0};
}

bool same(const std::vector<FreePiece>& a, const std::vector<FreePiece>& b) {
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (distance(a[i].end, b[i].end) > kSameMm || distance(a[i].centre, b[i].centre) > kSameMm ||
            std::abs(a[i].size - b[i].size) > (a[i].turning == 0 ? kSameMm : kSameRad) ||
            std::abs(math::sin((a[i].direction - b[i].direction) / 2)) > kSameRad ||
            a[i].turning != b[i].turning)
            return false;
    }
    return true;
}

using Row = std::array<double, kMostUnknowns>;

// Solves a symmetric positive definite system in place by Cholesky's way. Returns the smallest pivot.
double solve(std::array<Row, kMostUnknowns>& a, Row& b, std::size_t n) {
    double least = 1e300;
    for (std::size_t j = 0; j < n; ++j) {
        for (std::size_t i = j; i < n; ++i) {
            double sum = a[i][j];
            for (std::size_t k = 0; k < j; ++k) sum -= a[i][k] * a[j][k];
            if (i > j) {
                a[i][j] = sum / a[j][j];
                continue;
            }
            least = std::min(least, sum);
            if (!(sum > 0)) return sum;
            a[j][j] = std::sqrt(sum);
        }
    }
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < i; ++k) b[i] -= a[i][k] * b[k];
        b[i] /= a[i][i];
    }
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t k = i + 1; k < n; ++k) b[i] -= a[k][i] * b[k];
        b[i] /= a[i][i];
    }
    return least;
}

}  // namespace

class FreeContour::Group {
  public:
    Group(const FreeContour& contour, const Branch& branch, std::size_t first);

    std::size_t unknowns() const { return unknowns_.size(); }
    std::size_t equations() const { return equations_; }
    // Appends the branches that fit. Returns false if some of them are not determined.
    bool find(std::vector<Branch>& found);
    bool has_end() const { return has_end_; }

  private:
    enum class Kind { direction, radius, size };
    struct Unknown {
        Kind kind;
        std::size_t element;
        bool is_arc;
    };

    double start_value(const Unknown& unknown, double share) const;
    const FreePiece& at(std::size_t i) const {
        return i >= first_ ? pieces_[i - first_] : contour_.piece(branch_, i);
    }
    void run(const std::vector<double>& x);
    double equation(const FreeCondition& condition, const FreePiece& piece) const;
    bool lies_right(const FreeCondition& condition, const FreePiece& piece) const;
    void residuals(const std::vector<double>& x, std::vector<double>& out);
    // The derivatives of `base`, the residuals at x.
    void derivatives(std::vector<double> x, const std::vector<double>& base);
    bool descend(std::vector<double>& x);
    bool is_isolated(const std::vector<double>& x);
    bool is_valid();

    const FreeContour& contour_;
    const Branch& branch_;
    std::size_t first_, last_;
    bool is_carried_, has_end_;
    std::vector<Unknown> unknowns_;
    std::size_t equations_ = 0;
    std::vector<int> turning_;  // of the arcs
    std::vector<FreePiece> pieces_;
    std::vector<std::vector<double>> columns_;  // of derivatives
    double scale_ = 1;
};

FreeContour::Group::Group(const FreeContour& contour, const Branch& branch, std::size_t first)
    : contour_(contour),
      branch_(branch),
      first_(first),
      last_(contour.elements_.size() - 1),
      is_carried_(first < contour.known_) {
    pieces_.resize(last_ - first_ + 1);
    const Vec3 start = first == 0    ? contour.start_
                       : is_carried_ ? contour.piece(branch, first).start
                                     : contour.piece(branch, first - 1).end;
    has_end_ = true;
    for (std::size_t i = first; i <= last_; ++i) {
        const FreeElement& element = contour.elements_[i];
        turning_.push_back(element.turning);
        const bool is_known = is_carried_ && i == first;
        if (is_known) turning_.back() = contour.piece(branch, i).turning;
        if (!is_known && !element.is_tangent && !element.direction)
            unknowns_.push_back({Kind::direction, i, element.is_arc});
        if (!is_known && element.is_arc && !element.radius)
            unknowns_.push_back({Kind::radius, i, element.is_arc});
        if (!element.size && (i < last_ || states_end(element)))
            unknowns_.push_back({Kind::size, i, element.is_arc});
        else if (!element.size)
            has_end_ = false;
        if (!is_known) equations_ += element.conditions.size();
        for (const FreeCondition& condition : element.conditions) {
            const bool is_length = condition.of != Of::ray && condition.of != Of::direction;
            if (is_length)
                scale_ = std::max(scale_, std::abs(condition.value - (condition.of == Of::x   ? start.x
                                                                      : condition.of == Of::y ? start.y
                                                                                              : 0)));
            scale_ =
                std::max(scale_, condition.of == Of::passes_point ? distance(condition.point, start) : 0);
        }
        scale_ = std::max(scale_, element.radius.value_or(0));
        if (!element.is_arc) scale_ = std::max(scale_, element.size.value_or(0));
    }
    pieces_[0].start = start;
}

// Where an unknown begins: directions and angles anywhere, lengths from a hundredth to three times the size
// of the drawing.
double FreeContour::Group::start_value(const Unknown& unknown, double share) const {
    if (unknown.kind == Kind::direction) return math::kTwoPi * share;
    if (unknown.kind == Kind::size && unknown.is_arc) return math::kTwoPi * share;
    return scale_ * 0.01 * math::exp(share * math::log(300.0));
}

// The chain of pieces for values of the unknowns.
void FreeContour::Group::run(const std::vector<double>& x) {
    std::size_t next = 0;
    const auto value = [&](Kind kind, std::size_t i, double known) {
        const bool is_unknown =
            next < unknowns_.size() && unknowns_[next].kind == kind && unknowns_[next].element == i;
        return is_unknown ? x[next++] : known;
    };
    for (std::size_t i = first_; i <= last_; ++i) {
        const FreeElement& element = contour_.elements_[i];
        FreePiece& piece = pieces_[i - first_];
        double direction = element.direction.value_or(0), radius = element.radius.value_or(0);
        if (is_carried_ && i == first_) {
            direction = contour_.piece(branch_, i).direction;
            radius = contour_.piece(branch_, i).radius;
        } else {
            if (i > first_) piece.start = pieces_[i - first_ - 1].end;
            if (element.is_tangent)
                direction = i == 0 ? contour_.direction_.value_or(0) : at(i - 1).exit_direction();
        }
        piece.turning = element.is_arc ? turning_[i - first_] : 0;
        piece.direction = value(Kind::direction, i, direction);
        piece.radius = value(Kind::radius, i, radius);
        piece.size = value(Kind::size, i, element.size.value_or(0));
        close(piece);
    }
}

double FreeContour::Group::equation(const FreeCondition& condition, const FreePiece& piece) const {
    const Vec3 point = condition.of_centre ? piece.centre : piece.end;
    const FreePiece* reference = condition.reference ? &at(*condition.reference) : nullptr;
    const Vec3 origin = !reference ? Vec3{} : condition.from_start ? reference->start : reference->end;
    switch (condition.of) {
        case Of::x:
            return point.x - origin.x - condition.value;
        case Of::y:
            return point.y - origin.y - condition.value;
        case Of::polar: {
            const double from = reference ? distance(origin, condition.point) : 0;
            return distance(point, condition.point) - from - condition.value;
        }
        case Of::ray: {
            const Vec3 arm = origin - condition.point;
            const double from = reference ? math::atan2(arm.y, arm.x) : 0;
            return cross_z(towards(from + condition.value), point - condition.point);
        }
        case Of::direction:
            return kAngleMm * math::sin(piece.direction - condition.value -
                                        (reference ? reference->exit_direction() : 0));
        case Of::parallel:
            return kAngleMm * math::sin(piece.direction - reference->direction);
        case Of::from_line:
            return std::abs(cross_z(towards(reference->direction), piece.start - reference->start)) -
                   condition.value;
        case Of::chord:
            return distance(piece.start, piece.end) - condition.value;
        case Of::passes_point:
            break;
    }
    const double away = piece.turning == 0 ? cross_z(towards(piece.direction), condition.point - piece.start)
                                           : distance(condition.point, piece.centre) - piece.radius;
    return condition.value == 0 ? away : std::abs(away) - condition.value;
}

// Equations of rays and directions hold on the other side too.
bool FreeContour::Group::lies_right(const FreeCondition& condition, const FreePiece& piece) const {
    const FreePiece* reference = condition.reference ? &at(*condition.reference) : nullptr;
    if (condition.of == Of::direction) {
        return math::cos(piece.direction - condition.value - (reference ? reference->exit_direction() : 0)) >
               0;
    }
    if (condition.of != Of::ray) return true;
    const Vec3 arm = (reference ? reference->end : Vec3{}) - condition.point;
    const double from = reference ? math::atan2(arm.y, arm.x) : 0;
    const Vec3 point = condition.of_centre ? piece.centre : piece.end;
    return dot(towards(from + condition.value), point - condition.point) > -kFitMm;
}

void FreeContour::Group::residuals(const std::vector<double>& x, std::vector<double>& out) {
    run(x);
    out.clear();
    for (std::size_t i = first_ + (is_carried_ ? 1 : 0); i <= last_; ++i) {
        for (const FreeCondition& condition : contour_.elements_[i].conditions)
            out.push_back(equation(condition, pieces_[i - first_]));
    }
}

void FreeContour::Group::derivatives(std::vector<double> x, const std::vector<double>& base) {
    columns_.resize(x.size());
    for (std::size_t j = 0; j < x.size(); ++j) {
        const double step = 1e-7 * std::max(1.0, std::abs(x[j])), before = x[j];
        x[j] += step;
        residuals(x, columns_[j]);
        x[j] = before;
        for (std::size_t i = 0; i < base.size(); ++i) columns_[j][i] = (columns_[j][i] - base[i]) / step;
    }
}

// Walks from x to a place where the equations hold. Returns false if there is none.
bool FreeContour::Group::descend(std::vector<double>& x) {
    const auto squared = [](const std::vector<double>& r) {
        double sum = 0;
        for (const double value : r) sum += value * value;
        return sum;
    };
    std::vector<double> r, tried = x, r_tried;
    residuals(x, r);
    double error = squared(r), damping = 1e-3;
    const std::size_t n = x.size();
    for (int k = 0; k < kMostSteps && error > 1e-24; ++k) {
        derivatives(x, r);
        bool better = false;
        for (int retry = 0; retry < 8 && !better; ++retry) {
            std::array<Row, kMostUnknowns> normal{};
            Row step{};
            for (std::size_t i = 0; i < n; ++i) {
                for (std::size_t j = 0; j <= i; ++j) {
                    for (std::size_t e = 0; e < r.size(); ++e)
                        normal[i][j] += columns_[i][e] * columns_[j][e];
                }
                for (std::size_t e = 0; e < r.size(); ++e) step[i] -= columns_[i][e] * r[e];
                normal[i][i] += damping * normal[i][i] + 1e-12;
            }
            if (!(solve(normal, step, n) > 0)) return false;
            for (std::size_t i = 0; i < n; ++i) tried[i] = x[i] + step[i];
            residuals(tried, r_tried);
            const double now = squared(r_tried);
            better = now < error;
            if (better && now > 0.999999 * error && damping < 1e-6) k = kMostSteps;
            if (better) {
                x = tried;
                r = r_tried;
                error = now;
            }
            damping = better ? damping * 0.1 : damping * 10;
        }
        if (!better) break;
    }
    return std::sqrt(error) < kFitMm;
}

bool FreeContour::Group::is_isolated(const std::vector<double>& x) {
    std::vector<double> base;
    residuals(x, base);
    derivatives(x, base);
    std::array<Row, kMostUnknowns> normal{};
    Row none{};
    Row norm{};
    for (std::size_t i = 0; i < x.size(); ++i) {
        for (const double value : columns_[i]) norm[i] += value * value;
        if (!(norm[i] > 0)) return false;
    }
    for (std::size_t i = 0; i < x.size(); ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
            for (std::size_t e = 0; e < base.size(); ++e) normal[i][j] += columns_[i][e] * columns_[j][e];
            normal[i][j] /= std::sqrt(norm[i] * norm[j]);
        }
    }
    return solve(normal, none, x.size()) > kIsolated;
}

// The pieces as a contour: lengths and radii above 0, arcs of up to a turn, on the right side of rays.
bool FreeContour::Group::is_valid() {
    for (std::size_t i = first_; i <= last_; ++i) {
        FreePiece& piece = pieces_[i - first_];
        const bool is_ended = i < last_ || has_end_;
        if (piece.turning == 0) {
            if (is_ended && !(piece.size > kShortestMm)) return false;
        } else {
            if (!(piece.radius > kShortestMm)) return false;
            if (is_ended) {
                piece.size -= math::kTwoPi * std::floor(piece.size / math::kTwoPi);
                if (piece.size < kShortestMm) piece.size = math::kTwoPi;
            }
        }
        if (is_carried_ && i == first_) continue;
        for (const FreeCondition& condition : contour_.elements_[i].conditions) {
            if (!lies_right(condition, piece)) return false;
        }
    }
    return true;
}

bool FreeContour::Group::find(std::vector<Branch>& found) {
    constexpr std::array<std::size_t, kMostUnknowns> primes = {2, 3, 5, 7, 11, 13, 17, 19, 23, 29};
    std::vector<std::size_t> open;  // arcs whose sense is not stated
    for (std::size_t i = 0; i < turning_.size(); ++i) {
        if (contour_.elements_[first_ + i].is_arc && turning_[i] == 0) open.push_back(i);
    }
    if (open.size() > kMostOpenSenses) return false;
    const std::size_t senses = std::size_t{1} << open.size();
    const std::size_t n = unknowns_.size();
    const std::size_t starts = n == 0 ? 1 : std::size_t{48} << std::min<std::size_t>(n, 3);
    std::vector<std::vector<FreePiece>> fitting;
    std::vector<double> x(n);
    for (std::size_t k = 0; k < starts * senses; ++k) {
        for (std::size_t i = 0; i < open.size(); ++i) turning_[open[i]] = (k % senses >> i & 1) != 0 ? 1 : -1;
        for (std::size_t j = 0; j < n; ++j) x[j] = start_value(unknowns_[j], halton(k / senses, primes[j]));
        if (!descend(x)) continue;
        run(x);
        if (!is_valid()) continue;
        const auto fits = pieces_;
        if (std::any_of(fitting.begin(), fitting.end(), [&](const auto& other) { return same(other, fits); }))
            continue;
        if (n > 0 && !is_isolated(x)) return false;
        fitting.push_back(fits);
        if (fitting.size() > kMostBranches) return false;
    }
    for (const auto& pieces : fitting) {
        Branch branch = branch_;
        branch.resize(first_ - contour_.settled_.size());
        branch.insert(branch.end(), pieces.begin(), pieces.end());
        found.push_back(std::move(branch));
    }
    return true;
}

FreeContour::State FreeContour::add(FreeElement element) {
    if (element.is_tangent && element.direction) {
        FreeCondition stated;
        stated.of = Of::direction;
        stated.value = *element.direction;
        element.conditions.push_back(stated);
        element.direction.reset();
    }
    elements_.push_back(std::move(element));
    const std::size_t first = last_has_end_ ? known_ : known_ - 1;
    std::vector<Branch> found;
    bool has_end = true;
    for (const Branch& branch : branches_) {
        Group group(*this, branch, first);
        if (group.equations() < group.unknowns() || group.unknowns() > kMostUnknowns) return State::open;
        if (!group.find(found) || found.size() > kMostBranches) return State::open;
        has_end = group.has_end();
    }
    if (found.empty()) return State::contradictory;
    branches_ = std::move(found);
    known_ = elements_.size();
    last_has_end_ = has_end;
    settle();
    return State::known;
}

// One branch: all but its last piece are settled.
void FreeContour::settle() {
    if (branches_.size() != 1) return;
    Branch& only = branches_.front();
    settled_.insert(settled_.end(), only.begin(), only.end() - 1);
    only.erase(only.begin(), only.end() - 1);
}

void FreeContour::choose(std::size_t number) {
    const auto length = [](const Branch& branch) {
        double sum = 0;
        for (const FreePiece& piece : branch) sum += length_of(piece);
        return sum;
    };
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < branches_.size(); ++i) order.emplace_back(length(branches_[i]), i);
    std::sort(order.begin(), order.end());
    branches_ = {branches_[order[number].second]};
    settle();
}

bool FreeContour::is_complete() {
    if (elements_.empty()) return true;
    if (known_ < elements_.size()) return false;
    if (last_has_end_) return true;
    if (!elements_.back().is_arc || !states_centre(elements_.back())) return false;
    for (Branch& branch : branches_) {
        branch.back().size = math::kTwoPi;
        close(branch.back());
    }
    return last_has_end_ = true;
}

std::vector<FreePiece> FreeContour::pieces() const {
    std::vector<FreePiece> all = settled_;
    all.insert(all.end(), branches_.front().begin(), branches_.front().end());
    return all;
}

}  // namespace tribo::readers::heidenhain
