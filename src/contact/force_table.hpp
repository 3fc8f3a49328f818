// SPDX-License-Identifier: MIT
// The cutting force along a path, pre-computed: the spectrum of every turn at knots placed by what the hand
// can tell apart (the paper's look-up table, section 2 and 4.1, over the path instead of over its
// parameters). A servo looks a spectrum up and sums the harmonics that its rate carries, so nothing aliases.
#pragma once

#include <span>
#include <vector>

#include "contact/force_spectrum.hpp"
#include "contact/jnd_profile.hpp"
#include "contact/perceptual_table.hpp"

namespace tribo::contact {

// One stretch of the cut, in the order of time: its spectrum holds in its middle. Frame: the tool's axes in
// the stock's frame.
struct ForceStretch {
    double start_s = 0, end_s = 0;
    double phase_rad = 0;       // spindle angle at start_s, datum of ForceSpectrum
    double rate_rad_per_s = 0;  // of the spindle
    Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
    ForceSpectrum spectrum;
};

// What holds throughout a piece of the table.
struct ForcePiece {
    double phase_rad = 0;       // where the piece begins
    double rate_rad_per_s = 0;  // of the spindle
    double order_step = 1;      // of the spectrum
};

// Channels of the table: the mean force (3), then per harmonic its real (3) and imaginary (3) parts, stock
// frame.
class ForceTable {
  public:
    static constexpr std::size_t kMostHarmonics = 16;

    ForceTable() = default;
    // `pieces` has one entry per piece of the table and lives in the table's owner or in `owner`.
    ForceTable(PerceptualTable table, std::span<const ForcePiece> pieces,
               std::shared_ptr<const void> owner = {})
        : table_(std::move(table)), pieces_(pieces), owner_(std::move(owner)) {}

    struct Cursor : PerceptualTable::Cursor {};
    // Force on the tool at a time of the program, stock frame: the mean, and the harmonics below 0.35 of
    // `rate_hz` in full, fading to none at 0.45. False where nothing is cut. Real-time safe.
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

// Share of a vibration of `frequency_hz` that a loop at `rate_hz` carries: 1 up to 0.35 of the rate, 0 from
// 0.45 on.
double carried_share(double frequency_hz, double rate_hz);

// The stretches as a function of time: straight between their middles, pieces split where the cut pauses, the
// spindle or its teeth change, or the force jumps by more than kJumpJnd. Harmonics are left out that no servo
// carries (fastest_hz) or that nobody feels.
struct ForceFunction {
    DenseFunction dense;
    std::vector<ForcePiece> pieces;
};
inline constexpr double kJumpJnd = 4;
struct ForceTableOptions {
    JndProfile profile;
    double hand_per_tool = 0.01;  // newtons at the hand per newton at the tool: floors are the hand's
    double fastest_hz = 10'000;   // servo that the table may be played on
    double most_jnd = kInaudibleJnd;
};
ForceFunction force_function(std::span<const ForceStretch> stretches, const ForceTableOptions& options);

// The largest of: size and direction of the mean force, amplitude of each harmonic.
ErrorInJnd force_error(const ForceTableOptions& options);

ForceTable build_force_table(const ForceFunction& function, const ForceTableOptions& options);

}  // namespace tribo::contact
