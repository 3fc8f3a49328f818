// SPDX-License-Identifier: MIT
// The one description of the live frames: of each its kind, and its fields in the order of their bytes. A
// wire is a writer, a reader, or whatever else goes through the fields by their names (tests compare them
// with the page's decoder). The unit stands in the name.
#pragma once

#include <type_traits>

#include "protocol/live_frame.hpp"

namespace tribo::protocol {

// A frame as a wire takes it: a wire that reads fills it.
template <class Wire, class Frame>
using FrameOf = std::conditional_t<Wire::kReads, Frame&, const Frame&>;

// One bit of a word of flags, from the lowest on.
template <class Bool>
struct Flag {
    const char* name;
    Bool& value;
};
template <class Bool>
Flag(const char*, Bool&) -> Flag<Bool>;

template <class Frame>
inline constexpr LiveFrame kKindOf{};

template <>
inline constexpr LiveFrame kKindOf<LiveJob> = LiveFrame::job;
template <class Wire>
void fields(Wire& wire, FrameOf<Wire, LiveHolderStep> step) {
    wire.f32("radius_mm", step.radius_mm);
    wire.f32("length_mm", step.length_mm);
}
template <class Wire>
void fields(Wire& wire, FrameOf<Wire, LiveCutter> cutter) {
    wire.i32("number", cutter.number);
    wire.u32("flutes", cutter.flutes);
    wire.f32("radius_mm", cutter.radius_mm);
    wire.f32("corner_radius_mm", cutter.corner_radius_mm);
    wire.f32("length_mm", cutter.length_mm);
    wire.list("holder", cutter.holder);
}
template <class Wire>
void fields(Wire& wire, FrameOf<Wire, LiveOutlinePoint> point) {
    wire.f32("radius_mm", point.radius_mm);
    wire.f32("height_mm", point.height_mm);
}
template <class Wire>
void fields(Wire& wire, FrameOf<Wire, LiveOutline> outline) {
    wire.list("points", outline.points);
}
template <class Wire>
void fields(Wire& wire, FrameOf<Wire, LiveJob> job) {
    wire.f64("duration_s", job.duration_s);
    wire.f32("cell_mm", job.cell_mm);
    wire.vec3("blank_min_mm", job.blank_mm.min);
    wire.vec3("blank_max_mm", job.blank_mm.max);
    wire.list("cutters", job.cutters);
    wire.added();
    wire.f32("rubbing_chip_mm", job.rubbing_chip_mm);
    wire.f32("overload_chip_share", job.overload_chip_share);
    wire.list("outlines", job.outlines);
}

template <>
inline constexpr LiveFrame kKindOf<LiveChunk> = LiveFrame::chunk;
template <>
inline constexpr LiveFrame kKindOf<LiveChunkPlace> = LiveFrame::chunk;
template <class Wire>
void fields(Wire& wire, FrameOf<Wire, LiveChunkPlace> place) {
    wire.i32("i", place.i);
    wire.i32("j", place.j);
    wire.i32("k", place.k);
}
template <class Wire>
void fields(Wire& wire, FrameOf<Wire, LiveChunk> chunk) {
    wire.time("t_s", chunk.t_s);
    fields(wire, chunk.at);
    wire.mesh(chunk.mesh, chunk.step_mm);
    wire.added();
    wire.numbers("deviations_mm", chunk.deviations_mm);
    wire.u32("on_blank", chunk.on_blank);
    wire.flags(Flag{"rough", chunk.rough});
}

template <>
inline constexpr LiveFrame kKindOf<LiveDesigned> = LiveFrame::designed;
template <class Wire>
void fields(Wire& wire, FrameOf<Wire, LiveDesigned> designed) {
    wire.mesh(designed.mesh);
}

template <class Wire>
void fields(Wire& wire, FrameOf<Wire, LiveChatter> chatter) {
    wire.f32("multiplier", chatter.multiplier);
    wire.f32("chatter_hz", chatter.chatter_hz);
}
template <class Wire>
void fields(Wire& wire, FrameOf<Wire, LiveChatterNow> now) {
    fields(wire, now.of);
    wire.f32("axial_depth_mm", now.axial_depth_mm);
}

template <>
inline constexpr LiveFrame kKindOf<LiveState> = LiveFrame::state;
template <class Wire>
void fields(Wire& wire, FrameOf<Wire, LiveState> state) {
    wire.time("t_s", state.t_s);
    wire.vec3("tip_mm", state.tip_mm);
    wire.vec3("axis", state.axis);
    wire.vec3("force_n", state.force_n);
    wire.f32("peak_force_n", state.peak_force_n);
    wire.f32("mean_torque_nm", state.mean_torque_nm);
    wire.f32("spindle_rpm", state.spindle_rpm);
    wire.f32("feed_mm_per_min", state.feed_mm_per_min);
    wire.f32("spindle_angle_rad", state.spindle_angle_rad);
    wire.f32("removed_mm3", state.removed_mm3);
    wire.f32("milled_s", state.milled_s);
    wire.f32("speed", state.speed);
    wire.u32("line", state.line);
    wire.u32("cutter", state.cutter);
    wire.flags(Flag{"cutting", state.cutting}, Flag{"playing", state.playing}, Flag{"rapid", state.rapid});
    wire.added();
    wire.last_item("chatter", state.chatter);
}

template <>
inline constexpr LiveFrame kKindOf<LiveRows> = LiveFrame::rows;
template <class Wire>
void fields(Wire& wire, FrameOf<Wire, LiveRow> row) {
    wire.span_s(row.t_s, row.end_s);
    wire.vec3("tip_mm", row.tip_mm);
    wire.f32("mean_force_n", row.mean_force_n);
    wire.f32("peak_force_n", row.peak_force_n);
    wire.f32("mean_torque_nm", row.mean_torque_nm);
    wire.f32("entry_rad", row.entry_rad);
    wire.f32("exit_rad", row.exit_rad);
    wire.f32("axial_depth_mm", row.axial_depth_mm);
    wire.f32("feed_per_tooth_mm", row.feed_per_tooth_mm);
    wire.u32("line", row.line);
}
template <class Wire>
void fields(Wire& wire, FrameOf<Wire, LiveRows> rows) {
    wire.header_flag("anew", rows.anew);
    wire.time_of_first(rows.rows);
    wire.list("rows", rows.rows);
    wire.added();
    wire.each("of_rows", rows.rows, [](Wire& of, FrameOf<Wire, LiveRow> row) {
        of.f32("chip_mm", row.chip_mm);
        of.u32("chip_verdict", row.chip_verdict);
    });
    wire.f32("force_low_factor", rows.force_low_factor);
    wire.f32("force_high_factor", rows.force_high_factor);
    wire.each("tools_of_rows", rows.rows, [](Wire& of, FrameOf<Wire, LiveRow> row) {
        of.f32("spindle_rpm", row.spindle_rpm);
        of.vec3("axis", row.axis);
        of.u32("cutter", row.cutter);
    });
    wire.last_each(
        "bands_of_rows", rows.rows, [](const LiveRow& row) { return row.force_high_factor > 0; },
        [](Wire& of, FrameOf<Wire, LiveRow> row) {
            of.f32("force_low_factor", row.force_low_factor);
            of.f32("force_high_factor", row.force_high_factor);
        });
}

template <>
inline constexpr LiveFrame kKindOf<LiveCollision> = LiveFrame::collision;
template <class Wire>
void fields(Wire& wire, FrameOf<Wire, LiveCollision> collision) {
    wire.time("t_s", collision.t_s);
    wire.i32("kind", collision.kind);
    wire.i32("line", collision.line);
    wire.vec3("tip_mm", collision.tip_mm);
}

template <>
inline constexpr LiveFrame kKindOf<LiveSoundPieces> = LiveFrame::sound;
template <class Wire>
void fields(Wire& wire, FrameOf<Wire, LiveHarmonic> harmonic) {
    wire.complex("along_feed_n", harmonic[0]);
    wire.complex("left_of_feed_n", harmonic[1]);
    wire.complex("to_shank_n", harmonic[2]);
}
template <class Wire>
void fields(Wire& wire, FrameOf<Wire, LiveSoundPiece> piece) {
    wire.f64("t_s", piece.t_s);
    wire.f32("duration_s", piece.duration_s);
    wire.point("tip_mm", piece.tip_mm);
    wire.f32("spindle_angle_rad", piece.spindle_angle_rad);
    wire.f32("spindle_rad_per_s", piece.spindle_rad_per_s);
    wire.f32("pace", piece.pace);
    wire.f32("chip_mm3_per_s", piece.chip_mm3_per_s);
    wire.i32("order_step", piece.order_step);
    wire.list("harmonics", piece.harmonics);
}
template <class Wire>
void fields(Wire& wire, FrameOf<Wire, LiveBand> band) {
    wire.f32("z0_mm", band.z0_mm);
    wire.f32("z1_mm", band.z1_mm);
    wire.f32("entry_rad", band.entry_rad);
    wire.f32("exit_rad", band.exit_rad);
}
template <class Wire>
void fields(Wire& wire, FrameOf<Wire, LiveTeeth> teeth) {
    wire.u32("cutter", teeth.cutter);
    wire.point("feed", teeth.feed);
    wire.point("head", teeth.head);
    wire.point("axis", teeth.axis);
    wire.f32("across_mm", teeth.across_mm);
    wire.f32("down_mm", teeth.down_mm);
    wire.f32("turn_x_rad", teeth.turn_x_rad);
    wire.f32("turn_y_rad", teeth.turn_y_rad);
    wire.list("bands", teeth.bands);
}
template <class Wire>
void fields(Wire& wire, FrameOf<Wire, LiveSoundPieces> sound) {
    wire.time_of_first(sound.pieces);
    wire.list("pieces", sound.pieces);
    wire.added();
    wire.each("of_pieces", sound.pieces, [](Wire& of, FrameOf<Wire, LiveSoundPiece> piece) {
        of.i32("edges", piece.edges);
        of.f32("mean_torque_nmm", piece.mean_torque_nmm);
    });
    wire.last_each(
        "teeth", sound.pieces, [](const LiveSoundPiece& piece) { return !piece.teeth.bands.empty(); },
        [](Wire& of, FrameOf<Wire, LiveSoundPiece> piece) { fields(of, piece.teeth); });
}

template <>
inline constexpr LiveFrame kKindOf<LiveTouch> = LiveFrame::finger;
template <class Wire>
void fields(Wire& wire, FrameOf<Wire, LiveTouch> touch) {
    wire.time("t_s", touch.t_s);
    wire.vec3("probe_mm", touch.probe_mm);
    wire.vec3("proxy_mm", touch.proxy_mm);
    wire.vec3("force_n", touch.force_n);
    wire.f32("slip_mm_per_s", touch.slip_mm_per_s);
    wire.flags(Flag{"contact", touch.contact}, Flag{"cutting_force", touch.cutting_force},
               Flag{"cut_mode", touch.cut_mode}, Flag{"stopped", touch.stopped}, Flag{"hand", touch.hand});
}

template <>
inline constexpr LiveFrame kKindOf<LiveServo> = LiveFrame::servo;
template <class Wire>
void fields(Wire& wire, FrameOf<Wire, LiveServo> servo) {
    wire.time("t_s", servo.t_s);
    wire.u32("ticks", servo.ticks);
    wire.u32("late", servo.late);
    wire.u32("fault", servo.fault);
    wire.f32("rate_hz", servo.rate_hz);
    wire.f32("force_limit_n", servo.force_limit_n);
    wire.f32("largest_force_n", servo.largest_force_n);
    wire.quantiles("lateness_us", servo.lateness_us);
    wire.quantiles("cpu_us", servo.cpu_us);
}

template <>
inline constexpr LiveFrame kKindOf<LiveTexture> = LiveFrame::texture;
template <class Wire>
void fields(Wire& wire, FrameOf<Wire, LiveTextureTriangle> triangle) {
    wire.vec3("a_mm", triangle.corners_mm[0]);
    wire.vec3("b_mm", triangle.corners_mm[1]);
    wire.vec3("c_mm", triangle.corners_mm[2]);
    wire.vec3("force_n", triangle.force_n);
}
template <class Wire>
void fields(Wire& wire, FrameOf<Wire, LiveTexture> texture) {
    constexpr std::size_t kTriangleBytes = 48;
    wire.time("t_s", texture.t_s);
    wire.rest("triangles", texture.triangles, kTriangleBytes);
}

template <>
inline constexpr LiveFrame kKindOf<job::Listening> = LiveFrame::listening;
template <class Wire>
void fields(Wire& wire, FrameOf<Wire, job::Listening> listening) {
    wire.vec3("listener_mm", listening.listener_mm);
    wire.f32("distance_factor", listening.distance_factor);
    wire.f32("gain_db", listening.gain_db);
    auto& modes = listening.tool.modes;
    wire.f32("first_mode_hz", modes[0].hz);
    wire.f32("first_mode_damping", modes[0].damping);
    wire.f32("second_mode_hz", modes[1].hz);
    wire.f32("second_mode_damping", modes[1].damping);
    wire.f32("reference_distance_m", listening.reference_distance_m);
    wire.added();
    wire.u32("machine", listening.workshop.machine);
    wire.u32("room", listening.workshop.room);
    wire.u32("chips", listening.workshop.chips);
    wire.f32("cut_db", listening.workshop.cut_db);
    wire.f32("spindle_db", listening.workshop.spindle_db);
    wire.f32("chips_db", listening.workshop.chips_db);
    wire.f32("room_db", listening.workshop.room_db);
}

template <>
inline constexpr LiveFrame kKindOf<LivePath> = LiveFrame::path;
template <class Wire>
void fields(Wire& wire, FrameOf<Wire, LivePathPoint> point) {
    wire.f32("t_s", point.t_s);
    wire.vec3("tip_mm", point.tip_mm);
    wire.flags(Flag{"rapid", point.rapid});
}
template <class Wire>
void fields(Wire& wire, FrameOf<Wire, LivePath> path) {
    wire.list("points", path.points);
    wire.added();
    wire.each("lines_of_points", path.points,
              [](Wire& of, FrameOf<Wire, LivePathPoint> point) { of.u32("line", point.line); });
}

template <>
inline constexpr LiveFrame kKindOf<LiveProgram> = LiveFrame::program;
template <class Wire>
void fields(Wire& wire, FrameOf<Wire, LiveProgram> program) {
    wire.text("name", program.name);
    wire.text("text", program.text);
}

template <>
inline constexpr LiveFrame kKindOf<LiveBending> = LiveFrame::bending;
template <class Wire>
void fields(Wire& wire, FrameOf<Wire, dynamics::Mode> mode) {
    wire.vec3("direction", mode.direction);
    wire.f64("frequency_hz", mode.frequency_hz);
    wire.f64("damping_ratio", mode.damping_ratio);
    wire.f64("stiffness_n_per_mm", mode.stiffness_n_per_mm);
    wire.u32("on", mode.on);
}
template <class Wire>
void fields(Wire& wire, FrameOf<Wire, LiveBendingCutter> of) {
    auto& cutter = of.cutter;
    wire.f64("fastest_rpm", of.fastest_rpm);
    wire.u32("kind", cutter.kind);
    wire.u32("flutes", cutter.flutes);
    wire.f64("diameter_mm", cutter.diameter_mm);
    wire.f64("corner_mm", cutter.corner_mm);
    wire.f64("helix_deg", cutter.helix_deg);
    wire.f64("length_mm", cutter.length_mm);
    wire.f64("runout_mm", cutter.runout_mm);
    wire.f64("runout_deg", cutter.runout_deg);
    wire.numbers("pitch_deg", cutter.pitch_deg);
    wire.list("modes", of.modes);
}
template <class Wire>
void fields(Wire& wire, FrameOf<Wire, LiveBending> bending) {
    auto& k = bending.coefficients;
    wire.f64("ktc_n_per_mm2", k.ktc);
    wire.f64("krc_n_per_mm2", k.krc);
    wire.f64("kac_n_per_mm2", k.kac);
    wire.f64("kte_n_per_mm", k.kte);
    wire.f64("kre_n_per_mm", k.kre);
    wire.f64("kae_n_per_mm", k.kae);
    wire.list("cutters", bending.cutters);
}

template <>
inline constexpr LiveFrame kKindOf<LiveMultipliers> = LiveFrame::multipliers;
template <class Wire>
void fields(Wire& wire, FrameOf<Wire, LiveMultipliers> multipliers) {
    wire.u32("first", multipliers.first);
    wire.list("rows", multipliers.rows);
}

template <>
inline constexpr LiveFrame kKindOf<LiveChart> = LiveFrame::chart;
template <class Wire>
void fields(Wire& wire, FrameOf<Wire, LivePocket> pocket) {
    wire.f32("spindle_rpm", pocket.spindle_rpm);
    wire.f32("depth_mm", pocket.depth_mm);
}
template <class Wire>
void fields(Wire& wire, FrameOf<Wire, LiveChart> chart) {
    wire.f32("from_rpm", chart.from_rpm);
    wire.f32("step_rpm", chart.step_rpm);
    wire.f32("step_mm", chart.step_mm);
    wire.u32("depths", chart.depths);
    wire.numbers("limits_mm", chart.limits_mm);
    wire.numbers("multipliers", chart.multipliers);
    wire.list("pockets", chart.pockets);
}

}  // namespace tribo::protocol
