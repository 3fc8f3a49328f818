// SPDX-License-Identifier: MIT
// A checked job file: part, stock, tools, speeds, and options of sound and force.
// Plain data without files, shared by session, TOML reader and page.
// Units are in the names.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/vec3.hpp"
#include "dynamics/mode.hpp"
#include "job/frf.hpp"
#include "milling/tool/coefficients.hpp"
#include "milling/tool/cutter.hpp"
#include "motion/curve/keyframe_motion.hpp"
#include "motion/machine/machine.hpp"
#include "motion/machine/work_frame.hpp"
#include "readers/control/dialect.hpp"
#include "readers/mesh/model.hpp"

namespace tribo::job {

// Stock or fixture: a box, or the solid inside a model.
struct JobSolid {
    Box3 box_mm;  // empty where `model` is given
    std::optional<readers::ModelFile> model;
};

// The stock that an earlier job leaves.
struct JobStockFrom {
    std::string path;          // a job file, or the folder of its render
    int line = 0, column = 0;  // of the key in the file of this job
};

// Either a name in the library of materials (milling/tool/materials.hpp), or own coefficients.
struct JobMaterial {
    std::string name;
    std::optional<milling::CuttingCoefficients> coefficients;
    // Of own coefficients: in 9 of 10 cases a true force is the computed one divided by 1 + spread to times
    // that.
    double spread = 0;
};

// The modes of every cutter are estimated from its shape (dynamics/tool_estimate.hpp).
struct JobEstimate {
    int line = 0, column = 0;  // of the key in the file of this job
};

using motion::Interpolation;

enum class PathKind { keyframes, gcode, apt };

struct JobPath {
    PathKind kind = PathKind::keyframes;
    std::string file;
    motion::Interpolation interpolation =
        motion::Interpolation::spline;  // of keyframes; programs define it themselves
    std::string machine;                // of G-code: name of a machine, or its description file; may be empty
    std::string tools;                  // a tool table; may be empty
    std::optional<readers::Dialect> dialect;  // of G-code; absent: detected from the text
    double unit_mm = 1;                       // of keyframes; of APT and NCI that state none, 1 or 25.4
};

// Defaults for values that the program does not state; 0: the program must state them.
struct JobProcess {
    double spindle_rpm = 0;
    double feed_mm_per_min = 0;
    // The spindle swings about its speed by this share, so many times a second; 0: it does not.
    double spindle_variation = 0, spindle_variation_hz = 0;
};

// Engagement prescribed instead of measured (as in the paper): clockwise from the left of the feed,
// 0 <= entry < exit <= 360.
struct JobEngagement {
    double entry_deg = 0;
    double exit_deg = 0;
    double axial_depth_mm = 0;
};

enum class SoundMode { hrtf, sphere, pan };

struct JobSound {
    std::optional<Vec3> listener_mm;  // absent: the centre of the top of the stock
    double reference_distance_m = 1;  // a nearer source gets no louder; 0.05 to 100
    double distance_factor = 1;       // > 0; factor on distances (from the paper)
    double gain_db = 0;
    int bits = 16;  // 16, 24 or 32 per sample
    std::optional<SoundMode> mode;
    std::string hrtf;          // a SOFA file; empty: the shipped set
    bool as_measured = false;  // no equalization; else for diffuse-field headphones
    // Recorded cut, its spindle speed, and its share of the power.
    std::string recording;  // empty: none
    double recording_rpm = 0, recording_share = 0.5;
    std::string idle_recording;  // recording of an idle spindle; empty: none
    double idle_recording_rpm = 0;
    std::string chips;  // a material file; its first voice is a recorded cut; empty: none
    std::string machine = "mill", room = "workshop";  // names of sound::machines() and sound::rooms()
    // Relative to machine, material and room, -60 to 60 dB.
    double cut_db = 0, spindle_db = 0, chips_db = 0, room_db = 0;
};

enum class ProbeKind { point, ray, cylinder };

struct JobHaptics {
    double force_scale = 0.01;  // newtons at the hand per newton at the cutter, > 0
    std::string profile;        // file of just-noticeable differences; empty: the default
    ProbeKind probe = ProbeKind::point;
    std::optional<double> friction_static;
    std::optional<double> friction_kinetic;    // <= static where both are given
    std::optional<double> stiffness_n_per_mm;  // > 0
};

// What the spindle gives at a speed.
struct SpindlePoint {
    double rpm = 0, power_w = 0, torque_nm = 0;  // > 0
};

// What tool, spindle and part stand, as far as the job states it.
struct JobLimits {
    std::optional<double> force_n{}, torque_nm{}, power_w{};
    std::vector<SpindlePoint> spindle{};  // speeds ascending; not beside torque or power
    std::optional<double> stress_n_per_mm2{}, deflection_mm{};
    std::optional<double> chip_min_mm{}, chip_max_mm{};
    std::optional<double> multiplier{};  // of a cut that may chatter
    std::optional<double> tolerance_mm{};
};

struct JobMachine {
    double rapid_mm_per_min = 10000;    // > 0
    double acceleration_mm_per_s2 = 0;  // >= 0; 0: feeds are reached at once
    // Axes of the machine; motion::check() accepts them. None: three axes, and rotary words are
    // refused.
    std::optional<motion::Machine> kinematics;
};

// A file that a key of the job names.
struct JobFile {
    std::string path;  // joined with the folder of the job
    std::string key;
    int line = 0, column = 0;  // of its value in the file of this job
};

struct Job {
    std::string file;                        // as given by the user
    std::vector<JobFile> files;              // all that it names; job_files.hpp
    std::optional<readers::ModelFile> part;  // the designed surface
    JobSolid stock;                          // empty where `stock_from` is given
    std::optional<JobStockFrom> stock_from;  // an earlier job
    // Frame of this job in the coordinates of the earlier job: unit axes, right-handed. Absent: the same.
    std::optional<motion::WorkFrame> setup;
    std::vector<JobSolid> fixtures;
    std::vector<milling::Cutter> cutters;  // at least one; numbers differ
    JobMaterial material;
    JobProcess process;
    JobPath path;
    std::optional<JobEngagement> engagement;
    // Unit directions in stock axes. Those of a tool are where its axis is +z; they turn with it.
    // Those of `frfs` come last, once they are loaded.
    std::vector<dynamics::Mode> modes;
    std::vector<JobFrf> frfs;
    std::optional<JobEstimate> estimate;  // beside modes of the part; the tool has no others then
    JobSound sound;
    JobHaptics haptics;
    JobMachine machine;
    JobLimits limits;

    bool can_vibrate() const { return estimate || !modes.empty() || !frfs.empty(); }
    bool has_stock() const { return stock_from || stock.model || !stock.box_mm.empty(); }
};

}  // namespace tribo::job
