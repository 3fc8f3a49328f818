// SPDX-License-Identifier: MIT
#include "contact/force_spectrum.hpp"

#include "base/math.hpp"

namespace tribo::contact {

ToolForce evaluate(const ForceSpectrum& spectrum, double theta_rad, int highest_order) {
    ToolForce sum = mean_force(spectrum);
    double turn_re, turn_im, re = 1, im = 0;
    math::sincos(spectrum.order_step * theta_rad, turn_im, turn_re);
    for (std::size_t n = 1; n < spectrum.harmonics.size() && spectrum.order(n) <= highest_order; ++n) {
        const double turned = re * turn_re - im * turn_im;
        im = re * turn_im + im * turn_re;
        re = turned;
        const ForceHarmonic& h = spectrum.harmonics[n];
        sum.force_n.x += 2 * (h.x.real() * re - h.x.imag() * im);
        sum.force_n.y += 2 * (h.y.real() * re - h.y.imag() * im);
        sum.force_n.z += 2 * (h.z.real() * re - h.z.imag() * im);
        sum.torque_nmm += 2 * (h.torque.real() * re - h.torque.imag() * im);
    }
    return sum;
}

}  // namespace tribo::contact
