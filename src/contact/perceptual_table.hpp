// SPDX-License-Identifier: MIT
// One mechanism for everything that is sampled ahead of time: a function of one variable (force along a path,
// rolloff over distance, Doppler factor over time), straight between knots that stand as far apart as
// perception allows. Pieces end where the function jumps.
//
// Values are kept as float32: its 24 bits are two thousand times finer than the finest JND.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace tribo::contact {

// A function, sampled densely enough that it is straight in between. A piece is the samples first ... first
// of the next - 1, at least one; `at` rises within a piece and does not fall from piece to piece.
struct DenseFunction {
    std::size_t channels = 1;
    std::vector<double> at;
    std::vector<double> values;               // channels per sample
    std::vector<std::size_t> piece_starts{};  // rising, the first is 0; empty: one piece

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

// How far what is shown lies from the truth, in just-noticeable differences of the user.
using ErrorInJnd = std::function<double(std::span<const double> truth, std::span<const double> shown)>;

// A share of a JND that nobody tells from none.
inline constexpr double kInaudibleJnd = 0.5;

// Immutable; copies share the knots, which may lie in a mapped file. Any number of threads.
class PerceptualTable {
  public:
    struct Piece {
        double from = 0, to = 0;
        std::uint64_t first = 0;  // knot; the piece ends before the next one's first
    };
    // What a table is made of, in the order of a file. All spans live in `owner`. One more piece than there
    // are stands at the end, with the number of all knots as its first.
    struct Parts {
        std::size_t channels = 1;
        std::span<const Piece> pieces;
        std::span<const double> at;
        std::span<const float> values;
        std::shared_ptr<const void> owner;
    };

    PerceptualTable() = default;
    // Parts as parts_are_sound() accepts them.
    explicit PerceptualTable(Parts parts) : parts_(std::move(parts)) {}

    // Where the last look-up was: the next one starts there. One per reader.
    struct Cursor {
        std::size_t piece = 0, knot = 0;
    };
    // The first out.size() channels at `at`; false, and `out` untouched, between pieces and outside.
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

// Whether the numbers describe a table: counts agree, everything is finite and rises.
bool parts_are_sound(const PerceptualTable::Parts& parts);

// Knots at samples of the function, each as far from the last as the error between them, as stored, stays
// within `most_jnd` at every sample passed over and at eight places between each two.
PerceptualTable build_perceptual_table(const DenseFunction& function, const ErrorInJnd& error,
                                       double most_jnd = kInaudibleJnd);

// The worst error at `per_interval` places within every interval of samples, and at the samples.
double worst_error_jnd(const PerceptualTable& table, const DenseFunction& function, const ErrorInJnd& error,
                       int per_interval = 8);

// How many knots a table with one spacing throughout takes for an error within `most_jnd`: the widest spacing
// that reaches it, found by bisection. Jumps are given to it: it too is split into the pieces.
std::size_t uniform_knots(const DenseFunction& function, const ErrorInJnd& error,
                          double most_jnd = kInaudibleJnd);

}  // namespace tribo::contact
