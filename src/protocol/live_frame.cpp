// SPDX-License-Identifier: MIT
#include "protocol/live_frame.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>

#include "base/math.hpp"

namespace tribo::protocol {
namespace {

// Of a rows frame.
constexpr std::uint64_t kAnew = 1;

// Appends little-endian values to a frame that begins with the header: kind, version, flags, five zeros,
// time.
class Frame {
  public:
    Frame(LiveFrame kind, double t_s, std::vector<std::uint8_t>& out, bool flag = false) : out_(out) {
        out_.clear();
        out_.push_back(static_cast<std::uint8_t>(kind));
        out_.push_back(kLiveFrameVersion);
        bits(flag ? kAnew : 0, 6);
        bits(std::bit_cast<std::uint64_t>(t_s), 8);
    }

    void u16(std::uint32_t v) { bits(v, 2); }
    void u32(std::uint32_t v) { bits(v, 4); }
    void i32(std::int32_t v) { bits(static_cast<std::uint32_t>(v), 4); }
    void f32(double v) { bits(std::bit_cast<std::uint32_t>(static_cast<float>(v)), 4); }
    void f64(double v) { bits(std::bit_cast<std::uint64_t>(v), 8); }
    void vec3(Vec3 v) {
        f32(v.x);
        f32(v.y);
        f32(v.z);
    }
    // To a multiple of four bytes.
    void pad() {
        while (out_.size() % 4 != 0) out_.push_back(0);
    }
    void reserve(std::size_t bytes) { out_.reserve(out_.size() + bytes); }

  private:
    void bits(std::uint64_t v, int bytes) {
        for (int n = 0; n < bytes; ++n) out_.push_back(static_cast<std::uint8_t>(v >> (8 * n)));
    }

    std::vector<std::uint8_t>& out_;
};

std::uint32_t count(std::size_t n) {
    return static_cast<std::uint32_t>(n);
}

void write_mesh(const TriangleMesh& mesh, Frame& f) {
    assert(mesh.positions.size() <= 65536);
    const Box3 box = bounds(mesh);
    const Vec3 size = mesh.positions.empty() ? Vec3{} : box.size();
    const Vec3 origin = mesh.positions.empty() ? Vec3{} : box.min;
    const double longest = std::max({size.x, size.y, size.z});
    const double step = longest > 0 ? longest / 65535 : 1;
    f.u32(count(mesh.positions.size()));
    f.u32(count(mesh.triangles.size()));
    f.vec3(origin);
    f.f32(step);
    f.reserve(6 * mesh.positions.size() + 6 * mesh.triangles.size() + 8);
    for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
        const Vec3 p = (mesh.position(static_cast<std::uint32_t>(n)) - origin) / step;
        for (int axis = 0; axis < 3; ++axis)
            f.u16(static_cast<std::uint32_t>(std::clamp(p[axis] + 0.5, 0.0, 65535.0)));
    }
    f.pad();
    for (const Triangle& t : mesh.triangles) {
        for (const std::uint32_t v : t) f.u16(v);
    }
    f.pad();
}

}  // namespace

void write_job_frame(const LiveJob& job, std::vector<std::uint8_t>& out) {
    Frame f(LiveFrame::job, 0, out);
    f.f64(job.duration_s);
    f.f32(job.cell_mm);
    f.vec3(job.blank_mm.min);
    f.vec3(job.blank_mm.max);
    f.u32(count(job.cutters.size()));
    for (const milling::Cutter& c : job.cutters) {
        f.i32(c.number);
        f.u32(static_cast<std::uint32_t>(c.flutes));
        f.f32(c.radius_mm());
        f.f32(c.corner_radius_mm());
        f.f32(c.length_mm);
        f.u32(count(c.holder.size()));
        for (const milling::HolderStep& step : c.holder) {
            f.f32(0.5 * step.diameter_mm);
            f.f32(step.length_mm);
        }
    }
}

void write_path_frame(std::span<const LivePathPoint> path, std::vector<std::uint8_t>& out) {
    Frame f(LiveFrame::path, 0, out);
    f.u32(count(path.size()));
    f.reserve(20 * path.size());
    for (const LivePathPoint& p : path) {
        f.f32(p.t_s);
        f.vec3(p.tip_mm);
        f.u32(p.rapid ? 1 : 0);
    }
}

void write_chunk_frame(double t_s, const std::array<std::int32_t, 3>& chunk, const TriangleMesh& mesh,
                       std::vector<std::uint8_t>& out) {
    Frame f(LiveFrame::chunk, t_s, out);
    for (const std::int32_t c : chunk) f.i32(c);
    write_mesh(mesh, f);
}

void write_designed_frame(const TriangleMesh& mesh, std::vector<std::uint8_t>& out) {
    Frame f(LiveFrame::designed, 0, out);
    write_mesh(mesh, f);
}

void write_state_frame(const LiveState& s, std::vector<std::uint8_t>& out) {
    Frame f(LiveFrame::state, s.t_s, out);
    f.vec3(s.tool.tip_mm);
    f.vec3(s.tool.axis);
    f.vec3(s.force_n);
    f.f32(s.peak_force_n);
    f.f32(s.mean_torque_nm);
    f.f32(s.spindle_rpm);
    f.f32(s.feed_mm_per_min);
    f.f32(s.spindle_angle_rad);
    f.f32(s.removed_mm3);
    f.f32(s.milled_s);
    f.f32(s.speed);
    f.u32(s.line);
    f.u32(s.cutter);
    f.u32((s.cutting ? 1U : 0U) | (s.playing ? 2U : 0U) | (s.rapid ? 4U : 0U));
}

void write_rows_frame(std::span<const LiveRow> rows, bool anew, std::vector<std::uint8_t>& out) {
    Frame f(LiveFrame::rows, rows.empty() ? 0 : rows.front().t_s, out, anew);
    f.u32(count(rows.size()));
    f.reserve(56 * rows.size());
    for (const LiveRow& r : rows) {
        f.f64(r.t_s);
        f.f32(r.end_s - r.t_s);
        f.vec3(r.tip_mm);
        f.f32(r.mean_force_n);
        f.f32(r.peak_force_n);
        f.f32(r.mean_torque_nm);
        f.f32(r.entry_rad);
        f.f32(r.exit_rad);
        f.f32(r.axial_depth_mm);
        f.f32(r.feed_per_tooth_mm);
        f.u32(r.line);
    }
}

void write_collision_frame(double t_s, int kind, int line, Vec3 tip_mm, std::vector<std::uint8_t>& out) {
    Frame f(LiveFrame::collision, t_s, out);
    f.i32(kind);
    f.i32(line);
    f.vec3(tip_mm);
}

void write_sound_frame(std::span<const LiveSoundPiece> pieces, std::vector<std::uint8_t>& out) {
    Frame f(LiveFrame::sound, pieces.empty() ? 0 : pieces.front().t_s, out);
    f.u32(count(pieces.size()));
    for (const LiveSoundPiece& p : pieces) {
        f.f64(p.t_s);
        f.f32(p.end_s - p.t_s);
        f.vec3(p.tip_mm);
        f.f32(std::fmod(p.spindle_angle_rad, math::kTwoPi));
        f.f32(p.spindle_rad_per_s);
        f.f32(p.pace);
        f.f32(p.chip_mm3_per_s);
        f.i32(p.spectrum.order_step);
        f.u32(count(p.spectrum.harmonics.size()));
        for (const contact::ForceHarmonic& h : p.spectrum.harmonics) {
            for (const auto& channel : {h.x, h.y, h.z}) {
                f.f32(channel.real());
                f.f32(channel.imag());
            }
        }
    }
    // Later than the rest of the frame: readers that do not know of it are done.
    for (const LiveSoundPiece& p : pieces) {
        f.i32(p.edges);
        f.f32(mean_force(p.spectrum).torque_nmm);
    }
}

void write_listening_frame(const job::Listening& l, std::vector<std::uint8_t>& out) {
    Frame f(LiveFrame::listening, 0, out);
    f.vec3(l.listener_mm);
    f.f32(l.distance_factor);
    f.f32(l.gain_db);
    constexpr std::size_t kToolModes = 2;
    for (std::size_t n = 0; n < kToolModes; ++n) {
        f.f32(l.tool.modes[n].hz);
        f.f32(l.tool.modes[n].damping);
    }
    f.f32(l.reference_distance_m);
    const sound::Workshop& w = l.workshop;
    for (const std::size_t choice : {w.machine, w.room, static_cast<std::size_t>(w.chips)})
        f.u32(count(choice));
    for (const double db : {w.cut_db, w.spindle_db, w.chips_db, w.room_db}) f.f32(db);
}

void write_finger_frame(const LiveTouch& t, std::vector<std::uint8_t>& out) {
    Frame f(LiveFrame::finger, t.t_s, out);
    f.vec3(t.probe_mm);
    f.vec3(t.proxy_mm);
    f.vec3(t.force_n);
    f.f32(t.slip_mm_per_s);
    f.u32((t.contact ? 1U : 0U) | (t.cutting_force ? 2U : 0U) | (t.cut_mode ? 4U : 0U) |
          (t.stopped ? 8U : 0U) | (t.hand ? 16U : 0U));
}

void write_servo_frame(double t_s, const LiveServo& s, std::vector<std::uint8_t>& out) {
    Frame f(LiveFrame::servo, t_s, out);
    for (const std::uint32_t n : {s.ticks, s.late, s.fault}) f.u32(n);
    for (const double v : {s.rate_hz, s.force_limit_n, s.largest_force_n}) f.f32(v);
    for (const double v : s.lateness_us) f.f32(v);
    for (const double v : s.cpu_us) f.f32(v);
}

void write_texture_frame(double t_s, const contact::TextureRecord* texture, double press_mm,
                         double stiffness_n_per_mm, std::vector<std::uint8_t>& out) {
    Frame f(LiveFrame::texture, t_s, out);
    if (texture == nullptr) return;
    for (const contact::TexturedTriangle& t : texture->triangles()) {
        for (const Vec3& corner : t.corners_mm) f.vec3(corner);
        f.vec3(stiffness_n_per_mm * ((press_mm + t.height_mm) * t.normal - press_mm * texture->normal));
    }
}

}  // namespace tribo::protocol
