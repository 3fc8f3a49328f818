// SPDX-License-Identifier: MIT
#include "contact/perceptual_table.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace tribo::contact {
namespace {

struct Storage {
    std::vector<PerceptualTable::Piece> pieces;
    std::vector<double> at;
    std::vector<float> values;
};

double as_stored(double value) {
    return static_cast<double>(static_cast<float>(value));
}

// Straight line from row a to row b at the share t, with the stored (float) values.
void blend(std::span<const double> a, std::span<const double> b, double t, std::span<double> out) {
    for (std::size_t c = 0; c < out.size(); ++c)
        out[c] = as_stored(a[c]) + t * (as_stored(b[c]) - as_stored(a[c]));
}

// Values of the dense function itself at `at`, between samples n and n + 1.
void truth_at(const DenseFunction& f, std::size_t n, double at, std::span<double> out) {
    if (n + 1 >= f.size()) {
        std::ranges::copy(f.row(n), out.begin());
        return;
    }
    const double width = f.at[n + 1] - f.at[n], t = width > 0 ? (at - f.at[n]) / width : 0;
    const auto a = f.row(n), b = f.row(n + 1);
    for (std::size_t c = 0; c < out.size(); ++c) out[c] = a[c] + t * (b[c] - a[c]);
}

// Number of places in an interval of samples at which the error of a table is checked.
constexpr int kPlaces = 8;

// The error between two samples used as knots.
class Span {
  public:
    Span(const DenseFunction& f, const ErrorInJnd& error, double most)
        : f_(f), error_(error), most_(most), truth_(f.channels), shown_(f.channels) {}

    // Also checks between the samples: a force that passes near zero there changes its direction.
    bool fits(std::size_t from, std::size_t to) {
        const double width = f_.at[to] - f_.at[from];
        for (std::size_t n = from; n < to; ++n) {
            for (int k = 0; k < kPlaces; ++k) {
                const double at = f_.at[n] + (f_.at[n + 1] - f_.at[n]) * k / kPlaces;
                truth_at(f_, n, at, truth_);
                blend(f_.row(from), f_.row(to), (at - f_.at[from]) / width, shown_);
                if (!(error_(truth_, shown_) <= most_)) return false;
            }
        }
        return true;
    }

  private:
    const DenseFunction& f_;
    const ErrorInJnd& error_;
    double most_;
    std::vector<double> truth_, shown_;
};

// Knots of constant spacing over a piece: their number, and a test if they stay within the error.
class UniformPiece {
  public:
    UniformPiece(const DenseFunction& f, const ErrorInJnd& error, std::size_t begin, std::size_t end)
        : f_(f),
          error_(error),
          begin_(begin),
          end_(end),
          a_(f.channels),
          b_(f.channels),
          shown_(f.channels) {}

    static std::size_t intervals(double length, double spacing) {
        return static_cast<std::size_t>(std::max(1.0, std::ceil(length / spacing - 1e-9)));
    }
    double length() const { return f_.at[end_ - 1] - f_.at[begin_]; }

    bool fits(double spacing, double most) {
        if (end_ - begin_ < 2) return true;
        const double from = f_.at[begin_], whole = length();
        const std::size_t count = intervals(whole, spacing);
        const double step = whole / static_cast<double>(count);
        std::size_t n = begin_;
        for (std::size_t k = 0; k < count; ++k) {
            const double low = from + static_cast<double>(k) * step, high = low + step;
            sample(low, a_);
            sample(high, b_);
            while (n < end_ && f_.at[n] < low) ++n;
            for (; n < end_ && f_.at[n] <= high; ++n) {
                blend(a_, b_, (f_.at[n] - low) / step, shown_);
                if (!(error_(f_.row(n), shown_) <= most)) return false;
            }
            if (n > begin_) --n;
        }
        return true;
    }

  private:
    void sample(double at, std::span<double> out) const {
        const auto first = f_.at.begin() + static_cast<std::ptrdiff_t>(begin_);
        const auto last = f_.at.begin() + static_cast<std::ptrdiff_t>(end_);
        const auto after = std::upper_bound(first, last, at);
        const auto n =
            std::clamp<std::ptrdiff_t>(after - f_.at.begin() - 1, static_cast<std::ptrdiff_t>(begin_),
                                       static_cast<std::ptrdiff_t>(end_) - 2);
        truth_at(f_, static_cast<std::size_t>(n), at, out);
    }

    const DenseFunction& f_;
    const ErrorInJnd& error_;
    std::size_t begin_, end_;
    std::vector<double> a_, b_, shown_;
};

}  // namespace

std::size_t PerceptualTable::piece_at(double at, Cursor& cursor) const noexcept {
    const auto all = pieces();
    if (cursor.piece < all.size() && at >= all[cursor.piece].from && at <= all[cursor.piece].to)
        return cursor.piece;
    const auto after = std::ranges::upper_bound(all, at, {}, &Piece::from);
    if (after == all.begin()) return all.size();
    const auto piece = static_cast<std::size_t>(after - all.begin()) - 1;
    return at <= all[piece].to ? piece : all.size();
}

bool PerceptualTable::look_up(double at, std::span<double> out, Cursor& cursor) const noexcept {
    assert(out.size() <= parts_.channels);
    const std::size_t piece = piece_at(at, cursor);
    if (piece >= pieces().size()) return false;
    const std::size_t first = static_cast<std::size_t>(parts_.pieces[piece].first);
    const std::size_t last = static_cast<std::size_t>(parts_.pieces[piece + 1].first) - 1;
    const std::span<const double> knots = parts_.at;
    std::size_t n = piece == cursor.piece ? std::clamp(cursor.knot, first, last) : first;
    constexpr int kSteps = 4;
    for (int step = 0; step < kSteps && n < last && knots[n + 1] <= at; ++step) ++n;
    if (at < knots[n] || (n < last && knots[n + 1] <= at)) {
        const auto range = knots.subspan(first, last - first + 1);
        const auto after = static_cast<std::size_t>(std::ranges::upper_bound(range, at) - range.begin());
        n = first + std::max<std::size_t>(after, 1) - 1;
    }
    cursor = {piece, n};
    const float* a = parts_.values.data() + n * parts_.channels;
    if (n == last) {
        for (std::size_t c = 0; c < out.size(); ++c) out[c] = static_cast<double>(a[c]);
        return true;
    }
    const float* b = a + parts_.channels;
    const double t = (at - knots[n]) / (knots[n + 1] - knots[n]);
    for (std::size_t c = 0; c < out.size(); ++c) {
        const auto low = static_cast<double>(a[c]);
        out[c] = low + t * (static_cast<double>(b[c]) - low);
    }
    return true;
}

std::size_t PerceptualTable::bytes() const {
    return parts_.pieces.size_bytes() + parts_.at.size_bytes() + parts_.values.size_bytes();
}

bool parts_are_sound(const PerceptualTable::Parts& parts) {
    if (parts.channels == 0 || parts.pieces.empty()) return false;
    if (parts.values.size() / parts.channels != parts.at.size() || parts.values.size() % parts.channels != 0)
        return false;
    if (parts.pieces.front().first != 0 || parts.pieces.back().first != parts.at.size()) return false;
    double reached = -HUGE_VAL;
    for (std::size_t n = 0; n + 1 < parts.pieces.size(); ++n) {
        const PerceptualTable::Piece& p = parts.pieces[n];
        const std::uint64_t end = parts.pieces[n + 1].first;
        if (!(p.first < end) || end > parts.at.size()) return false;
        const auto knots =
            parts.at.subspan(static_cast<std::size_t>(p.first), static_cast<std::size_t>(end - p.first));
        if (!std::isfinite(p.from) || !std::isfinite(p.to) || !(p.from >= reached)) return false;
        if (knots.front() != p.from || knots.back() != p.to) return false;
        for (std::size_t k = 1; k < knots.size(); ++k) {
            if (!(knots[k] > knots[k - 1])) return false;
        }
        reached = p.to;
    }
    return std::ranges::all_of(parts.values, [](float v) { return std::isfinite(v); });
}

PerceptualTable build_perceptual_table(const DenseFunction& f, const ErrorInJnd& error, double most_jnd) {
    auto storage = std::make_shared<Storage>();
    const auto add_knot = [&](std::size_t sample) {
        storage->at.push_back(f.at[sample]);
        for (const double v : f.row(sample)) storage->values.push_back(static_cast<float>(v));
    };
    Span span(f, error, most_jnd);
    for (std::size_t piece = 0; f.size() > 0 && piece < f.pieces(); ++piece) {
        const std::size_t begin = f.piece_begin(piece), last = f.piece_end(piece) - 1;
        storage->pieces.push_back({f.at[begin], f.at[last], storage->at.size()});
        add_knot(begin);
        for (std::size_t from = begin; from < last;) {
            // Doubles the span while it fits, then bisects. A span a little longer than one that does not fit
            // hardly ever fits.
            std::size_t good = from + 1, bad = last + 1, reach = 2;
            while (good < last) {
                const std::size_t to = std::min(from + reach, last);
                if (!span.fits(from, to)) {
                    bad = to;
                    break;
                }
                good = to;
                reach *= 2;
            }
            while (good + 1 < bad && good < last) {
                const std::size_t middle = good + (bad - good) / 2;
                (span.fits(from, middle) ? good : bad) = middle;
            }
            add_knot(good);
            from = good;
        }
    }
    storage->pieces.push_back({0, 0, storage->at.size()});
    return PerceptualTable({f.channels, storage->pieces, storage->at, storage->values, storage});
}

double worst_error_jnd(const PerceptualTable& table, const DenseFunction& f, const ErrorInJnd& error,
                       int per_interval) {
    std::vector<double> truth(f.channels), shown(f.channels);
    double worst = 0;
    for (std::size_t piece = 0; f.size() > 0 && piece < f.pieces(); ++piece) {
        const std::size_t begin = f.piece_begin(piece), end = f.piece_end(piece);
        PerceptualTable::Cursor cursor{piece, 0};
        for (std::size_t n = begin; n < end; ++n) {
            const int places = n + 1 < end ? per_interval : 1;
            for (int k = 0; k < places; ++k) {
                const double at = n + 1 < end ? f.at[n] + (f.at[n + 1] - f.at[n]) * k / places : f.at[n];
                cursor.piece = piece;
                if (n + 1 < end) {
                    truth_at(f, n, at, truth);
                } else {
                    std::ranges::copy(f.row(n), truth.begin());
                }
                if (!table.look_up(at, shown, cursor)) return HUGE_VAL;
                worst = std::max(worst, error(truth, shown));
            }
        }
    }
    return worst;
}

std::size_t uniform_knots(const DenseFunction& f, const ErrorInJnd& error, double most_jnd) {
    double low = HUGE_VAL, high = 0;  // spacings: one that surely fits, the longest piece
    std::vector<UniformPiece> pieces;
    for (std::size_t piece = 0; f.size() > 0 && piece < f.pieces(); ++piece) {
        const std::size_t begin = f.piece_begin(piece), end = f.piece_end(piece);
        pieces.emplace_back(f, error, begin, end);
        for (std::size_t n = begin + 1; n < end; ++n) low = std::min(low, f.at[n] - f.at[n - 1]);
        if (end - begin > 1) high = std::max(high, pieces.back().length());
    }
    const auto fits = [&](double spacing) {
        return std::ranges::all_of(pieces, [&](UniformPiece& p) { return p.fits(spacing, most_jnd); });
    };
    if (high > 0 && !fits(high)) {
        // Relative: an error of 0.1 % in the spacing is 0.1 % in the number of knots.
        constexpr double kClose = 1.001;
        while (high > low * kClose) {
            const double middle = std::sqrt(low * high);
            (fits(middle) ? low : high) = middle;
        }
        high = low;
    }
    std::size_t knots = 0;
    for (const UniformPiece& p : pieces)
        knots += p.length() > 0 ? UniformPiece::intervals(p.length(), high) + 1 : 1;
    return knots;
}

}  // namespace tribo::contact
