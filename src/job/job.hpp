// SPDX-License-Identifier: MIT
// What a job file says, checked: which part comes out of which stock with which tools, how fast, and how it
// is to be heard and felt. Plain data without files, so that the session, the TOML reader and the page share
// it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/vec3.hpp"
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

// The stock as an earlier job leaves it.
struct JobStockFrom {
    std::string path;          // a job file, or the folder of its render
    int line = 0, column = 0;  // of the key in this job's file
};

// Either a name out of the library of materials (milling/materials.hpp) or coefficients of one's own.
struct JobMaterial {
    std::string name;
    std::optional<milling::CuttingCoefficients> coefficients;
};

using motion::Interpolation;

enum class PathKind { keyframes, gcode, apt };

struct JobPath {
    PathKind kind = PathKind::keyframes;
    std::string file;
    motion::Interpolation interpolation =
        motion::Interpolation::spline;  // of keyframes; programs say it themselves
    std::string machine;  // of G-code: a machine's name, or the file that describes it; may be empty
    std::string tools;    // a tool table; may be empty
    std::optional<readers::Dialect> dialect;  // of G-code; absent: as its text says
    double unit_mm = 1;                       // of keyframes only
};

// What the process is where the program does not say; 0: the program must.
struct JobProcess {
    double spindle_rpm = 0;
    double feed_mm_per_min = 0;
};

// Engagement prescribed instead of measured (the paper's input file): clockwise from the left of the feed,
// 0 <= entry < exit <= 360.
struct JobEngagement {
    double entry_deg = 0;
    double exit_deg = 0;
    double axial_depth_mm = 0;
};

enum class SoundMode { hrtf, sphere, pan };

struct JobSound {
    std::optional<Vec3> listener_mm;  // absent: the centre of the stock's top
    double reference_distance_m = 1;  // nearer it gets no louder, 0.05 to 100
    double distance_factor = 1;       // > 0; the paper's: scales distances before they are heard
    double gain_db = 0;
    int bits = 16;  // 16, 24 or 32 per sample
    std::optional<SoundMode> mode;
    std::string hrtf;          // a SOFA file; empty: the set that is built in
    bool as_measured = false;  // the set's responses; else made for headphones of a diffuse field
    // A recorded cut and the spindle speed at which it was recorded, mixed with equal power: its share of it.
    std::string recording;  // empty: none
    double recording_rpm = 0, recording_share = 0.5;
    std::string idle_recording;  // of a spindle that turns and does not cut; empty: none
    double idle_recording_rpm = 0;
    std::string chips;  // a material file, whose first voice is what a recorded cut sounds like; empty: none
    std::string machine = "mill", room = "workshop";  // names of sound::machines() and sound::rooms()
    // Against what machine, material and room have, -60 to 60 dB.
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

struct JobMachine {
    double rapid_mm_per_min = 10000;    // > 0
    double acceleration_mm_per_s2 = 0;  // > 0; 0: feeds are reached at once
    // Its axes, named or described; motion::check accepts them. None: three axes, and rotary words are
    // refused.
    std::optional<motion::Machine> kinematics;
};

struct Job {
    std::string file;                        // as the user named it
    std::optional<readers::ModelFile> part;  // the designed surface
    JobSolid stock;                          // empty where `stock_from` is given
    std::optional<JobStockFrom> stock_from;  // an earlier job
    // This job's coordinates in those of the earlier job: unit axes, right-handed. Absent: the same.
    std::optional<motion::WorkFrame> setup;
    std::vector<JobSolid> fixtures;
    std::vector<milling::Cutter> cutters;  // at least one; numbers differ
    JobMaterial material;
    JobProcess process;
    JobPath path;
    std::optional<JobEngagement> engagement;
    JobSound sound;
    JobHaptics haptics;
    JobMachine machine;
};

}  // namespace tribo::job
