// SPDX-License-Identifier: MIT
// Keys of a job file and of a file of just-noticeable differences.
#include "app/limits/doors.hpp"
#include "job/memory_source.hpp"
#include "job/toml/jnd_profile_toml.hpp"
#include "job/toml/job_toml.hpp"

namespace tribo::test {
namespace {

// A job out of its sections; each may be replaced.
struct JobText {
    std::string stock = "box_mm = [[0, 0, -10], [20, 20, 0]]\n";
    std::string cutter = "kind = \"flat\"\ndiameter_mm = 1000\n";
    std::string material = "name = \"al7075-t6\"\n";
    std::string process = "spindle_rpm = 6000\nfeed_mm_per_min = 600\n";
    std::string path = "keyframes = \"a.csv\"\n";
    std::string more = "";

    std::string text() const {
        return "[stock]\n" + stock + "[cutter]\n" + cutter + "[material]\n" + material + "[process]\n" +
               process + "[path]\n" + path + more;
    }
};

std::string error_of(const JobText& job) {
    const auto read = job::parse_job(job.text(), "job.toml", job::MemorySource());
    return read ? "" : read.error().text();
}

// A door that writes `before`, the value and `after` into a section, behind what stands there.
Door door(const Limit& limit, std::string JobText::* section, const std::string& before,
          const std::string& after = "\n", const std::string& other_rule = "") {
    return {&limit, before,
            [=](double value) {
                JobText job;
                job.*section += before + written(value) + after;
                return error_of(job);
            },
            other_rule};
}

// The same, but alone in its section.
Door alone(const Limit& limit, std::string JobText::* section, const std::string& before,
           const std::string& after = "\n", const std::string& other_rule = "") {
    return {&limit, before,
            [=](double value) {
                JobText job;
                job.*section = before + written(value) + after;
                return error_of(job);
            },
            other_rule};
}

// In the frame of a second set-up.
Door turned(const Limit& limit, const std::string& before, const std::string& after) {
    return {&limit, before, [=](double value) {
                JobText job;
                job.stock = "from = \"first.toml\"\n";
                job.more = "[setup]\n" + before + written(value) + after;
                return error_of(job);
            }};
}

Door coefficient(const Limit& limit, const std::string& key) {
    return {&limit, key, [=](double value) {
                JobText job;
                job.material.clear();
                for (const char* k : {"ktc_n_per_mm2", "krc_n_per_mm2", "kac_n_per_mm2", "kte_n_per_mm",
                                      "kre_n_per_mm", "kae_n_per_mm"})
                    job.material += std::string(k) + " = " + (key == k ? written(value) : "1") + "\n";
                return error_of(job);
            }};
}

Door profile(const Limit& limit, const std::string& key) {
    return {&limit, key, [=](double value) {
                const auto read = job::parse_jnd_profile(key + " = " + written(value) + "\n", "me.toml");
                return read ? std::string() : read.error().text();
            }};
}

}  // namespace

Doors job_doors() {
    const Limits& l = kLimits;
    const auto more = &JobText::more, cutter = &JobText::cutter, process = &JobText::process;
    const std::string axis = "[[machine.axes]]\nword = \"A\"\ncarries = \"part\"\n";
    const std::string turns = axis + "direction = [1, 0, 0]\n";
    const std::string flat = "kind = \"flat\"\ndiameter_mm = ", bull = "kind = \"bull\"\n";
    const std::string known_mode =
        "[[mode]]\ndirection = [1, 0, 0]\nfrequency_hz = 10\ndamping_ratio = 0.1\nstiffness_n_per_mm = 10\n";
    return {
        door(l.coordinate, more, "[sound]\nlistener_mm = [0, ", ", 0]\n"),
        door(l.coordinate, more, turns + "pivot_mm = [", ", 0, 0]\n"),
        door(l.coordinate, more, turns + "[machine]\nstock_mm = [", ", 0, 0]\n"),
        door(l.coordinate, more,
             "[[machine.axes]]\nword = \"X\"\ncarries = \"tool\"\ndirection = [1, 0, 0]\nzero_mm = "),
        turned(l.coordinate, "origin_mm = [", ", 0, 0]\n"),
        {&l.coordinate, "box_mm",
         [](double value) {
             JobText job;
             const std::string other = written(value > 0 ? 999'999 : -999'999);
             job.stock = "box_mm = [[0, 0, " + written(value) + "], [20, 20, " + other + "]]\n";
             return error_of(job);
         }},
        door(l.direction, more, axis + "direction = [", ", 1, 0]\n"),
        turned(l.direction, "z_axis = [0, 0.1, ", "]\n"),
        door(l.axis_limit, more, turns + "zero_deg = "),
        {&l.axis_limit, "limits_deg",
         [=](double value) {
             JobText job;
             job.more = turns + "limits_deg = [" + written(value < 0 ? value : 0) + ", " +
                        written(value > 0 ? value : 0) + "]\n";
             return error_of(job);
         }},
        alone(l.feed, process, "spindle_rpm = 6000\nfeed_mm_per_min = "),
        alone(l.spindle_speed, process, "feed_mm_per_min = 600\nspindle_rpm = "),
        alone(l.spindle_variation, process,
              "feed_mm_per_min = 600\nspindle_rpm = 6000\nspindle_variation_hz = 1\nspindle_variation = "),
        alone(l.spindle_variation_rate, process,
              "feed_mm_per_min = 600\nspindle_rpm = 6000\nspindle_variation = 0.1\nspindle_variation_hz = "),
        door(l.spindle_speed, more, "[sound]\nrecording = \"a.wav\"\nrecording_rpm = "),
        door(l.spindle_speed, more, "[sound]\nidle_recording = \"a.wav\"\nidle_recording_rpm = "),
        door(l.rapid, more, "[machine]\nrapid_mm_per_min = "),
        door(l.acceleration, more, "[machine]\nacceleration_mm_per_s2 = "),
        door(l.tool_number, cutter, "number = "),
        alone(l.cutter_diameter, cutter, flat),
        door(l.core_diameter, cutter, "core_mm = "),
        alone(l.corner_radius, cutter, bull + "diameter_mm = 1000\nlength_mm = 600\ncorner_mm = ", "\n",
              "not between 0 and the radius"),
        door(l.cutting_length, cutter, "length_mm = "),
        alone(l.tip_size, cutter, "kind = \"v\"\ndiameter_mm = 9\npoint_deg = 60\ntip_mm = ", "\n",
              "leaves no cone"),
        alone(l.point_angle, cutter, "kind = \"v\"\ndiameter_mm = 9\nlength_mm = 600\npoint_deg = "),
        alone(l.taper_angle, cutter, "kind = \"taper\"\ndiameter_mm = 9\ntaper_deg = ", "\n", "too steep"),
        alone(l.side_radius, cutter, "kind = \"lens\"\ndiameter_mm = 0.01\nside_mm = "),
        alone(l.profile_height, cutter,
              "kind = \"dovetail\"\ndiameter_mm = 9\ntaper_deg = 0.01\nheight_mm = ", "\n",
              "the length of the cutting edges"),
        alone(l.profile_coordinate, cutter, "profile = [[1, 0], [1, ", "]]\n", "at the place of the one"),
        alone(l.bulge, cutter, "profile = [[2, 0, ", "], [2, 2]]\n"),
        door(l.flutes, cutter, "flutes = "),
        door(l.helix, cutter, "helix_deg = "),
        door(l.pitch, cutter, "flutes = 1\npitch_deg = ", "\n", "does not add up"),
        door(l.runout, cutter, "runout_mm = "),
        door(l.spread, cutter, "runout_spread = "),
        door(l.runout_angle, cutter, "runout_deg = "),
        door(l.holder, more, "[holder]\nlength_mm = 10\ndiameter_mm = "),
        door(l.holder, more, "[holder]\ndiameter_mm = 10\nlength_mm = "),
        door(l.stickout, cutter, "stickout_mm = ", "\n", "is shorter than the cutting edges"),
        door(l.stickout, cutter, "length_mm = 0.01\nstickout_mm = 2000\nneck_mm = 1\nreach_mm = "),
        door(l.shank_diameter, cutter, "stickout_mm = 100\nshank_mm = "),
        door(l.shank_diameter, cutter, "stickout_mm = 100\nneck_mm = "),
        door(l.tool_length, more, turns + "[machine]\ntool_length_mm = "),
        alone(l.edge, &JobText::stock, "box_mm = [[0, 0, 0], [10, 10, ", "]]\n"),
        door(l.edge, more, "[[fixture]]\nbox_mm = [[0, 0, 0], [10, 10, ", "]]\n"),
        alone(l.unit, &JobText::stock, "mesh = \"a.stl\"\nunit_mm = "),
        door(l.unit, more, "[part]\nsurface = \"a.stl\"\nunit_mm = "),
        door(l.unit, &JobText::path, "unit_mm = "),
        coefficient(l.ktc, "ktc_n_per_mm2"),
        coefficient(l.krc, "krc_n_per_mm2"),
        coefficient(l.krc, "kac_n_per_mm2"),
        coefficient(l.kte, "kte_n_per_mm"),
        coefficient(l.kre, "kre_n_per_mm"),
        coefficient(l.kre, "kae_n_per_mm"),
        alone(l.spread, &JobText::material,
              "ktc_n_per_mm2 = 1\nkrc_n_per_mm2 = 1\nkac_n_per_mm2 = 1\nkte_n_per_mm = 1\nkre_n_per_mm = 1\n"
              "kae_n_per_mm = 1\nspread = "),
        door(l.engagement_angle, more, "[engagement]\nexit_deg = 360\naxial_depth_mm = 1\nentry_deg = ", "\n",
             "is not behind 'entry_deg'"),
        door(l.engagement_angle, more, "[engagement]\nentry_deg = 0\naxial_depth_mm = 1\nexit_deg = ", "\n",
             "is not behind 'entry_deg'"),
        door(
            l.mode_frequency, more,
            "[[mode]]\ndirection = [1, 0, 0]\ndamping_ratio = 0.1\nstiffness_n_per_mm = 10\nfrequency_hz = "),
        door(l.mode_damping, more,
             "[[mode]]\ndirection = [1, 0, 0]\nfrequency_hz = 10\nstiffness_n_per_mm = 10\ndamping_ratio = "),
        door(
            l.mode_stiffness, more,
            "[[mode]]\ndirection = [1, 0, 0]\nfrequency_hz = 10\ndamping_ratio = 0.1\nstiffness_n_per_mm = "),
        door(l.spread, more, known_mode + "frequency_spread = "),
        door(l.spread, more, known_mode + "damping_spread = "),
        door(l.spread, more, known_mode + "stiffness_spread = "),
        {&l.mode_frequency, "band_hz",
         [](double value) {
             JobText job;
             const bool is_low = value < 10;
             job.more = "[[frf]]\nfile = \"a.csv\"\ndirection = [1, 0, 0]\nband_hz = [" +
                        written(is_low ? value : 10) + ", " + written(is_low ? 10 : value) + "]\n";
             return error_of(job);
         }},
        door(l.fitted_modes, more, "[[frf]]\nfile = \"a.csv\"\ndirection = [1, 0, 0]\nmodes = "),
        door(l.axial_depth, more, "[engagement]\nentry_deg = 0\nexit_deg = 90\naxial_depth_mm = "),
        door(l.most_force, more, "[limits]\nforce_n = "),
        door(l.most_torque, more, "[limits]\ntorque_nm = "),
        door(l.most_power, more, "[limits]\npower_w = "),
        door(l.spindle_speed, more, "[limits]\nspindle = [[", ", 1, 1]]\n"),
        door(l.most_power, more, "[limits]\nspindle = [[1000, ", ", 1]]\n"),
        door(l.most_torque, more, "[limits]\nspindle = [[1000, 1, ", "]]\n"),
        door(l.most_stress, more, "[limits]\nstress_n_per_mm2 = "),
        door(l.most_deflection, more, "[limits]\ndeflection_mm = "),
        door(l.chip_limit, more, "[limits]\nchip_min_mm = "),
        door(l.chip_limit, more, "[limits]\nchip_max_mm = "),
        door(l.most_multiplier, more, "[limits]\nmultiplier = "),
        door(l.tolerance, more, "[limits]\ntolerance_mm = "),
        door(l.force_scale, more, "[haptics]\nforce_scale = "),
        door(l.friction, more, "[haptics]\nfriction_static = "),
        door(l.friction, more, "[haptics]\nfriction_kinetic = "),
        door(l.surface_stiffness, more, "[haptics]\nstiffness_n_per_mm = "),
        door(l.distance_factor, more, "[sound]\ndistance_factor = "),
        door(l.reference_distance, more, "[sound]\nreference_distance_m = "),
        door(l.gain, more, "[sound]\ngain_db = "),
        door(l.level, more, "[sound]\ncut_db = "),
        door(l.level, more, "[sound]\nspindle_db = "),
        door(l.level, more, "[sound]\nchips_db = "),
        door(l.level, more, "[sound]\nroom_db = "),
        door(l.recording_share, more,
             "[sound]\nrecording = \"a.wav\"\nrecording_rpm = 6000\nrecording_share = "),
        door(l.sample_bits, more, "[sound]\nbits = "),
        profile(l.noticeable_share, "force_magnitude"),
        profile(l.noticeable_share, "vibration_amplitude"),
        profile(l.noticeable_share, "vibration_frequency"),
        profile(l.noticeable_share, "pitch"),
        profile(l.noticeable_angle, "force_direction_deg"),
        profile(l.noticeable_level, "sound_level_db"),
        profile(l.force_floor, "force_floor_n"),
        profile(l.force_floor, "vibration_floor_n"),
    };
}

}  // namespace tribo::test
