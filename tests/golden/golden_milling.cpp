// SPDX-License-Identifier: MIT
#include "base/hash.hpp"
#include "base/math.hpp"
#include "golden/golden.hpp"
#include "milling/force/force.hpp"
#include "milling/tool/materials.hpp"

namespace tribo::golden {

// Forces, spectrum and peaks of three cutters, one with run-out and unequal pitch.
std::uint64_t force() {
    Hash hash;
    milling::Cutter flat, ball, uneven;
    ball.kind = milling::CutterKind::ball;
    uneven.kind = milling::CutterKind::bull;
    uneven.corner_mm = 1;
    uneven.flutes = 4;
    uneven.pitch_deg = {85, 92, 88, 95};
    uneven.runout_mm = 0.01;
    uneven.runout_deg = 30;
    const auto material = milling::find_material("al7075-t6");
    if (!material) return 0;
    for (const milling::Cutter& cutter : {flat, ball, uneven}) {
        milling::ForceModel model(cutter, material->coefficients);
        milling::Engagement engagement;
        engagement.bands = {{0, 1.5, 0.2, 2.9}, {1.5, 4, 0, 1.1}, {1.5, 4, 2, 2.6}};
        engagement.bottom = {{0.5, 3, 1, 4}};
        model.engage(engagement, {0.08, 0.02, 0.004, -0.002});
        const auto add = [&hash](const contact::ToolForce& f) {
            hash.add(f.force_n);
            hash.add(f.torque_nmm);
        };
        for (int i = 0; i < 360; ++i) add(model.at(i * math::kRadPerDeg));
        add(model.mean());
        contact::ForceSpectrum spectrum;
        model.spectrum(40, spectrum);
        for (const contact::ForceHarmonic& h : spectrum.harmonics)
            for (const auto& channel : {h.x, h.y, h.z, h.torque}) {
                hash.add(channel.real());
                hash.add(channel.imag());
            }
        add(contact::evaluate(spectrum, 1));
        const milling::ForcePeaks peaks = model.peaks();
        hash.add(peaks.peak_n);
        hash.add(peaks.peak_force_n);
        hash.add(peaks.peak_torque_nmm);
    }
    return hash.value();
}

}  // namespace tribo::golden
