// SPDX-License-Identifier: MIT
#include <memory>
#include <string_view>
#include <vector>

#include "base/hash.hpp"
#include "base/math.hpp"
#include "contact/contact_sample.hpp"
#include "field/contour/contour_refine.hpp"
#include "golden/golden.hpp"
#include "milling/tool/cutter_shape.hpp"
#include "motion/curve/keyframe_motion.hpp"
#include "readers/gcode/reader.hpp"
#include "session/cut/mill_setup.hpp"
#include "sound/play/workshop.hpp"

namespace tribo::golden {
namespace {

// Mills the program out of a block and hashes everything that comes out: rows, sound, totals, stock, mesh. 0
// when it is refused.
std::uint64_t milled(const job::Job& job, motion::Program program) {
    const Box3 block{{-12, -12, -8}, {12, 12, 0}};
    job::LoadedJob loaded;
    loaded.job = job;
    loaded.program = std::move(program);
    loaded.blank = job::box_solid(block);
    Warnings warnings;
    auto setup = session::prepare_mill(loaded, {0.5, {}}, warnings);
    if (!setup) return 0;
    session::MillSession session(std::move(*setup), serial_for);

    Hash hash;
    sound::SoundtrackOptions sounds;
    sounds.head = sound::Head::sphere(sounds.sample_rate_hz);
    sound::apply({.machine = 1, .room = 1, .chips = sound::ChipMaterial::aluminium}, sounds);
    sound::Soundtrack track(sounds);
    std::vector<float> block_of_sound(1000);
    session::MillSinks sinks;
    sinks.row = [&](const milling::CutRow& row, const milling::RowForce& force) {
        constexpr double kDegPerRad = 180 / math::kPi;
        const milling::EngagementHull hull = milling::hull(row.engagement);
        const milling::ForcePeaks& peaks = force.peaks;
        for (const double value :
             {row.start_s, hull.entry_rad * kDegPerRad, hull.exit_rad * kDegPerRad, hull.axial_depth_mm,
              peaks.peak_xy_n, 1e-3 * peaks.mean_torque_nmm, 1e-3 * peaks.peak_torque_nmm, row.removed_mm3,
              row.chip_mm3_per_s(), row.phase_rad})
            hash.add(value);
        for (const Vec3 value :
             {row.pose.tip_mm, row.pose.frame.z, peaks.mean_n, peaks.peak_n, row.pose.frame.x})
            hash.add(value);
        hash.add(row.line);
        for (const contact::ForceHarmonic& h : force.spectrum.harmonics) {
            hash.add(h.x.real());
            hash.add(h.torque.imag());
        }
        contact::ContactSample sample;
        sample.t_s = row.start_s;
        sample.position_mm = row.pose.tip_mm;
        sample.force_n = peaks.mean_n;
        sample.removed_mm3_per_s = row.chip_mm3_per_s();
        sample.phase_rad = row.phase_rad;
        sample.phase_rate_rad_per_s = row.spindle_rad_per_s();
        sample.spectrum = &force.spectrum;
        track.excite(sample);
        track.render(block_of_sound);
        for (const float value : block_of_sound) hash.add(value);
    };
    if (!session.run(sinks)) return 0;
    const session::MillTotals& t = session.totals();
    for (const double value : {t.duration_s, t.cutting_s, t.path_mm, t.removed_mm3, t.remaining_mm3,
                               t.chip_mm3, t.mean_force_n, t.peak_force_n, t.peak_power_w})
        hash.add(value);
    hash.add(t.rows);
    const TriangleMesh mesh = field::fine_contour(session.stock());
    for (const Point3f& p : mesh.positions) hash.add(p);
    hash.add(mesh.triangles.size());
    return t.rows > 10 ? hash.value() : 0;
}

job::Job job_with(const milling::Cutter& cutter) {
    job::Job job;
    job.cutters = {cutter};
    job.material.name = "al7075-t6";
    job.process = {6000, 900};
    return job;
}

// On straight, circular and helical moves, in and out of the block.
std::uint64_t mill_three_axes_with(const milling::Cutter& cutter) {
    constexpr std::string_view kProgram = R"(G21 G90 G17 S6000 M3
G0 X-16 Y-6 Z2
G1 Z-2 F900
X16
Y-3
X-10
G2 X-2 Y5 I8 J0
G3 X4 Y5 I3 J0 Z-3.5
G1 X8 Y-9 Z-1
G0 Z5
)";
    auto program = readers::read_gcode(kProgram);
    return program ? milled(job_with(cutter), std::move(*program)) : 0;
}

// The axis turns along a curved motion.
std::uint64_t mill_five_axes_with(const milling::Cutter& cutter) {
    const job::Job job = job_with(cutter);
    std::vector<motion::Keyframe> keyframes;
    for (int i = 0; i <= 10; ++i) {
        const double x = 3.0 * i - 15, y = 6 * math::sin(0.4 * i);
        motion::Keyframe keyframe;
        keyframe.pose = {{x, y, -2 - 0.01 * x * x}, normalized({0.02 * x, -0.03 * y, 1})};
        keyframe.weight = 1 + 0.2 * (i % 2);
        keyframe.line = i + 1;
        keyframes.push_back(keyframe);
    }
    auto moves = motion::keyframe_moves(keyframes, job.process.feed_mm_per_min);
    if (!moves) return 0;
    motion::Program program;
    program.moves = std::move(*moves);
    return milled(job, std::move(program));
}

}  // namespace

// A ball cutter.
std::uint64_t mill_three_axes() {
    milling::Cutter cutter;
    cutter.kind = milling::CutterKind::ball;
    cutter.diameter_mm = 6;
    cutter.flutes = 3;
    cutter.length_mm = 20;
    return mill_three_axes_with(cutter);
}

// A bull-nose cutter.
std::uint64_t mill_five_axes() {
    milling::Cutter cutter;
    cutter.kind = milling::CutterKind::bull;
    cutter.corner_mm = 1;
    cutter.diameter_mm = 8;
    cutter.length_mm = 25;
    return mill_five_axes_with(cutter);
}

// A rounded V, a lollipop, and a profile with a hollow arc and a step.
std::uint64_t mill_profiles() {
    milling::Cutter v, lollipop, form;
    v.kind = milling::CutterKind::v;
    v.diameter_mm = 8;
    v.corner_mm = 0.3;
    v.point_deg = 60;
    lollipop.kind = milling::CutterKind::lollipop;
    lollipop.diameter_mm = 6;
    lollipop.neck_mm = 3;
    form.kind = milling::CutterKind::profile;
    form.length_mm = 15;
    form.profile = {{1, 0, 0}, {1, 1, -0.4}, {2, 2, 0}, {3, 2, 0}, {3, 3, 0.3}, {2.5, 5, 0}};
    Hash hash;
    for (milling::Cutter* cutter : {&v, &lollipop, &form}) {
        if (!milling::make_profile(*cutter)) return 0;
    }
    hash.add(mill_three_axes_with(v));
    hash.add(mill_three_axes_with(form));
    hash.add(mill_five_axes_with(v));
    hash.add(mill_five_axes_with(lollipop));
    return hash.value();
}

}  // namespace tribo::golden
