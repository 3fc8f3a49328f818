// SPDX-License-Identifier: MIT
// The paper's look-up table ("Haptic and aural rendering of a virtual milling process", 4.1): force samples
// over the rotation of the tool, entry and exit angle, helix and feed per tooth, straight in between.
// The closed form (milling/force/force.hpp) is exact and needs no table; this one is here to be compared.
#pragma once

#include <array>
#include <vector>

#include "base/parallel.hpp"
#include "contact/force_spectrum.hpp"
#include "milling/tool/coefficients.hpp"
#include "milling/tool/cutter.hpp"

namespace tribo::bench {

struct ForceGridOptions {
    double axial_depth_mm = 2;  // > 0: of the one band, from the tip up
    // Samples along each axis, >= 2.
    int rotations = 48, entries = 19, exits = 19, helices = 5, feeds = 4;
    double helix_from_deg = 10, helix_to_deg = 50;
    double feed_from_mm = 0.02, feed_to_mm = 0.2;  // per tooth
};

// Immutable once built; any thread.
class ForceGrid {
  public:
    // A flat end mill of uniform pitch without run-out.
    ForceGrid(milling::Cutter cutter, const milling::CuttingCoefficients& coefficients,
              const ForceGridOptions& options, const ParallelFor& parallel = serial_for);

    // Clamped to the grid; entry <= exit within 0 ... pi. Real-time safe.
    Vec3 force_n(double rotation_rad, double entry_rad, double exit_rad, double helix_deg,
                 double feed_per_tooth_mm) const noexcept;
    std::size_t bytes() const { return values_.size() * sizeof(float); }

  private:
    struct Place {
        std::size_t low = 0;
        double share = 0;
    };
    static Place place(double value, double from, double to, int count);

    ForceGridOptions options_;
    double period_rad_;  // of the force over rotation
    std::array<std::size_t, 5> stride_{};
    std::vector<float> values_;  // x, y, z; rotation runs fastest, feed slowest
};

}  // namespace tribo::bench
