// SPDX-License-Identifier: MIT
// Binary frames of the live view (docs/live-protocol.md): what a viewer draws, from a server or from the
// module in its own page, or out of a recording. All little-endian; angles in rad, lengths in mm.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/mesh.hpp"
#include "contact/force_spectrum.hpp"
#include "contact/texture_record.hpp"
#include "job/listening.hpp"
#include "milling/tool/cutter.hpp"
#include "motion/path/program.hpp"

namespace tribo::protocol {

// The number that a viewer must know; changes with the layout of any frame.
inline constexpr std::uint8_t kLiveFrameVersion = 1;

enum class LiveFrame : std::uint8_t {
    job = 1,
    chunk = 2,
    state = 3,
    rows = 4,
    collision = 5,
    sound = 6,
    finger = 7,
    servo = 8,
    texture = 9,
    listening = 10,
    designed = 11,
    path = 12,
};

// Takes one whole frame; the bytes are valid during the call only.
using FrameSink = std::function<void(std::span<const std::uint8_t>)>;

// What the tool does at one moment of the program.
struct LiveState {
    double t_s = 0;
    motion::ToolPose tool;
    Vec3 force_n;  // on the tool, mean over a turn, stock frame
    double peak_force_n = 0, mean_torque_nm = 0;
    double spindle_rpm = 0, feed_mm_per_min = 0, spindle_angle_rad = 0;
    double removed_mm3 = 0;  // since the program began
    double milled_s = 0;     // the part is milled up to here
    double speed = 1;        // seconds of the program per second
    std::uint32_t line = 0, cutter = 0;
    bool cutting = false, playing = false, rapid = false;
};

// One row of the plots and of the coloured path.
struct LiveRow {
    double t_s = 0, end_s = 0;
    Vec3 tip_mm;
    double mean_force_n = 0, peak_force_n = 0, mean_torque_nm = 0;
    double entry_rad = 0, exit_rad = 0, axial_depth_mm = 0;
    double feed_per_tooth_mm = 0;
    std::uint32_t line = 0;
};

// A point of the tool path in time.
struct LivePathPoint {
    double t_s = 0;
    Vec3 tip_mm;
    bool rapid = false;  // of the way that ends here
};

// The hand's finger, and what it feels.
struct LiveTouch {
    double t_s = 0;  // of the program
    Vec3 probe_mm, proxy_mm;
    Vec3 force_n;  // on the hand
    double slip_mm_per_s = 0;
    bool contact = false, cutting_force = true, cut_mode = true, stopped = false, hand = false;
};

// How the servo does. Durations in us: median, 99 %, 99.9 %, most.
struct LiveServo {
    std::uint32_t ticks = 0, late = 0, fault = 0;  // fault as haptics::Fault
    double rate_hz = 0, force_limit_n = 0, largest_force_n = 0;
    std::array<double, 4> lateness_us{}, cpu_us{};
};

// A piece of the cut as the ear needs it: all that makes a contact::ContactSample of a moment in it.
struct LiveSoundPiece {
    double t_s = 0, end_s = 0;  // of the program as it was written
    Vec3 tip_mm;
    double spindle_angle_rad = 0;  // at t_s
    double spindle_rad_per_s = 0;  // as it turns
    double pace = 1;               // seconds of the program as it was written per second
    double chip_mm3_per_s = 0;
    int edges = 0;                    // of the cutter
    contact::ForceSpectrum spectrum;  // of the torque only the mean is told
};

struct LiveJob {
    double duration_s = 0, cell_mm = 0;
    Box3 blank_mm;
    std::span<const milling::Cutter> cutters;
};

// Each replaces the contents of `out` by one frame.
void write_job_frame(const LiveJob& job, std::vector<std::uint8_t>& out);
void write_path_frame(std::span<const LivePathPoint> path, std::vector<std::uint8_t>& out);
// Vertices are rounded to 1/65535 of the longest edge of the mesh's box. At most 65,536 of them.
void write_chunk_frame(double t_s, const std::array<std::int32_t, 3>& chunk, const TriangleMesh& mesh,
                       std::vector<std::uint8_t>& out);
// A piece of the designed surface, as a chunk is written. At most 65,536 vertices.
void write_designed_frame(const TriangleMesh& mesh, std::vector<std::uint8_t>& out);
void write_state_frame(const LiveState& state, std::vector<std::uint8_t>& out);
// `anew`: what rows were told before is void.
void write_rows_frame(std::span<const LiveRow> rows, bool anew, std::vector<std::uint8_t>& out);
// `kind` as in milling::CollisionKind.
void write_collision_frame(double t_s, int kind, int line, Vec3 tip_mm, std::vector<std::uint8_t>& out);
void write_sound_frame(std::span<const LiveSoundPiece> pieces, std::vector<std::uint8_t>& out);
void write_listening_frame(const job::Listening& listening, std::vector<std::uint8_t>& out);
void write_finger_frame(const LiveTouch& touch, std::vector<std::uint8_t>& out);
void write_servo_frame(double t_s, const LiveServo& servo, std::vector<std::uint8_t>& out);
// The eight triangles and the force that each adds when pressed `press_mm` deep into stiffness
// `stiffness_n_per_mm`; null: there are none.
void write_texture_frame(double t_s, const contact::TextureRecord* texture, double press_mm,
                         double stiffness_n_per_mm, std::vector<std::uint8_t>& out);

}  // namespace tribo::protocol
