// SPDX-License-Identifier: MIT
// Precomputed cutting force along a path: force spectra at knots whose spacing follows the just noticeable
// difference of the hand (the look-up table of the paper, sections 2 and 4.1, over the path instead of over
// its parameters). A servo looks up a spectrum and sums only the harmonics below its rate: no aliasing.
#pragma once

#include <span>
#include <vector>

#include "contact/force_spectrum.hpp"
#include "contact/jnd_profile.hpp"
#include "contact/perceptual_table.hpp"

namespace tribo::contact {

// One interval of the cut. The spectrum holds at its middle. x, y, z are the axes of the tool in the frame of
// the stock.
struct ForceStretch {
    double start_s = 0, end_s = 0;
    double phase_rad = 0;       // spindle angle at start_s, datum of ForceSpectrum
    double rate_rad_per_s = 0;  // of the spindle
    Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
    ForceSpectrum spectrum;
};

// Constants of one piece of the table.
struct ForcePiece {
    double phase_rad = 0;       // at the start of the piece
    double rate_rad_per_s = 0;  // of the spindle
    double order_step = 1;      // of the spectrum
};

// Channels of the table: the mean force (3), then per harmonic its real (3) and imaginary (3) parts, stock
// frame.
class ForceTable {
  public:
    static constexpr std::size_t kMostHarmonics = 16;

    ForceTable() = default;
    // `pieces` has one entry per piece of the table. `owner` keeps its memory alive.
    ForceTable(PerceptualTable table, std::span<const ForcePiece> pieces,
               std::shared_ptr<const void> owner = {})
        : table_(std::move(table)), pieces_(pieces), owner_(std::move(owner)) {}

    struct Cursor : PerceptualTable::Cursor {};
    // Force on the tool at a program time, stock frame: the mean plus the harmonics, each times its
    // vibration_gain(). False where nothing is cut. Real-time safe.
    bool force_at(double t_s, double rate_hz, Cursor& cursor, Vec3& force_n) const noexcept;

    const PerceptualTable& table() const { return table_; }
    std::span<const ForcePiece> pieces() const { return pieces_; }
    std::size_t harmonics() const { return table_.channels() < 3 ? 0 : (table_.channels() - 3) / 6; }
    std::size_t bytes() const { return table_.bytes() + pieces_.size_bytes(); }

  private:
    PerceptualTable table_;
    std::span<const ForcePiece> pieces_;
    std::shared_ptr<const void> owner_;
};

// Gain of a vibration in a servo loop at `rate_hz`, against aliasing: 1 up to 0.35 of the rate, fading to 0
// at 0.45 of the rate.
double vibration_gain(double frequency_hz, double rate_hz);

// The force as a function of time, linear between the middles of the stretches. A new piece begins where the
// cut pauses, the spindle speed or the tooth spacing changes, or the force jumps by more than kJumpJnd.
// Harmonics above the fastest servo rate (fastest_hz) and harmonics that cannot be felt are left out.
struct ForceFunction {
    DenseFunction dense;
    std::vector<ForcePiece> pieces;
};
inline constexpr double kJumpJnd = 4;
struct ForceTableOptions {
    JndProfile profile;
    double hand_per_tool = 0.01;  // newtons at the hand per newton at the tool
    double fastest_hz = 10'000;   // fastest servo rate that plays the table
    double most_jnd = kInaudibleJnd;
};
ForceFunction force_function(std::span<const ForceStretch> stretches, const ForceTableOptions& options);

// The largest of three errors: size and direction of the mean force, amplitude of each harmonic.
ErrorInJnd force_error(const ForceTableOptions& options);

ForceTable build_force_table(const ForceFunction& function, const ForceTableOptions& options);

}  // namespace tribo::contact
