// SPDX-License-Identifier: MIT
// Words of programs in G-code, Siemens, Heidenhain and APT, and columns of tables.
#include "app/limits/doors.hpp"
#include "job/loader.hpp"
#include "job/memory_source.hpp"
#include "motion/machine/machine.hpp"
#include "readers/apt/reader.hpp"
#include "readers/gcode/reader.hpp"
#include "readers/heidenhain/reader.hpp"
#include "readers/response/frequency_response.hpp"
#include "readers/tables/keyframes_csv.hpp"
#include "readers/tables/stroke_csv.hpp"
#include "readers/tables/tool_table.hpp"

namespace tribo::test {
namespace {

template <class Read>
std::string error_of(const Read& read) {
    return read ? "" : read.error().text();
}

// A reader with the text around the value.
template <class Read>
Door door(const Limit& limit, const char* control, const std::string& before, const std::string& after,
          const Read& read, double scale = 1) {
    return {&limit, std::string(control) + ": " + before,
            [=](double value) { return error_of(read(before + written(value * scale) + after)); }};
}

readers::GcodeOptions on_five_axes() {
    static const motion::Machine machine = *motion::named_machine("xyzac-trt");
    readers::GcodeOptions options;
    options.machine = &machine;
    return options;
}

Door gcode(const Limit& limit, const std::string& before, const std::string& after = "\n", double scale = 1) {
    const std::string ready = "G21 G90 G0 X0 Y0 Z0\nM3 S1000\n";
    const auto read = [](const std::string& text) { return readers::read_gcode(text); };
    return door(limit, "G-code", ready + before, after, read, scale);
}

Door fanuc(const Limit& limit, const std::string& before) {
    const auto read = [](const std::string& text) {
        readers::GcodeOptions options;
        options.dialect = readers::GcodeDialect::fanuc;
        return readers::read_gcode(text, options);
    };
    return door(limit, "Fanuc", "G21 G90 G0 X0 Y0 Z0\n" + before, "\n", read);
}

Door heidenhain(const Limit& limit, const std::string& before, const std::string& after = "\n",
                double scale = 1) {
    const std::string ready = "0 BEGIN PGM P MM\n1 TOOL CALL 1 Z S2000 F500\n2 L X+0 Y+0 Z+10 R0 FMAX M3\n";
    const auto read = [](const std::string& text) { return readers::read_heidenhain(text, on_five_axes()); };
    return door(limit, "Heidenhain", ready + before, after, read, scale);
}

Door apt(const Limit& limit, const std::string& before, const std::string& after = "\n") {
    const auto read = [](const std::string& text) { return readers::read_apt(text); };
    return door(limit, "APT", "UNITS/MM\nFEDRAT/100,MMPM\nFROM/0,0,0\n" + before, after, read);
}

// Through the loader, which knows the control by the words of the program.
Door siemens(const Limit& limit, const std::string& before) {
    return {&limit, "Siemens: " + before, [=](double value) {
                const std::string text = "G71 G90 G0 X=10 Y=0 Z=5\nS1000 M3\nCYCLE800()\n" + before +
                                         written(value) + "\nG1 X20 F200\nM30\n";
                job::LoadOptions options;  // a block around the path has limits of its own
                options.program.stock = {{}, job::JobSolid{{{0, 0, 0}, {10, 10, 10}}, {}}};
                return error_of(job::load_job(job::MemorySource({{"p.mpf", text}}), "p.mpf", options));
            }};
}

// A blank of the program with an edge of this length.
Door blank_form() {
    return {&kLimits.edge, "BLK FORM", [](double value) {
                const std::string text =
                    "0 BEGIN PGM P MM\n1 BLK FORM 0.1 Z X+0 Y+0 Z+0\n2 BLK FORM 0.2 X+10 Y+" +
                    written(value) +
                    " Z+10\n3 TOOL CALL 1 Z S2000 F500\n4 L X+0 Y+0 Z+10 R0 FMAX M3\n"
                    "5 L X+10 F200\n6 END PGM P MM\n";
                return error_of(job::load_job(job::MemorySource({{"p.h", text}}), "p.h"));
            }};
}

Door keyframes(const Limit& limit, const std::string& before, const std::string& after) {
    const auto read = [](const std::string& text) { return readers::read_keyframes(text); };
    return door(limit, "keyframes", "x,y,z,i,j,k,weight,feed_mm_per_min\n0,0,0,0,0,1,1,100\n" + before, after,
                read);
}

Door probe_stroke(const Limit& limit, const std::string& before, const std::string& after) {
    const auto read = [](const std::string& text) { return readers::read_probe_stroke(text); };
    return door(limit, "stroke", "t_s,x_mm,y_mm,z_mm\n0,0,0,0\n" + before, after, read);
}

Door finger_stroke(const Limit& limit, const std::string& before, const std::string& after) {
    const auto read = [](const std::string& text) { return readers::read_finger_stroke(text); };
    return door(limit, "stroke", "t_s,x_mm,y_mm,force_n\n0,0,0,0\n" + before, after, read);
}

Door response(const Limit& limit, const std::string& before, const std::string& after) {
    const auto read = [](const std::string& text) { return readers::read_frequency_response(text); };
    return door(limit, "response", "frequency_hz,re_mm_per_n,im_mm_per_n\n1,0,0\n" + before, after, read);
}

Door tools(const Limit& limit, const std::string& before, const std::string& after) {
    const auto read = [](const std::string& text) { return readers::read_tool_table(text); };
    return door(limit, "tool table", before, after, read);
}

}  // namespace

Doors program_doors() {
    const Limits& l = kLimits;
    const std::string cycle = "G98 G82 X1 Y1 Z-1 R1 F100 P", spline = "G1 F100\nG5.2 X1 Y1 L3 P";
    Doors doors{
        gcode(l.coordinate, "G0 X"),
        gcode(l.coordinate, "G0 Y"),
        gcode(l.coordinate, "G0 Z"),
        gcode(l.coordinate, "G92 X"),
        gcode(l.coordinate, "G52 X"),
        gcode(l.coordinate, "G1 F100\nG2 X0 Y0 I"),
        gcode(l.coordinate, "G1 F100\nG3 X0 Y0 J"),
        gcode(l.coordinate, "G18 G1 F100\nG2 X0 Z0 K"),
        gcode(l.coordinate, "G1 F100\nG90.1 G2 X0 Y0 J0 I"),
        gcode(l.coordinate, "G1 F100\nG2 X1 Y0 R"),
        fanuc(l.coordinate, "#5221="),
        gcode(l.feed, "G94 F"),
        gcode(l.feed_per_turn, "G95 F"),
        gcode(l.inverse_time, "G93 G1 X1 F"),
        gcode(l.spindle_speed, "S"),
        gcode(l.dwell, "G4 P"),
        gcode(l.dwell, "G4 S"),
        gcode(l.rotary_angle, "G68 X0 Y0 R"),
        gcode(l.rotary_angle, "G16\nG0 X1 Y"),
        gcode(l.dwell, cycle),
        gcode(l.tool_number, "T"),
        gcode(l.offset_diameter, "G1 F100\nG41.1 D"),
        gcode(l.offset_diameter, "G10 L1 P1 R", "\n", 0.5),
        gcode(l.weight, spline, "\nX2 Y0\nX3 Y1\nG5.3\n"),
        siemens(l.feed, "G94 F"),
        siemens(l.spindle_speed, "S="),
        siemens(l.coordinate, "G0 X="),
        heidenhain(l.coordinate, "3 L X", " FMAX\n"),
        heidenhain(l.coordinate, "3 CC X+0 Y+0\n4 LP PA+0 PR", " FMAX\n"),
        heidenhain(l.rotary_angle, "3 L A", " FMAX\n"),
        heidenhain(l.rotary_angle, "3 CC X+0 Y+0\n4 LP PR+1 PA", " FMAX\n"),
        heidenhain(l.feed, "3 L X+1 F"),
        heidenhain(l.feed, "3 TOOL CALL 1 Z S1000 F"),
        heidenhain(l.feed, "3 CYCL DEF 200 Q200=+1 Q201=-1 Q202=+1 Q203=+0 Q206=", "\n4 CYCL CALL M3\n"),
        heidenhain(l.spindle_speed, "3 TOOL CALL 1 Z F100 S"),
        heidenhain(l.tool_number, "3 TOOL CALL ", " Z S1000\n"),
        heidenhain(l.dwell, "3 CYCL DEF 9.0 DWELL TIME\n4 CYCL DEF 9.1 DWELL "),
        heidenhain(l.cutter_diameter, "3 TOOL DEF 1 L+0 R", "\n", 0.5),
        heidenhain(l.tool_length, "3 TOOL DEF 1 R+5 L"),
        apt(l.coordinate, "GOTO/", ",0,0\n"),
        apt(l.direction, "GOTO/1,2,3,0,1,"),
        apt(l.feed, "FEDRAT/", ",MMPM\n"),
        apt(l.feed, "CYCLE/DRILL,FEDTO,1,RAPTO,1,MMPM,"),
        apt(l.feed_per_turn, "FEDRAT/", ",MMPR\n"),
        apt(l.spindle_speed, "SPINDL/", ",RPM,CLW\n"),
        apt(l.tool_number, "LOADTL/"),
        apt(l.cutter_diameter, "CUTTER/"),
        apt(l.dwell, "DELAY/"),
        apt(l.dwell, "CYCLE/DRILL,FEDTO,1,RAPTO,1,MMPM,100,DWELL,"),
        blank_form(),
    };
    for (const char letter : {'A', 'C'}) {
        const auto read = [](const std::string& text) { return readers::read_gcode(text, on_five_axes()); };
        doors.push_back(
            door(l.rotary_angle, "G-code", std::string("G21 G0 X0 Y0 Z0\nG0 ") + letter, "\n", read));
    }
    return doors;
}

Doors table_doors() {
    const Limits& l = kLimits;
    return {
        keyframes(l.coordinate, "", ",1,1,0,0,1,1,100\n"),
        keyframes(l.coordinate, "1,", ",1,0,0,1,1,100\n"),
        keyframes(l.direction, "1,1,1,", ",0,1,1,100\n"),
        keyframes(l.weight, "1,1,1,0,0,1,", ",100\n"),
        keyframes(l.feed, "1,1,1,0,0,1,1,", "\n"),
        probe_stroke(l.coordinate, "1,", ",0,0\n"),
        probe_stroke(l.coordinate, "1,0,0,", "\n"),
        finger_stroke(l.coordinate, "1,0,", ",0\n"),
        finger_stroke(l.stroke_force, "1,0,0,", "\n"),
        {&l.stroke_time, "t_s",
         [](double value) {
             const std::string first = written(value <= 0 ? value : 0),
                               last = written(value <= 0 ? 1 : value);
             return error_of(
                 readers::read_probe_stroke("t_s,x_mm,y_mm,z_mm\n" + first + ",0,0,0\n" + last + ",0,0,0\n"));
         }},
        {&l.response_frequency, "frequency_hz",
         [](double value) {
             const bool is_low = value < 1;
             return error_of(readers::read_frequency_response("frequency_hz,re_mm_per_n,im_mm_per_n\n" +
                                                              written(is_low ? value : 1) + ",0,0\n" +
                                                              written(is_low ? 1 : value) + ",0,0\n"));
         }},
        response(l.receptance, "2,", ",0\n"),
        response(l.receptance, "2,0,", "\n"),
        tools(l.tool_number, "T", " D6\n"),
        tools(l.tool_number, "number,diameter_mm\n", ",6\n"),
        tools(l.cutter_diameter, "T1 D", "\n"),
        tools(l.cutter_diameter, "number,diameter_mm\n1,", "\n"),
        tools(l.corner_radius, "number,diameter_mm,corner_mm\n1,1000,", "\n"),
        tools(l.flutes, "number,diameter_mm,flutes\n1,6,", "\n"),
        tools(l.tool_length, "T1 D6 Z", "\n"),
        tools(l.tool_length, "number,diameter_mm,length_mm\n1,6,", "\n"),
    };
}

}  // namespace tribo::test
