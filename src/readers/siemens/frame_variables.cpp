// SPDX-License-Identifier: MIT
// Frames as values: $P_UIFR[1]=CTRANS(X,1):CROT(Z,30), $P_PFRAME, $P_BFRAME, variables of the type FRAME, and
// their parts [X,TR]. Sinumerik 840D, Job Planning: Frames.
#include <cmath>

#include "base/math.hpp"
#include "readers/siemens/interpreter.hpp"

namespace tribo::readers::siemens {
namespace {

constexpr std::string_view kAxes = "XYZ";
constexpr Vec3 kNoScale{1, 1, 1};

// The angles of ROT that turn a frame so.
Vec3 angles_of(const motion::WorkFrame& frame) {
    const double c = math::hypot(frame.x.x, frame.x.y);
    return {math::atan2(frame.y.z, frame.z.z), math::atan2(-frame.x.z, c), math::atan2(frame.x.y, frame.x.x)};
}

std::size_t axis_of(const std::string& name) {
    return name.size() == 1 ? kAxes.find(name[0]) : std::string_view::npos;
}

// The work offset's G code of a number of $P_UIFR.
int code_of_offset(int number) {
    return number == 0 ? 500 : number <= 4 ? 53 + number : 500 + number;
}

}  // namespace

bool Interpreter::is_frame(const std::string& name) const {
    return name == "P_UIFR" || name == "P_PFRAME" || name == "P_BFRAME" || name == "P_UBFR" ||
           name == "P_CHBFR" || name == "P_CHBFRAME" || name == "P_IFRAME" || frame_variables_.contains(name);
}

// The frame of a name. The first index of $P_UIFR and $P_CHBFR is its number; `parts`: how many indices name
// the frame. Null: only the machine knows it.
motion::WorkFrame* Interpreter::frame_named(const std::string& name, const std::vector<Value>& index,
                                            std::size_t& parts) {
    parts = 0;
    if (name == "P_PFRAME") return &turned_;
    if (name == "P_IFRAME") return &offsets_[work_offset_];
    if (name == "P_BFRAME" || name == "P_UBFR") return &base_frame_;
    const bool is_base = name == "P_CHBFR" || name == "P_CHBFRAME";
    if (is_base || name == "P_UIFR") {
        const double* given = index.empty() ? nullptr : std::get_if<double>(&index[0]);
        parts = 1;
        if (given == nullptr || !(*given >= 0 && *given <= 99)) return nullptr;
        const int number = static_cast<int>(*given);
        if (!is_base) return &offsets_[code_of_offset(number)];
        return number == 0 ? &base_frame_ : nullptr;
    }
    const auto found = frame_variables_.find(name);
    return found == frame_variables_.end() ? nullptr : &found->second;
}

// The cursor is behind the '='.
Result<void> Interpreter::assign_frame(const std::string& name, const std::vector<Value>& index,
                                       std::size_t at, Cursor& in) {
    std::size_t parts = 0;
    motion::WorkFrame* frame = frame_named(name, index, parts);
    if (frame == nullptr) {
        return in.refuse(at, "the frame " + name.substr(0, 31) + " is not read",
                         "write $P_UIFR[1] for G54, $P_PFRAME, or TRANS and ROT");
    }
    if (index.size() <= parts) {
        Vec3 scale{1, 1, 1};
        const auto found = frame_formula(in, scale);
        if (!found) return std::unexpected(found.error());
        if (name == "P_PFRAME") {
            scale_ = scale;
        } else if (scale != kNoScale) {
            return in.refuse(at, "a scale or a mirror in the frame " + name.substr(0, 31) + " is not read",
                             "write them in $P_PFRAME, or SCALE and MIRROR in blocks of their own");
        }
        *frame = *found;
    } else if (auto done = set_frame_part(*frame, index, parts, at, in); !done) {
        return done;
    }
    if (frame == &turned_) absolute_shift_ = turned_.origin_mm;
    return frame_variables_.contains(name) ? Result<void>{} : set_frame(line_number());
}

// [X,TR]=1: a shift; FI: a fine shift, taken as one; RT: an angle; SC and MI of $P_PFRAME: scale and mirror.
Result<void> Interpreter::set_frame_part(motion::WorkFrame& frame, const std::vector<Value>& index,
                                         std::size_t first, std::size_t at, Cursor& in) {
    const auto value = Formula(in, variables_, *this).number();
    if (!value) return std::unexpected(value.error());
    const std::string part = first + 1 < index.size() ? text_of(index[first + 1]) : "TR";
    const std::size_t axis = axis_of(text_of(index[first]));
    const bool is_neutral = *value == (part == "SC" ? 1.0 : 0.0);
    if (axis <= 2 && &frame == &turned_ && (part == "SC" || part == "MI")) {
        double& scale = scale_[static_cast<int>(axis)];
        const double size = std::abs(scale);
        if (part == "MI") {
            scale = *value != 0 ? -size : size;
            return {};
        }
        scale /= size;
        return take_scale(scale, *value, place(static_cast<int>(at) + 1));
    }
    if (axis > 2 || (part != "TR" && part != "FI" && part != "RT")) {
        if (is_neutral) return {};
        return in.refuse(at, "this part of a frame is not read", "write TR or RT of X, Y or Z");
    }
    const int k = static_cast<int>(axis);
    const Limit& limit = part == "RT" ? kLimits.rotary_angle : kLimits.coordinate;
    const double amount = part == "RT" ? *value : *value * unit_mm_;
    if (auto good = path_.in_range(limit, amount, place(static_cast<int>(at) + 1)); !good) return good;
    if (part == "TR") frame.origin_mm[k] = amount;
    if (part != "RT") return {};
    Vec3 rad = angles_of(frame);
    rad[k] = amount * math::kRadPerDeg;
    frame = turned_by({frame.origin_mm}, rad);
    return {};
}

// CTRANS(X,1,Y,2):CROT(Z,30):$P_UIFR[2]:F1. `scale`: the factors of CSCALE and CMIRROR, within the frame.
Result<motion::WorkFrame> Interpreter::frame_formula(Cursor& in, Vec3& scale) {
    motion::WorkFrame frame;
    for (;;) {
        in.skip_blanks();
        const std::size_t at = in.at;
        while (in.peek() == '$') ++in.at;
        const std::string name = name_at(in);
        in.at += name.size();
        if (is_frame(name)) {
            const auto named = frame_value(name, at, in);
            if (!named) return named;
            if (scale != kNoScale) {
                return in.refuse(at, "a frame behind CSCALE or CMIRROR is not read", "write it before them");
            }
            frame = joined(frame, *named);
            if (name == "P_PFRAME") scale = scale_;
        } else {
            const auto call = call_at(in, name, at);
            if (!call) return std::unexpected(call.error());
            const auto next = frame_by_call(frame, scale, *call, at, in);
            if (!next) return next;
            frame = *next;
        }
        if (in.peek_after_blanks() != ':') return frame;
        ++in.at;
    }
}

// A frame in a formula, with the cursor behind its name.
Result<motion::WorkFrame> Interpreter::frame_value(const std::string& name, std::size_t at, Cursor& in) {
    std::vector<Value> index;
    if (in.peek_after_blanks() == '[') {
        ++in.at;
        auto found = Formula(in, variables_, *this).indices();
        if (!found) return std::unexpected(found.error());
        index = *std::move(found);
    }
    std::size_t parts = 0;
    const motion::WorkFrame* frame = frame_named(name, index, parts);
    if (frame == nullptr || index.size() > parts)
        return in.refuse(at, "this is no frame that the program knows", "write CTRANS and CROT");
    return *frame;
}

// `frame`, moved on by CTRANS(X,1,Y,2), CROT(Z,30), CRPL(0,30), CSCALE(X,2) or CMIRROR(X).
Result<motion::WorkFrame> Interpreter::frame_by_call(const motion::WorkFrame& frame, Vec3& scale,
                                                     const Call& call, std::size_t at, Cursor& in) {
    const Place where = place(static_cast<int>(at) + 1);
    if (call.name == "CRPL") {  // about the normal of a plane: 0 that of the block, 1 to 3 G17 to G19
        const auto plane = static_cast<int>(std::clamp(call.at(0), 0.0, 3.0));
        if (auto good = path_.in_range(kLimits.rotary_angle, call.at(1), where); !good)
            return std::unexpected(good.error());
        Vec3 rad;
        rad[plane == 0 ? axes()[2] : 3 - plane] = call.at(1) * math::kRadPerDeg;
        return turned_within(frame, scale, rad, where);
    }
    if (call.name == "CMIRROR") {
        for (std::size_t i = 0; i < call.given.size(); ++i) {
            const std::size_t k = axis_of(call.text(i));
            if (k > 2) return in.refuse(at, "a frame along an unknown axis", "write X, Y and Z");
            scale[static_cast<int>(k)] *= -1;
        }
        return frame;
    }
    if (call.name != "CTRANS" && call.name != "CROT" && call.name != "CFINE" && call.name != "CSCALE") {
        return in.refuse(at, "the frame '" + call.name.substr(0, 20) + "' is not read",
                         "write CTRANS, CROT, CSCALE and CMIRROR");
    }
    const bool scales = call.name == "CSCALE";
    const bool turns = call.name == "CROT";
    Vec3 values;
    for (std::size_t i = 0; i + 1 < call.given.size(); i += 2) {
        const std::size_t k = axis_of(call.text(i));
        if (k > 2) return in.refuse(at, "a frame along an unknown axis", "write X, Y and Z");
        if (scales) {
            if (auto done = take_scale(scale[static_cast<int>(k)], call.at(i + 1), where); !done)
                return std::unexpected(done.error());
            continue;
        }
        values[static_cast<int>(k)] = call.at(i + 1);
        const Limit& limit = turns ? kLimits.rotary_angle : kLimits.coordinate;
        if (auto good = path_.in_range(limit, call.at(i + 1), where); !good)
            return std::unexpected(good.error());
    }
    if (turns) return turned_within(frame, scale, values * math::kRadPerDeg, where);
    return frame.shifted(Vec3{scale.x * values.x, scale.y * values.y, scale.z * values.z} * unit_mm_);
}

}  // namespace tribo::readers::siemens
