// SPDX-License-Identifier: MIT
// One signal for a force in a plane that changes in time.
#pragma once

#include <array>
#include <complex>

namespace tribo::sound {

// x + H[y], H a delay of a quarter of a cycle at every frequency: as loud as the force is large, for a force
// along any line in the plane, and in the phase of in_plane_partials(). Two chains of all-passes keep the
// quarter to 0.7 degrees from 0.001 to 0.499 of the rate (coefficients: O. Niemitalo, "Hilbert transform",
// 2003). Both delay the signal by the phase of response(). Real-time safe, about 8 ns.
class InPlane {
  public:
    double next(double x, double y);
    void forget();
    // The common factor of both chains at a frequency, of size 1.
    static std::complex<double> response(double hz, double rate_hz);

  private:
    static constexpr std::size_t kSections = 4;
    struct Chain {
        // Inputs and outputs of each section, one and two samples ago.
        std::array<double, kSections> in1{}, in2{}, out1{}, out2{};
        double next(double value, const std::array<double, kSections>& squares);
    };
    Chain x_, y_;
    double y_before_ = 0;
};

}  // namespace tribo::sound
