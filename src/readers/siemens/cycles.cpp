// SPDX-License-Identifier: MIT
// Calls of cycles, MCALL, and patterns of positions. Sinumerik 840D, Programming Guide: Cycles.
#include <algorithm>
#include <array>
#include <cmath>

#include "base/math.hpp"
#include "readers/siemens/interpreter.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers::siemens {
namespace {

constexpr double kMostPlaces = 10'000;

struct RefusedCycle {
    std::string_view begin, what, remedy;
};
constexpr std::string_view kPlain = "let the CAM system write the path with G0 to G3";
// Names of cycles that are not read, by their beginnings.
constexpr RefusedCycle kRefusedCycles[] = {
    {"CYCLE64", "holes that the control places in a contour", "write CYCLE83 with MCALL at their places"},
    {"CYCLE78", "a thread with its hole", "write CYCLE83, and CYCLE70 for the thread"},
    {"CYCLE899", "a trochoidal slot that the control lays", kPlain},
    {"CYCLE93", "a cycle of a lathe", "only milling is read"},
    {"CYCLE94", "a cycle of a lathe", "only milling is read"},
    {"CYCLE95", "a cycle of a lathe", "only milling is read"},
    {"CYCLE96", "a cycle of a lathe", "only milling is read"},
};

// Measuring cycles of parts and tools: CYCLE97x, 982, 994 to 998.
bool is_probing(std::string_view name) {
    if (name.size() != 8 || !name.starts_with("CYCLE9")) return false;
    return name[6] == '7' || name == "CYCLE982" || (name[6] == '9' && name[7] >= '4' && name[7] <= '8');
}

}  // namespace

// Runs the call if it is that of a cycle of the control; else returns false.
Result<bool> Interpreter::run_cycle(const Call& call) {
    const std::string& name = call.name;
    const auto ran = [](Result<void> done) -> Result<bool> {
        if (!done) return std::unexpected(done.error());
        return true;
    };
    if (text_.unit_named(name) != nullptr) return false;
    if (name == "CYCLE800") return ran(swivel(call));
    if (name == "WORKPIECE") return ran(declare_stock(call));
    constexpr std::string_view drilling[] = {"CYCLE81", "CYCLE82", "CYCLE83", "CYCLE84", "CYCLE85",
                                             "CYCLE86", "CYCLE87", "CYCLE88", "CYCLE89", "CYCLE840"};
    if (std::find(std::begin(drilling), std::end(drilling), name) != std::end(drilling)) {
        const auto ready = prepare_cycle(call);
        if (!ready) return std::unexpected(ready.error());
        return *ready ? ran(drill(call)) : Result<bool>(true);
    }
    if (name == "CYCLE62") return ran(choose_contour(call));
    if (captured_ && (is_milling_cycle(name) || name == "CYCLE72" || name == "CYCLE63")) {
        return path_.refuse({call.line, call.column}, name + " within a contour",
                            "write it behind the contour");
    }
    if (name == "CYCLE72") return ran(mill_contour(call));
    if (name == "CYCLE63") return ran(mill_contour_pocket(call));
    if (is_milling_cycle(name)) return ran(run_milling_cycle(call));
    if (name == "HOLES1" || name == "HOLES2" || name == "CYCLE801" || name == "CYCLE802") {
        return ran(run_pattern(call));
    }
    const Place where{call.line, call.column};
    const bool probes = is_probing(name);
    if (probes || name == "CYCLE60") {
        if (auto done = close_contour(); !done) return std::unexpected(done.error());
        contour_.leave();
        path_.lose(line_number());
        const std::string what = probes ? "the touch probe's moves" : "letters of the control's own";
        if (passed_over_.insert(what).second) {
            path_.warn(line_number(),
                       what + " (" + name + ") are left out, and the tool's place is unknown after them");
        }
        return true;
    }
    for (const RefusedCycle& refused : kRefusedCycles) {
        if (!name.starts_with(refused.begin)) continue;
        return path_.refuse(where, name + " (" + std::string(refused.what) + ") is not read",
                            std::string(refused.remedy));
    }
    for (const std::string_view begin : {"CYCLE", "POCKET", "SLOT", "LONGHOLE"}) {
        if (!name.starts_with(begin)) continue;
        return path_.refuse(where, name.substr(0, 20) + " is not read", std::string(kPlain));
    }
    return false;
}

// MCALL NAME(...): the call runs at the end of each following block that moves. MCALL alone ends it.
Result<void> Interpreter::set_modal(Cursor& in) {
    modal_.reset();
    if (in.at_end()) return {};
    const std::size_t at = in.at;
    const std::string name = name_at(in);
    if (name.empty())
        return in.refuse(at, "MCALL without the name of a cycle", "write for example MCALL CYCLE81(...)");
    in.at += name.size();
    auto call = call_at(in, name, at);
    if (!call) return std::unexpected(call.error());
    modal_ = *std::move(call);
    return {};
}

Result<void> Interpreter::run_modal() {
    if ((!modal_ && old_cycle_ == 0) || runs_modal_) return {};
    runs_modal_ = true;
    Call call;
    if (modal_) {
        call = *modal_;
    } else {  // G81 and G82 of the Sinumerik 8xx: R10, R2, R3 and R4 as RTP, RFP, DP and DTB
        call.name = "CYCLE" + std::to_string(old_cycle_);
        call.given.resize(6);
        call.given[0] = variables_.r(10);
        call.given[1] = variables_.r(2);
        call.given[3] = variables_.r(3);
        call.given[5] = variables_.r(4);
        call.line = line_number();
        call.column = 1;
    }
    auto done = run_call(call);
    runs_modal_ = false;
    return done;
}

// Before a cycle: the tool stands at a known place. Returns false if only the machine knows it.
Result<bool> Interpreter::prepare_cycle(const Call& call) {
    if (auto done = close_contour(); !done) return std::unexpected(done.error());
    contour_.leave();
    const auto [u, v, w] = axes();
    if (path_.knows_tip()) return true;
    if (path_.known(u) == Known::yes && path_.known(v) == Known::yes) {
        // The cycle begins at its return plane.
        Vec3 tip = path_.tip();
        tip[w] = scale_[w] * call.at(0) * unit_mm_;
        path_.put(tip, {Known::yes, Known::yes, Known::yes}, line_number());
        return true;
    }
    assume_start();
    if (path_.knows_tip()) return true;
    if (left_out_++ == 0) left_out_line_ = line_number();
    return false;
}

// Runs the modal call at each point, given in the coordinates of the program in the plane.
Result<void> Interpreter::run_at(const std::vector<Vec3>& points, const Call& call) {
    const auto [u, v, w] = axes();
    for (const Vec3& point : points) {
        Vec3 to = path_.tip();
        to[u] = scale_[u] * point.x;
        to[v] = scale_[v] * point.y;
        for (const int k : {u, v}) {
            if (auto good = path_.in_range(kLimits.coordinate, to[k], {call.line, call.column}); !good)
                return good;
        }
        if (path_.knows_tip()) {
            if (auto done = go(true, to, {}, path_.rotary_rad()); !done) return done;
        } else {
            std::array<Known, 3> known{path_.known(0), path_.known(1), path_.known(2)};
            known[static_cast<std::size_t>(u)] = known[static_cast<std::size_t>(v)] = Known::yes;
            path_.put(to, known, line_number());
        }
        if (auto done = run_modal(); !done) return done;
        if (ended_) return {};
    }
    return {};
}

// HOLES1(SPCA, SPCO, STA1, FDIS, DBH, NUM): a row. HOLES2(CPA, CPO, RAD, STA1, INDA, NUM): a circle.
// CYCLE801(SPCA, SPCO, STA, DIS1, DIS2, NUM1, NUM2): a grid. CYCLE802(.., .., X0, Y0, X1, Y1 ...): places.
Result<void> Interpreter::run_pattern(const Call& call) {
    const Place where{call.line, call.column};
    if (!modal_) {
        return path_.refuse(where, call.name + " without MCALL before it", "write MCALL with the cycle");
    }
    if (auto done = close_contour(); !done) return done;
    contour_.leave();
    const auto mm = [&](std::size_t i) { return call.at(i) * unit_mm_; };
    const auto count = [&](std::size_t i) {
        return static_cast<int>(std::clamp(call.at(i), -1.0, kMostPlaces + 1));
    };
    const Vec3 first{mm(0), mm(1), 0};
    std::vector<Vec3> points;
    const auto refuse_count = [&] {
        return path_.refuse(where, call.name + " has no number of places from 1 to 10000", "correct it");
    };
    const auto along = [](double deg) {
        return Vec3{math::cos(deg * math::kRadPerDeg), math::sin(deg * math::kRadPerDeg), 0};
    };
    if (call.name == "HOLES1") {
        const int number = count(5);
        if (number < 1 || number > kMostPlaces) return refuse_count();
        for (int i = 0; i < number; ++i) points.push_back(first + (mm(3) + i * mm(4)) * along(call.at(2)));
        // The cycle begins at the end of the row that is nearer.
        const Vec3 here = to_plane(from_frame(path_.tip()));
        const auto apart = [&](Vec3 p) { return math::hypot(p.x - here.x, p.y - here.y); };
        if (path_.knows_tip() && apart(points.back()) < apart(points.front())) {
            std::reverse(points.begin(), points.end());
        }
    } else if (call.name == "HOLES2") {
        const int number = count(5);
        if (number < 1 || number > kMostPlaces) return refuse_count();
        const double step = call.at(4) != 0 ? call.at(4) : 360.0 / number;
        if (!(std::abs(step) <= 1e5) || !(std::abs(call.at(3)) <= 1e5)) {
            return path_.refuse(where, "an angle of HOLES2 is out of range", "correct it");
        }
        for (int i = 0; i < number; ++i) points.push_back(first + mm(2) * along(call.at(3) + i * step));
    } else if (call.name == "CYCLE801") {
        const int columns = count(5), rows = count(6);
        if (columns < 1 || rows < 1 || columns * rows > kMostPlaces) return refuse_count();
        const Vec3 x = along(call.at(2)), y{-x.y, x.x, 0};
        for (int row = 0; row < rows; ++row) {
            for (int i = 0; i < columns; ++i) {
                const int column = row % 2 == 0 ? i : columns - 1 - i;
                points.push_back(first + column * mm(3) * x + row * mm(4) * y);
            }
        }
    } else {
        for (std::size_t i = 2; i + 1 < call.given.size() && i < 20; i += 2) {
            if (call.has(i) && call.has(i + 1)) points.push_back({mm(i), mm(i + 1), 0});
        }
    }
    return run_at(points, call);
}

}  // namespace tribo::readers::siemens
