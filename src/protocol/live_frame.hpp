// SPDX-License-Identifier: MIT
// Binary frames of the live view (docs/live-protocol.md): from an engine, from the module in a page, or out
// of a recording. live_fields.hpp describes the bytes of each. Little-endian; angles in rad, lengths in mm.
#pragma once

#include <array>
#include <compare>
#include <complex>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/mesh.hpp"
#include "dynamics/mode.hpp"
#include "job/listening.hpp"
#include "milling/tool/coefficients.hpp"
#include "milling/tool/cutter.hpp"

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
    bending = 13,
    multipliers = 14,
    chart = 15,
    program = 16,
};

// Takes one whole frame; the bytes are valid during the call only.
using FrameSink = std::function<void(std::span<const std::uint8_t>)>;

struct LiveHolderStep {
    double radius_mm = 0, length_mm = 0;
};
struct LiveCutter {
    int number = 0, flutes = 0;
    double radius_mm = 0, corner_radius_mm = 0, length_mm = 0;
    std::vector<LiveHolderStep> holder;  // from the shank upwards
};
struct LiveOutlinePoint {
    double radius_mm = 0, height_mm = 0;
};
// From the bottom up; none of flat, ball and bull.
struct LiveOutline {
    std::vector<LiveOutlinePoint> points;
};
// All that was sent before is void.
struct LiveJob {
    double duration_s = 0, cell_mm = 0;
    Box3 blank_mm;
    std::vector<LiveCutter> cutters;
    // Limits of a chip, as in milling/engagement/chip.hpp; 0: not told.
    double rubbing_chip_mm = 0, overload_chip_share = 0;
    std::vector<LiveOutline> outlines;  // of each cutter
};

struct LiveChunkPlace {
    std::int32_t i = 0, j = 0, k = 0;
    auto operator<=>(const LiveChunkPlace&) const = default;
};
// Returns a step for the chunks of one part, a power of two in mm: a chunk of this longest edge has at most
// 65,533 steps, and single precision holds each of its multiples up to the farthest coordinate.
double step_of_chunks_mm(double longest_edge_mm, double farthest_mm);

// A piece of the part's surface, at most 65,536 vertices.
struct LiveChunk {
    double t_s = 0;
    LiveChunkPlace at;  // replaces the chunk of the same place
    TriangleMesh mesh;
    // Of each vertex from the designed surface, + material left, - gouge; NaN far from it and in a rough
    // chunk. Empty: there is none.
    std::vector<float> deviations_mm;
    // The first vertices of the mesh lie on the surface of the blank, so many; a triangle of them alone is
    // untouched.
    std::uint32_t on_blank = 0;
    // Drawn in a hurry: it comes again, exact, while the part stays as it is.
    bool rough = false;
    // Vertices are written as multiples of it, so that chunks meet exactly. 0: as 1/65535 of the longest edge
    // of the mesh's box. Not read back.
    double step_mm = 0;
};

// A piece of the designed surface, as a chunk is written.
struct LiveDesigned {
    TriangleMesh mesh;
};

// Whether a cut chatters (dynamics/stability.hpp).
struct LiveChatter {
    float multiplier = 0;  // 0: not known
    float chatter_hz = 0;
};
// Of the cut at the clock.
struct LiveChatterNow {
    LiveChatter of;
    float axial_depth_mm = 0;
};

// What the tool does at one moment of the program.
struct LiveState {
    double t_s = 0;
    Vec3 tip_mm, axis{0, 0, 1};
    Vec3 force_n;  // on the tool, mean over a turn, stock frame
    double peak_force_n = 0, mean_torque_nm = 0;
    double spindle_rpm = 0, feed_mm_per_min = 0, spindle_angle_rad = 0;
    double removed_mm3 = 0;  // since the program began
    double milled_s = 0;     // the cut is known up to here; the part is that of t_s
    double speed = 1;        // seconds of the program per second
    std::uint32_t line = 0, cutter = 0;
    bool cutting = false, playing = false, rapid = false;
    std::optional<LiveChatterNow> chatter{};  // of a job with modes, while it cuts
};

// One row of the plots and of the coloured path.
struct LiveRow {
    double t_s = 0, end_s = 0;
    Vec3 tip_mm;
    double mean_force_n = 0, peak_force_n = 0, mean_torque_nm = 0;
    double entry_rad = 0, exit_rad = 0, axial_depth_mm = 0;
    double feed_per_tooth_mm = 0;
    std::uint32_t line = 0;
    double chip_mm = 0;              // the thickest
    std::uint32_t chip_verdict = 0;  // as milling::ChipVerdict
    double spindle_rpm = 0;          // as it turns
    Vec3 axis{0, 0, 1};
    std::uint32_t cutter = 0;  // of LiveJob
    // Of its peak force: the band from cases. 0: that of LiveRows.
    double force_low_factor = 0, force_high_factor = 0;
};
struct LiveRows {
    bool anew = false;  // all rows before are void
    std::vector<LiveRow> rows;
    // Factors on their forces: the band in which the true ones lie. 0: not told.
    double force_low_factor = 0, force_high_factor = 0;
};

struct LiveCollision {
    double t_s = 0;
    int kind = 0;  // as in milling::CollisionKind
    int line = 0;
    Vec3 tip_mm;
};

// Force along the feed, to its left, to the shank, N.
using LiveHarmonic = std::array<std::complex<float>, 3>;
// The cut of a piece as a vibration needs it, from what the teeth cut to the frame of the tool.
struct LiveBand {
    float z0_mm = 0, z1_mm = 0, entry_rad = 0, exit_rad = 0;  // as milling::EngagementBand
};
struct LiveTeeth {
    std::uint32_t cutter = 0;                             // of LiveBending
    Point3f feed{1, 0, 0}, head{1, 0, 0}, axis{0, 0, 1};  // x of the head (session::head_frame())
    float across_mm = 0, down_mm = 0, turn_x_rad = 0, turn_y_rad = 0;  // as milling::ToolTravel, per tooth
    std::vector<LiveBand> bands;                                       // of the edges along the cutter
};
// A piece of the cut for the ear, in the precision of the frame: a sound made in this process and one made
// from the frames are the same, bit by bit.
struct LiveSoundPiece {
    double t_s = 0;  // of the program as it was written
    float duration_s = 0;
    Point3f tip_mm{};
    float spindle_angle_rad = 0;  // at t_s, within a turn
    float spindle_rad_per_s = 0;  // as it turns
    float pace = 1;               // seconds of the program as it was written per second
    float chip_mm3_per_s = 0;
    int order_step = 1;                   // spindle orders per harmonic
    std::vector<LiveHarmonic> harmonics;  // the mean first
    int edges = 0;                        // of the cutter
    float mean_torque_nmm = 0;
    LiveTeeth teeth;  // without bands: nothing vibrates in it
};
struct LiveSoundPieces {
    std::vector<LiveSoundPiece> pieces;
};

// What bends while the pieces of sound that follow are cut. None is sent of a job without modes.
struct LiveBendingCutter {
    milling::Cutter cutter;  // without its holder
    double fastest_rpm = 0;  // at the highest override
    std::vector<dynamics::Mode> modes;
};
struct LiveBending {
    milling::CuttingCoefficients coefficients;
    std::vector<LiveBendingCutter> cutters;  // those of the job frame
};

// Multipliers of rows, by the number of the row since LiveRows::anew or the job. Later ones replace earlier
// ones.
struct LiveMultipliers {
    std::uint32_t first = 0;
    std::vector<LiveChatter> rows;
};

// Speeds and depths at which the cut at the clock chatters.
struct LivePocket {
    double spindle_rpm = 0, depth_mm = 0;  // as dynamics::SafePocket
};
struct LiveChart {
    double from_rpm = 0, step_rpm = 0;  // speeds: from_rpm + n step_rpm
    double step_mm = 0;                 // depths: (n + 1) step_mm
    std::uint32_t depths = 0;
    std::vector<float> limits_mm;     // one per speed; 0: not computed yet; NaN: stable to the last depth
    std::vector<float> multipliers;   // speed by speed, all depths of each; 0: not computed yet
    std::vector<LivePocket> pockets;  // the deepest first; none before all is computed
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
    double t_s = 0;                                // of the program
    std::uint32_t ticks = 0, late = 0, fault = 0;  // fault as haptics::Fault
    double rate_hz = 0, force_limit_n = 0, largest_force_n = 0;
    std::array<double, 4> lateness_us{}, cpu_us{};
};

// The surface near the cutter, and the force that each of its triangles adds to a finger there.
struct LiveTextureTriangle {
    std::array<Vec3, 3> corners_mm;
    Vec3 force_n;
};
struct LiveTexture {
    double t_s = 0;
    std::vector<LiveTextureTriangle> triangles;  // eight; empty: there is none
};

// A point of the tool path in time.
struct LivePathPoint {
    double t_s = 0;
    Vec3 tip_mm;
    bool rapid = false;      // of the way that ends here
    std::uint32_t line = 0;  // likewise
};
struct LivePath {
    std::vector<LivePathPoint> points;
};

// The text that the lines of rows and state count in.
struct LiveProgram {
    std::string name;  // of the file
    std::string text;  // its bytes; empty: too long to be sent
};

// The kind of what begins like a frame of this version; none of anything else.
std::optional<LiveFrame> frame_kind(std::span<const std::uint8_t> bytes);
// The flag of rows, LiveRows::anew, without reading them.
bool header_flag(std::span<const std::uint8_t> bytes);

// `Frame` is one of the structs above, or job::Listening for the listener. LiveChunkPlace can be read alone.
// Replaces the contents of `out` by one frame.
template <class Frame>
void write_frame(const Frame& frame, std::vector<std::uint8_t>& out);
// False, with anything in `frame`: another kind or version, or cut off. What later versions of the program
// add at its end is left unread. Keeps the room of the vectors in `frame`.
template <class Frame>
bool read_frame(std::span<const std::uint8_t> bytes, Frame& frame);

}  // namespace tribo::protocol
