// SPDX-License-Identifier: MIT
// The words of one block, sorted but not yet applied.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "readers/siemens/variables.hpp"

namespace tribo::readers::siemens {

// How a coordinate counts: as G90 or G91 say, or as AC( IC( DC( ACP( ACN( around it say.
enum class Measure { modal, absolute, incremental, shortest, positive, negative };

// The value of an address, as written.
struct Amount {
    double value = 0;
    Measure measure = Measure::modal;
    int column = 0;
};

// A G or M code.
struct Code {
    int number = 0;
    int column = 0;
};

// A call with what stands in its parentheses; an empty place is none.
struct Call {
    std::string name;
    std::vector<std::optional<Value>> given;
    std::vector<std::string> names;  // of the variables given, for VAR parameters; else empty
    int line = 0, column = 0;
    long times = 1;         // P
    bool has_list = false;  // parentheses behind the name

    bool has(std::size_t i) const { return i < given.size() && given[i].has_value(); }
    // The number at a place, counted from 0; `otherwise` where there is none.
    double at(std::size_t i, double otherwise = 0) const {
        const double* number = has(i) ? std::get_if<double>(&*given[i]) : nullptr;
        return number != nullptr && std::isfinite(*number) ? *number : otherwise;
    }
    std::string text(std::size_t i) const {
        const std::string* text = has(i) ? std::get_if<std::string>(&*given[i]) : nullptr;
        return text != nullptr ? *text : "";
    }
};

// The path functions with names, which stay in force as G0 to G3 do.
enum class Motion {
    rapid,
    line,
    clockwise,
    counter_clockwise,
    through_point,
    tangent,
    bspline,
    akima,  // ASPLINE
    cubic,  // CSPLINE
    poly
};

struct Words {
    std::array<std::optional<Amount>, 3> linear, rotary;   // X Y Z, A B C
    std::array<std::optional<Amount>, 3> parallel;         // U V W
    std::array<std::optional<Amount>, 3> centre, through;  // I J K, I1 J1 K1
    std::array<std::optional<double>, 3> vector;           // A3 B3 C3
    std::array<std::optional<double>, 3> angle;            // A2 B2 C2, deg
    std::array<std::vector<double>, 3> polynomial;         // PO[X]=(end,a2,a3): without the end
    std::optional<Amount> polar_radius, polar_angle;       // RP, AP
    std::optional<double> radius, opening, turns;          // CR, AR, TURN
    std::optional<double> rounding, chamfer, chamfer_leg;  // RND, CHF, CHR
    std::optional<double> direction;                       // ANG
    std::optional<double> plane_turn;                      // RPL
    std::optional<double> weight, knot_step, degree;       // PW, PL, SD
    std::optional<Amount> feed, block_feed, tooth_feed;    // F, FB, FZ
    std::optional<Amount> spindle;
    std::optional<double> tool;
    std::optional<Motion> motion;
    std::vector<Code> g, m;
    std::string frame;       // TRANS, AROT, G58 ...; empty: none
    std::string tool_frame;  // TOROT, TOFRAME, TOROTOF ...; empty: none
    std::optional<bool> tip_control;
    std::optional<Call> cylinder;  // TRACYL
    bool is_polar = false;         // TRANSMIT
    bool machine_place = false;    // SUPA, G53, G153
    bool is_home = false;          // G74, G75
    bool positions = false;        // POS[X]=: a rapid of its own
    std::optional<Call> call;
    std::optional<long> times;  // P
    int first_column = 1;

    bool has_linear() const { return linear[0] || linear[1] || linear[2]; }
    bool has_parallel() const { return parallel[0] || parallel[1] || parallel[2]; }
    bool has_rotary() const { return rotary[0] || rotary[1] || rotary[2]; }
    bool has_vector() const { return vector[0] || vector[1] || vector[2]; }
    bool has_angle() const { return angle[0] || angle[1] || angle[2]; }
    bool has_polar() const { return polar_radius || polar_angle; }
    bool has_centre() const { return centre[0] || centre[1] || centre[2]; }
    bool moves() const {
        return has_linear() || has_parallel() || has_rotary() || has_vector() || has_angle() || has_polar() ||
               has_centre() || opening || turns || direction;
    }
};

}  // namespace tribo::readers::siemens
