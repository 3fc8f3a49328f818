// SPDX-License-Identifier: MIT
// Table of a function of one variable (force along a path, rolloff over distance, Doppler factor over time).
// It is linear between knots. The knots are as far apart as just noticeable differences (JND) allow. A piece
// ends where the function jumps.
//
// Values are stored as float32: its 24 bits are two thousand times finer than the finest JND.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace tribo::contact {

// A function with so many samples that it is linear in between. A piece has the samples from its first to the
// one before the next piece. `at` rises within a piece and does not fall from piece to piece.
struct DenseFunction {
    std::size_t channels = 1;
    std::vector<double> at;
    std::vector<double> values;               // channels per sample
    std::vector<std::size_t> piece_starts{};  // index of first samples, rising, from 0; empty: one piece

    std::size_t size() const { return at.size(); }
    std::span<const double> row(std::size_t n) const { return {values.data() + n * channels, channels}; }
    std::size_t pieces() const { return piece_starts.empty() ? 1 : piece_starts.size(); }
    std::size_t piece_begin(std::size_t piece) const {
        return piece_starts.empty() ? 0 : piece_starts[piece];
    }
    std::size_t piece_end(std::size_t piece) const {
        return piece + 1 < pieces() ? piece_starts[piece + 1] : size();
    }
};

// Error of the shown value, in just noticeable differences of the user.
using ErrorInJnd = std::function<double(std::span<const double> truth, std::span<const double> shown)>;

// An error, in JND, below what anybody can notice.
inline constexpr double kInaudibleJnd = 0.5;

// Immutable; copies share the knots, which may lie in a mapped file. Any number of threads.
class PerceptualTable {
  public:
    struct Piece {
        double from = 0, to = 0;
        std::uint64_t first = 0;  // knot; the piece ends before the next one's first
    };
    // Contents of a table, in file order. `owner` keeps the memory of all spans. The last entry of `pieces`
    // is a sentinel: its `first` is the number of knots.
    struct Parts {
        std::size_t channels = 1;
        std::span<const Piece> pieces;
        std::span<const double> at;
        std::span<const float> values;
        std::shared_ptr<const void> owner;
    };

    PerceptualTable() = default;
    // parts_are_sound() must accept the parts.
    explicit PerceptualTable(Parts parts) : parts_(std::move(parts)) {}

    // Position of the last look-up; the next one starts there. One per reader.
    struct Cursor {
        std::size_t piece = 0, knot = 0;
    };
    // The first out.size() channels at `at`. Between pieces and outside: false, with `out` unchanged.
    // Real-time safe: a few steps from the cursor, else bisection.
    bool look_up(double at, std::span<double> out, Cursor& cursor) const noexcept;
    // The piece that holds `at`, or pieces().size().
    std::size_t piece_at(double at, Cursor& cursor) const noexcept;

    bool empty() const { return parts_.at.empty(); }
    std::size_t channels() const { return parts_.channels; }
    std::size_t knots() const { return parts_.at.size(); }
    std::span<const Piece> pieces() const {
        return parts_.pieces.first(parts_.pieces.empty() ? 0 : parts_.pieces.size() - 1);
    }
    // Bytes of knots and pieces.
    std::size_t bytes() const;
    const Parts& parts() const { return parts_; }

  private:
    Parts parts_;
};

// Returns true if the parts are a valid table: consistent counts, finite values, rising knots.
bool parts_are_sound(const PerceptualTable::Parts& parts);

// Chooses knots among the samples. Each knot is as far from the last one as possible, with an error of the
// stored table within `most_jnd` at all skipped samples and at eight places between each two of them.
PerceptualTable build_perceptual_table(const DenseFunction& function, const ErrorInJnd& error,
                                       double most_jnd = kInaudibleJnd);

// The largest error at the samples and at `per_interval` places between each two samples.
double worst_error_jnd(const PerceptualTable& table, const DenseFunction& function, const ErrorInJnd& error,
                       int per_interval = 8);

// Number of knots of a table with constant spacing and an error within `most_jnd`. Bisection finds the widest
// such spacing. This table has the same pieces.
std::size_t uniform_knots(const DenseFunction& function, const ErrorInJnd& error,
                          double most_jnd = kInaudibleJnd);

}  // namespace tribo::contact
