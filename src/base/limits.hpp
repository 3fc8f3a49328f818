// SPDX-License-Identifier: MIT
// The allowed range of every physical quantity that a user can give: one table for all readers, messages and
// flags. docs/limits.md lists it; tests/app/limits tries both sides of each end wherever the quantity comes
// in. A range refuses only what no machine, tool or finger can be, so that no sum behind it overflows, loses
// its digits or takes hours. Plain data, known at compile time; any thread.
#pragma once

#include <array>
#include <bit>

#include "base/range.hpp"

namespace tribo {

// One row of the table. All texts are for users.
struct Limit {
    const char* quantity;  // "spindle speed"
    const char* unit;      // empty: a plain number
    Range range;           // in this unit
    const char* given;     // keys, words, columns and flags, in Markdown
    const char* why;       // a sentence
};

struct Limits {
    // The path.
    Limit coordinate{
        "coordinate",
        "mm",
        {-1e6, 1e6},
        "points of a job, `--arm-at`, `--stock`, `finger`; X Y Z, I J K, R of programs, GOTO; x y z of "
        "keyframes and strokes",
        "No machine is a kilometre long. Products of larger numbers lose the micrometre."};
    Limit direction{"component of a direction",
                    "",
                    {-1e9, 1e9},
                    "`x_axis`, `z_axis`, `direction` of an axis; i j k of GOTO and of keyframes",
                    "Only the direction counts. Its length keeps all its digits."};
    Limit weight{"weight of a pose",
                 "",
                 {1e-9, 1e9},
                 "`weight` of keyframes, P of G5.2 and G6.2",
                 "Sums of weights further apart lose the lighter pose."};
    Limit rotary_angle{"angle of a rotary axis",
                       "deg",
                       {-1e5, 1e5},
                       "A B C and PA of programs; angles of G16 and G68",
                       "No table turns 278 times in one direction."};
    Limit axis_limit{"end of an axis",
                     "deg",
                     {-1e6, 1e6},
                     "`limits_deg`, `zero_deg`",
                     "Machines write 999999 where an axis turns without end."};
    Limit feed{"feed",
               "mm/min",
               {1e-3, 1e6},
               "`feed_mm_per_min`, `--feed-mm-per-min`; F, FEDRAT; keyframes",
               "A millimetre in 17 hours to a kilometre a minute. F0 is read, but no move may use it."};
    Limit feed_per_turn{"feed per turn",
                        "mm",
                        {1e-6, 1e3},
                        "F in G95, FEDRAT with MMPR or IPR",
                        "No tool cuts a nanometre, or a metre, in a turn."};
    Limit inverse_time{"inverse time",
                       "1/min",
                       {1e-4, 1e6},
                       "F in G93",
                       "A move takes a week at most, and 60 microseconds at least."};
    Limit spindle_speed{"spindle speed",
                        "rpm",
                        {0.01, 1e6},
                        "`spindle_rpm`, `recording_rpm`, `idle_recording_rpm`, `--spindle-rpm`, `--at`, "
                        "`--limit`, `--rpm`, `--simulate`; S, TOOL CALL S, SPINDL",
                        "The fastest air spindles reach about 500,000 rpm. S0 is read: the spindle stands."};
    Limit spindle_variation{"variation of the spindle speed",
                            "1",
                            {0, 0.5},
                            "`spindle_variation`",
                            "Machines that vary their speed do so by some tenths."};
    Limit spindle_variation_rate{"rate of the variation",
                                 "Hz",
                                 {0.01, 100},
                                 "`spindle_variation_hz`",
                                 "Spindles follow a few per second."};
    Limit dwell{"dwell", "s", {0, 86400}, "G4, CYCL DEF 9, dwells of cycles", "A day at most."};
    Limit rapid{"rapid rate",
                "mm/min",
                {1, 1e6},
                "`rapid_mm_per_min`",
                "A metre in 17 hours to a kilometre a minute."};
    Limit acceleration{
        "acceleration",
        "mm/s2",
        {1, 1e7},
        "`acceleration_mm_per_s2`",
        "From far below the slowest machine to a thousand times gravity. 0 is read: feeds are reached "
        "at once."};

    // The tool.
    Limit tool_number{"tool number",
                      "",
                      {1, 999'999'999},
                      "`number`; T, TOOL CALL, LOADTL; tool tables; `--tool`",
                      "Controls have nine digits at most. T0 is read: no tool."};
    Limit cutter_diameter{"cutter diameter",
                          "mm",
                          {0.01, 1000},
                          "`diameter_mm` of a cutter, also in tool tables, and D there; CUTTER; `--tool`",
                          "Micro end mills begin at 0.01 mm; face mills and fly cutters end below a metre."};
    Limit offset_diameter{"diameter of the cutter compensation",
                          "mm",
                          {0, 1000},
                          "D of G41.1 and G42.1, twice R of G10 L1",
                          "0 is none, and wear alone a few hundredths."};
    Limit corner_radius{"corner radius",
                        "mm",
                        {0, 500},
                        "`corner_mm`, CUTTER, `--tool`",
                        "At most the radius of the largest cutter."};
    Limit tip_size{"tip of a cutter",
                   "mm",
                   {0, 1000},
                   "`tip_mm`, `--tool`",
                   "At most the diameter of the largest cutter; 0 is a sharp point."};
    Limit point_angle{"angle of a point",
                      "deg",
                      {1, 179},
                      "`point_deg`, `--tool`",
                      "The sharpest engraver has 10 degrees; at 180 the point is flat."};
    Limit taper_angle{"angle of a side to the axis",
                      "deg",
                      {0.01, 89},
                      "`taper_deg`, `--tool`",
                      "Tapered mills have 0.5 degrees and more; at 90 the side is a bottom."};
    Limit side_radius{"radius of a barrel's side",
                      "mm",
                      {0.01, 1e5},
                      "`side_mm`, `--tool`",
                      "Barrel cutters have up to 1500 mm; beyond 100 m a side is straight."};
    Limit profile_height{"height on a cutter",
                         "mm",
                         {1e-3, 1000},
                         "`height_mm`, `--tool`",
                         "At most the length of the longest edges."};
    Limit profile_coordinate{"coordinate of a profile",
                             "mm",
                             {0, 1000},
                             "r and z of `profile`",
                             "The half plane beside the axis, from the tip up."};
    Limit bulge{"bulge of an arc",
                "",
                {-1, 1},
                "the third number of a vertex of `profile`",
                "The tangent of a quarter of its angle; 1 is half a circle."};
    Limit core_diameter{"core diameter",
                        "mm",
                        {0, 1000},
                        "`core_mm`, `--tool`",
                        "At most the diameter of the largest cutter."};
    Limit cutting_length{"length of the cutting edges",
                         "mm",
                         {0.01, 1000},
                         "`length_mm` of a cutter, `--tool`",
                         "Micro end mills have a few hundredths; no edge is a metre long."};
    Limit flutes{"flutes",
                 "",
                 {1, 64},
                 "`flutes`, also in tool tables; `--tool`",
                 "Large face mills have up to 64 inserts."};
    Limit helix{"helix angle",
                "deg",
                {-85, 85},
                "`helix_deg`, also on the page; `--tool`",
                "Beyond, a flute is a thread, and the lag of the edge per mm has no meaning."};
    Limit pitch{"pitch angle",
                "deg",
                {0.1, 360},
                "`pitch_deg`",
                "The angles of all flutes add up to 360; closer teeth have no room for a chip."};
    Limit runout{"run-out", "mm", {0, 10}, "`runout_mm`", "A good holder has 0.005 mm, a bent tool 1 mm."};
    Limit runout_angle{"angle of the run-out", "deg", {-360, 360}, "`runout_deg`", "One turn to each side."};
    Limit holder{"step of the holder",
                 "mm",
                 {0.01, 1e4},
                 "`diameter_mm` and `length_mm` of a holder",
                 "Spindle heads count as holders; none is ten metres."};
    Limit stickout{"stick-out of a cutter",
                   "mm",
                   {0.01, 2000},
                   "`stickout_mm`, `reach_mm`",
                   "As long as the longest edge, and as far again."};
    Limit shank_diameter{
        "diameter of shank or neck", "mm", {0.01, 1000}, "`shank_mm`, `neck_mm`", "As cutters themselves."};
    Limit tool_length{"length from the spindle nose",
                      "mm",
                      {-1e6, 1e6},
                      "`tool_length_mm`; `length_mm` and Z of tool tables",
                      "A coordinate: tables measure it from the zero of the machine, too."};

    // Stock and material.
    Limit edge{"edge of a box",
               "mm",
               {1e-3, 1e5},
               "`box_mm` of stock and fixtures, `--stock`",
               "Thinner than a micrometre is no solid; the largest gantry mills move 60 m."};
    Limit unit{"length of a file's unit",
               "mm",
               {1e-6, 1e6},
               "`unit_mm`, `--unit-mm`",
               "From a nanometre to a kilometre."};
    Limit ktc{"tangential coefficient",
              "N/mm2",
              {0.01, 1e5},
              "`ktc_n_per_mm2`",
              "Foam needs about 1, nickel alloys 5,000, no solid 100,000."};
    Limit krc{"radial or axial coefficient",
              "N/mm2",
              {-1e5, 1e5},
              "`krc_n_per_mm2`, `kac_n_per_mm2`",
              "Within the tangential one's range; sharp positive edges pull."};
    Limit kte{"tangential edge coefficient",
              "N/mm",
              {0, 1e4},
              "`kte_n_per_mm`",
              "Sharp edges need about 20, worn ones 100."};
    Limit kre{"radial or axial edge coefficient",
              "N/mm",
              {-1e4, 1e4},
              "`kre_n_per_mm`, `kae_n_per_mm`",
              "Within the tangential one's range."};
    Limit engagement_angle{"engagement angle",
                           "deg",
                           {0, 360},
                           "`entry_deg`, `exit_deg`",
                           "One turn, clockwise from the left of the feed."};
    Limit axial_depth{"prescribed depth",
                      "mm",
                      {1e-4, 1000},
                      "`axial_depth_mm`, `--at`, `--depth`, `--simulate`",
                      "As deep as the longest cutting edge. Each mm takes its time."};

    // What bends.
    Limit mode_frequency{"natural frequency",
                         "Hz",
                         {1, 1e5},
                         "`frequency_hz` of a mode, `band_hz`",
                         "A long boring bar has 50, a micro end mill 10,000 Hz."};
    Limit mode_damping{"damping ratio",
                       "",
                       {1e-5, 0.9},
                       "`damping_ratio` of a mode",
                       "Steel alone has 0.001, a damped holder 0.1."};
    Limit mode_stiffness{"modal stiffness",
                         "N/mm",
                         {1e-3, 1e10},
                         "`stiffness_n_per_mm` of a mode",
                         "A thin wall has 100, a rigid machine 100,000."};
    Limit spread{
        "spread",
        "",
        {0, 9},
        "`frequency_spread`, `damping_spread` and `stiffness_spread` of a mode, `runout_spread` of a "
        "cutter, `spread` of `[material]`",
        "A factor of ten to both sides; what is known less well is not known."};
    Limit fitted_modes{"modes to fit",
                       "",
                       {1, 12},
                       "`modes` of a response",
                       "Each takes its time, and its share of the noise."};
    Limit response_frequency{"frequency of a response",
                             "Hz",
                             {0, 1e6},
                             "`frequency_hz` of a response; dataset 58",
                             "Hammers reach 20,000 Hz."};
    Limit receptance{"receptance",
                     "mm/N",
                     {-1e6, 1e6},
                     "`re_mm_per_n`, `im_mm_per_n`; dataset 58",
                     "A thin wall at its resonance has 1; an accelerometer's noise at 0.1 Hz has 1,000."};

    // What tool, spindle and part stand.
    Limit most_force{"force limit",
                     "N",
                     {1e-3, 1e6},
                     "`force_n` of `[limits]`, `--force-n`",
                     "A heavy roughing cutter of steel has 20,000."};
    Limit most_torque{"torque limit",
                      "N m",
                      {1e-6, 1e5},
                      "`torque_nm` and `spindle` of `[limits]`",
                      "Geared spindles of large mills give 2,000."};
    Limit most_power{"power limit",
                     "W",
                     {1e-3, 1e6},
                     "`power_w` and `spindle` of `[limits]`, `--power-w`",
                     "A dentist's spindle has 20, a large mill 100,000."};
    Limit most_stress{"stress limit",
                      "N/mm2",
                      {1, 1e4},
                      "`stress_n_per_mm2`, `--stress`",
                      "The strongest carbide breaks at 5,000."};
    Limit most_deflection{"deflection limit",
                          "mm",
                          {1e-6, 10},
                          "`deflection_mm`, `--deflection-mm`",
                          "From a nanometre to far beyond any cut."};
    Limit chip_limit{"chip limit",
                     "mm",
                     {1e-6, 10},
                     "`chip_min_mm`, `chip_max_mm`, `--chip-mm`",
                     "From a nanometre to the chips of the largest face mills."};
    Limit most_multiplier{
        "multiplier limit", "", {0.01, 10}, "`multiplier` of `[limits]`", "1 is the border of chatter."};
    Limit tolerance{"tolerance", "mm", {1e-6, 100}, "`tolerance_mm`", "From a nanometre to a rough casting."};
    Limit fail_ratio{"ratio to a limit", "", {1e-3, 1e3}, "`--fail-over`", "1 is the limit itself."};

    // The run.
    Limit resolution{"spacing of the grid",
                     "mm",
                     {1e-3, 10},
                     "`--resolution`",
                     "A coarser grid misses whole cuts; a finer one needs more memory than there is."};
    Limit until{"time of a run", "s", {1e-6, 1e9}, "`--until`, `--t`", "30 years; programs last hours."};
    Limit uncertain_cases{"number of cases",
                          "",
                          {10, 100'000},
                          "`--uncertain`",
                          "Fewer say nothing of 1 in 20; more change no band by 0.5 %."};
    Limit turns{"turns to simulate",
                "",
                {1, 1e6},
                "`--turns`",
                "A minute of a fast spindle; longer is refused by time."};
    Limit program_time{"time of the program",
                       "s",
                       {-1e9, 1e9},
                       "`seek` of the page",
                       "Times before the start are the start."};
    Limit memory{"memory", "MB", {1, 1e9}, "`--memory`", "A petabyte at most."};
    Limit override_percent{"override",
                           "%",
                           {10, 300},
                           "`feed_percent`, `spindle_percent` of the page",
                           "As on a machine, and a little more."};
    Limit play_speed{"speed of the live clock",
                     "s/s",
                     {1e-6, 1000},
                     "`speed` of the page",
                     "Faster, no picture shows the cut; slower, the clock stands."};

    // The hand.
    Limit force_scale{"force scale",
                      "",
                      {1e-9, 1000},
                      "`force_scale`, also on the page",
                      "From a cut that is not felt at all to millinewtons that become newtons."};
    Limit friction{"coefficient of friction",
                   "",
                   {0, 10},
                   "`friction_static`, `friction_kinetic`, `--friction`, `--friction-kinetic`",
                   "Rubber on glass has about 3."};
    Limit surface_stiffness{"stiffness of a touched surface",
                            "N/mm",
                            {1e-3, 1000},
                            "`stiffness_n_per_mm` of `[haptics]`, `--stiffness` of feel",
                            "Arms keep 0.5 to 20 stable."};
    Limit probe_radius{
        "radius of the probe", "mm", {0, 100}, "`--probe-mm`", "0 is a point; a fist has 50 mm."};
    Limit servo_rate{"servo rate", "Hz", {100, 20'000}, "`--rate`", "Arms run at 1,000 to 10,000 Hz."};
    Limit arm_delay{"delay of the arm", "ms", {0, 20}, "`--delay`", "Beyond, no stiffness is stable."};
    Limit arm_scale{"scale of the arm's way",
                    "",
                    {1e-3, 1000},
                    "`--arm-scale`",
                    "From a thousandth of the hand's way to a thousand times."};
    Limit model_scale{"scale of a model", "", {1e-6, 1e6}, "`--scale`", "From a nanometre to a kilometre."};
    Limit noticeable_share{"noticeable share",
                           "",
                           {1e-4, 1},
                           "`force_magnitude`, `vibration_amplitude`, `vibration_frequency`, `pitch` of a "
                           "profile",
                           "People tell 1 % to 50 % apart; each knot of a finer table takes memory."};
    Limit noticeable_angle{"noticeable angle",
                           "deg",
                           {0.01, 90},
                           "`force_direction_deg`",
                           "People tell 10 to 40 degrees apart."};
    Limit noticeable_level{
        "noticeable level", "dB", {1e-3, 20}, "`sound_level_db`", "People tell 0.5 to 3 dB apart."};
    Limit force_floor{"least noticed force",
                      "N",
                      {1e-6, 10},
                      "`force_floor_n`, `vibration_floor_n`",
                      "Fingers notice about 0.01 N."};
    Limit table_error{"worst error of the force table",
                      "JND",
                      {0.1, 10},
                      "`jnd` of the page",
                      "A tenth of what anybody notices, to what everybody does."};

    // The sound.
    Limit distance_factor{"factor on distances",
                          "",
                          {1e-3, 1e6},
                          "`distance_factor`",
                          "A millimetre may count as a kilometre."};
    Limit reference_distance{"nearest distance",
                             "m",
                             {0.05, 100},
                             "`reference_distance_m`",
                             "An ear at the spindle, to the end of the hall."};
    Limit gain{"gain", "dB", {-120, 120}, "`gain_db`", "From silence to 1,000,000 times as loud."};
    Limit level{"level of a part of the sound",
                "dB",
                {-60, 60},
                "`cut_db`, `spindle_db`, `chips_db`, `room_db`",
                "A thousandth to a thousand times."};
    Limit recording_share{"share of a recording", "", {0, 1}, "`recording_share`", "A share of the power."};
    Limit sample_bits{"bits of a sample", "", {16, 32}, "`bits`", "16, 24 or 32."};
    Limit sample_rate{
        "sample rate", "Hz", {8000, 192'000}, "`--sample-rate` of rub", "What sound cards play."};

    // The touchable material.
    Limit material_width{"width of the image",
                         "mm",
                         {0.1, 1e5},
                         "`width_mm`, `--width-mm`",
                         "A grain of sand to a floor of 100 m."};
    Limit sheet_stiffness{"stiffness of the sheet",
                          "N/mm",
                          {1e-3, 1e6},
                          "`stiffness_n_per_mm` of a material, `--stiffness` of learn",
                          "From a metre to a nanometre of yield for a newton."};
    Limit sheet_viscosity{"viscosity of the sheet",
                          "N s/mm",
                          {0, 1e6},
                          "`viscosity_n_s_per_mm`, `--viscosity`",
                          "0 follows the finger; the largest takes days at the usual stiffness."};
    Limit optical_share{"optical share",
                        "",
                        {0, 1},
                        "`relief_slope`, `gloss`, `pile`; `--relief-slope`, `--gloss`, `--pile`",
                        "A share, or a slope of 45 degrees."};
    Limit roughness{"optical roughness",
                    "",
                    {0.05, 1},
                    "`roughness`, `--roughness`",
                    "A sharper highlight falls between the pixels."};
    Limit finger_speed{"speed of the finger",
                       "mm/s",
                       {1e-3, 1e5},
                       "`speed_mm_per_s`, SPEED of `--recording`",
                       "A tool on a drum reaches 100 m/s; slower than a micrometre a second is rest."};
    Limit finger_force{"force of the finger",
                       "N",
                       {1e-3, 1e4},
                       "`force_n` of a voice, FORCE of `--recording`",
                       "A tenth of a gram to a ton."};
    Limit stroke_force{"force of a stroke",
                       "N",
                       {-1e6, 1e6},
                       "`force_n` of strokes",
                       "More than any arm; beyond 1,000 N a sheet yields no more. 0 or less is no contact."};
    Limit stroke_time{
        "time of a stroke", "s", {0, 1e6}, "`t_s` of strokes", "Eleven days; strokes last seconds."};
    Limit voice_level{"level of a voice",
                      "dB",
                      {-200, 60},
                      "`level_db`",
                      "Of full scale: from below every recording to far above."};
    Limit model_rate{"sample rate of a voice",
                     "Hz",
                     {1000, 384'000},
                     "`sample_rate_hz` of a voice",
                     "What recorders write."};
    Limit learned_highpass{
        "high-pass", "Hz", {0, 1000}, "`--highpass`", "Beyond 1,000 Hz little of a friction sound is left."};
    Limit noted_highpass{
        "high-pass of the recordings", "Hz", {0, 1e5}, "`highpass_hz`", "Only noted; any recorder's."};
    Limit contact_radius{"radius of the contact",
                         "mm",
                         {1e-3, 1e4},
                         "`--radius-mm`",
                         "From the tip of a needle to far beyond any hand."};
    Limit frame_rate{
        "frames per second", "Hz", {0.01, 1e4}, "`--fps`", "A picture in 100 s to a fast camera."};
};

inline constexpr Limits kLimits;

// The rows of the table, in its order.
inline auto all_limits() {
    return std::bit_cast<std::array<Limit, sizeof(Limits) / sizeof(Limit)>>(kLimits);
}

}  // namespace tribo
