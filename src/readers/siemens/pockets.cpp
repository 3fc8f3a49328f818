// SPDX-License-Identifier: MIT
// Milling cycles: POCKET1 to POCKET4, SLOT1, SLOT2, LONGHOLE, CYCLE61, CYCLE71, CYCLE76 and CYCLE77. Where
// the manual leaves the way of the tool to the control, rings and lines are taken, with a warning.
#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "readers/control/face.hpp"
#include "readers/siemens/interpreter.hpp"

namespace tribo::readers::siemens {
namespace {

constexpr double kMostPasses = 10'000;
constexpr double kSameMm = 1e-6;
constexpr double kMostSides = 1000;
constexpr double kUsualStep = 0.8;  // of the tool's diameter, from ring to ring

// The places of the parameters of a pocket or slot.
constexpr std::size_t kNone = kNoParameter;
struct Layout {
    std::string_view name;
    std::size_t increment, count, length, width, radius, centre_u, centre_v, from_centre, angle, step_angle,
        infeed, allowance, floor_allowance, feed, plunge, direction, kind, step, mode;
};
constexpr Layout kLayouts[] = {
    {"POCKET1", 4, kNone, 5, 6, 7, 8, 9, kNone, 10, kNone, 13, 15, kNone, 12, 11, 14, 16, kNone, kNone},
    {"POCKET2", 4,  kNone, kNone, kNone, 5, 6,  7,  kNone, kNone,
     kNone,     10, 12,    kNone, 9,     8, 11, 13, kNone, kNone},
    {"POCKET3", kNone, kNone, 4, 5, 6, 7, 8, kNone, 9, kNone, 10, 11, 12, 13, 14, 15, 16, 17, 28},
    {"POCKET4", kNone, kNone, kNone, kNone, 4, 5, 6, kNone, kNone, kNone, 7, 8, 9, 10, 11, 12, 13, 14, 24},
    {"SLOT1", 4, 5, 6, 7, kNone, 8, 9, 10, 11, 12, 15, 17, kNone, 14, 13, 16, 18, kNone, kNone},
    // AFSL, the angle of the slot, stands where SLOT1 has its length.
    {"SLOT2", 4, 5, kNone, 7, kNone, 8, 9, kNone, 11, 12, 15, 17, kNone, 14, 13, 16, 18, kNone, kNone},
    {"LONGHOLE", 4,  5,     6,     kNone, kNone, 7,     8,     9,     10,
     11,         14, kNone, kNone, 13,    12,    kNone, kNone, kNone, kNone},
    // Studs; the sizes of the blank follow VARI.
    {"CYCLE76", 4, kNone, 5, 6, 7, 8, 9, kNone, 10, kNone, 11, 12, 13, 14, 15, 16, 17, kNone, kNone},
    {"CYCLE77", 4, kNone, kNone, kNone, 5, 6, 7, kNone, kNone, kNone, 8, 9, 10, 11, 12, 13, 14, kNone, kNone},
};

}  // namespace

bool Interpreter::is_milling_cycle(const std::string& name) {
    return name == "CYCLE90" || name == "CYCLE70" || name == "CYCLE79" || name == "CYCLE71" ||
           name == "CYCLE61" ||
           std::any_of(std::begin(kLayouts), std::end(kLayouts),
                       [&](const Layout& known) { return known.name == name; });
}

// Moves in the plane and along the tool; `to` in its coordinates. No feed: a rapid.
Result<void> Interpreter::mill_to(Vec3 to, std::optional<double> feed,
                                  const std::optional<motion::Arc>& arc) {
    for (int k = 0; k < 3; ++k) {
        if (auto good = path_.in_range(kLimits.coordinate, to[k], place(1)); !good) return good;
    }
    std::optional<motion::Arc> turned = arc;
    if (turned) {
        turned->centre_mm = from_plane(arc->centre_mm);
        turned->normal = from_plane(arc->normal);
    }
    const auto before = path_.feed_mm_per_min;
    if (feed) path_.feed_mm_per_min = feed;
    auto done = go(!feed, from_plane(to), turned, path_.rotary_rad());
    path_.feed_mm_per_min = before;
    return done;
}

control::PocketMove Interpreter::mover() {
    return [this](Vec3 to, std::optional<double> feed, const std::optional<motion::Arc>& arc) {
        return mill_to(to, feed, arc);
    };
}

Result<Interpreter::Depths> Interpreter::depths_of(const Call& call, std::size_t increment,
                                                   std::size_t mode) const {
    const Place where{call.line, call.column};
    const double scale = scale_[axes()[2]] * unit_mm_;
    Depths depths;
    depths.back = call.at(0) * scale;
    depths.top = call.at(1) * scale;
    depths.near = depths.top + std::abs(call.at(2)) * scale;
    const bool by_increment = call.at(increment) != 0;
    const bool is_relative = static_cast<int>(std::clamp(call.at(mode), 0.0, 1e6)) % 10 == 1;
    depths.bottom = by_increment  ? depths.top - std::abs(call.at(increment)) * scale
                    : is_relative ? depths.top - std::abs(call.at(3)) * scale
                                  : call.at(3) * scale;
    for (const double z : {depths.back, depths.top, depths.near, depths.bottom}) {
        if (auto good = path_.in_range(kLimits.coordinate, z, where); !good)
            return std::unexpected(good.error());
    }
    const bool has_depth = by_increment || call.has(3);
    if (scale < 0 || !has_depth || !(depths.bottom < depths.top) || depths.back < depths.top) {
        return path_.refuse(where, call.name + ": the depth is not below RFP, or RTP is not above it",
                            "correct the cycle");
    }
    return depths;
}

// MIDA in mm, or in percent of the tool's diameter; 0: not given.
double Interpreter::ring_step(const Call& call, std::size_t at, std::size_t mode, double radius) const {
    const double step = std::abs(call.at(at));
    const bool is_percent = static_cast<int>(std::clamp(call.at(mode), 0.0, 1e6)) / 10 % 10 == 1;
    if (!is_percent) return step * std::abs(scale_[axes()[0]]) * unit_mm_;
    return std::min(step, 100.0) / 100 * 2 * radius;
}

Result<double> Interpreter::cycle_feed(const Call& call, std::size_t at) const {
    const double feed = call.at(at) > 0 ? call.at(at) * unit_mm_ : path_.feed_mm_per_min.value_or(0);
    const Place where{call.line, call.column};
    if (!(feed > 0)) return path_.refuse(where, call.name + " without a feed", "write F before it");
    if (auto good = path_.in_range(kLimits.feed, feed, where); !good) return std::unexpected(good.error());
    return feed;
}

void Interpreter::note_own_way(const std::string& cycle) {
    if (!path_.first(kPocket)) return;
    const bool is_stud = cycle == "CYCLE76" || cycle == "CYCLE77" || cycle == "CYCLE79";
    path_.warn(line_number(),
               "the way of the tool within " + cycle + " is the control's own: " +
                   (is_stud ? "rings from the outside inwards are taken"
                            : "rings from the inside outwards, and lines there and back, are taken"));
}

Result<void> Interpreter::run_milling_cycle(const Call& call) {
    const auto ready = prepare_cycle(call);
    if (!ready) return std::unexpected(ready.error());
    if (!*ready) return {};
    const auto [u, v, w] = axes();
    if (std::abs(scale_[u]) != std::abs(scale_[v]) || scale_[u] * scale_[v] < 0) {
        return path_.refuse({call.line, call.column}, call.name + " in a mirrored or unevenly scaled frame",
                            "end SCALE and MIRROR before it");
    }
    check_start(false);
    if (call.name == "CYCLE90") return mill_thread(call);
    if (call.name == "CYCLE70") return mill_thread_of_plate(call);
    note_own_way(call.name);
    if (call.name == "CYCLE79") return mill_polygon(call);
    if (call.name == "CYCLE71" || call.name == "CYCLE61") return mill_face(call);
    const Layout& at = *std::find_if(std::begin(kLayouts), std::end(kLayouts),
                                     [&](const Layout& known) { return known.name == call.name; });
    const Place where{call.line, call.column};
    const auto depths = depths_of(call, at.increment, at.mode);
    if (!depths) return std::unexpected(depths.error());
    const double scale = std::abs(scale_[u]) * unit_mm_;
    const auto size = [&](std::size_t i) { return std::abs(call.at(i)) * scale; };
    Pocket pocket;
    pocket.depths = *depths;
    if (at.floor_allowance != kNone) pocket.depths.bottom += size(at.floor_allowance);
    pocket.half_width = at.width == kNone ? size(at.radius) : size(at.width) / 2;
    pocket.half_length = at.length == kNone ? pocket.half_width : size(at.length) / 2;
    pocket.infeed = size(at.infeed);
    pocket.allowance = size(at.allowance);
    pocket.along_edge = static_cast<int>(std::clamp(call.at(at.kind), 0.0, 1e6)) % 10 == 2;
    if (pocket.along_edge) pocket.allowance = 0;
    const int direction = static_cast<int>(std::clamp(call.at(at.direction), 0.0, 9.0));
    pocket.clockwise =
        direction == 2 || (direction == 1 && at.width != kNone && !call.name.starts_with("SLOT"));
    const auto feed = cycle_feed(call, at.feed), plunge = cycle_feed(call, at.plunge);
    if (!feed) return std::unexpected(feed.error());
    if (!plunge) return std::unexpected(plunge.error());
    pocket.feed = *feed;
    pocket.plunge = *plunge;
    const bool is_stud = call.name == "CYCLE76" || call.name == "CYCLE77";
    const bool has_room = is_stud || call.name == "LONGHOLE";
    pocket.radius =
        path_.clearing_radius_mm(unit_mm_, line_number(), has_room ? control::kOpenMm : pocket.half_width);
    if (call.name == "LONGHOLE") pocket.half_width = pocket.radius;
    pocket.step = ring_step(call, at.step, at.mode, pocket.radius);
    pocket.corner = at.width == kNone || at.radius == kNone ? pocket.half_width
                                                            : std::min(size(at.radius), pocket.half_width);
    if (is_stud) {
        if (call.name == "CYCLE77") {  // PRAD is a diameter
            pocket.half_length = pocket.half_width = pocket.corner = size(at.radius) / 2;
        }
        const std::size_t blank = at.kind + 1;
        pocket.blank_half_length = std::max(size(blank) / 2, pocket.half_length);
        pocket.blank_half_width = call.name == "CYCLE76" ? std::max(size(blank + 1) / 2, pocket.half_width)
                                                         : pocket.blank_half_length;
        pocket.clockwise = direction == 2 || direction == 0;
    }
    if (at.length != kNone && pocket.half_length < pocket.half_width && at.radius == kNone) {
        return path_.refuse(where, call.name + ": the slot is shorter than wide", "correct LENG or WID");
    }
    const double most = pocket.half_width - pocket.radius - pocket.allowance;
    const bool fits = is_stud || std::min(pocket.half_length - pocket.radius, most) >= -kSameMm;
    if (!fits || !(pocket.half_length > 0) || !(pocket.half_width > 0)) {
        return path_.refuse(where, call.name + ": the tool does not fit into it", "take a smaller tool");
    }
    const Vec3 centre = centre_of(call, at.centre_u, at.centre_v);
    const double count = at.count == kNone ? 1 : std::floor(call.at(at.count));
    if (!(count >= 1 && count <= kMostPasses)) {
        return path_.refuse(where, call.name + " has no number of slots from 1 to 10000", "correct NUM");
    }
    if (call.name == "SLOT2") return mill_curved_slots(call, pocket, centre, count);
    const double step_angle = call.at(at.step_angle) != 0 ? call.at(at.step_angle) : 360 / count;
    for (const double deg : {call.at(at.angle), step_angle * count}) {
        if (auto good = path_.in_range(kLimits.rotary_angle, deg, where); !good) return good;
    }
    for (double i = 0; i < count; ++i) {
        pocket.angle_rad = (call.at(at.angle) + i * step_angle) * math::kRadPerDeg;
        const double out = at.from_centre == kNone ? 0 : size(at.from_centre) + pocket.half_length;
        pocket.centre = centre + out * Vec3{math::cos(pocket.angle_rad), math::sin(pocket.angle_rad), 0};
        if (auto done = mill_pocket(pocket, where); !done) return done;
    }
    return {};
}

// SLOT2(RTP, RFP, SDIS, DP, DPR, NUM, AFSL, WID, CPA, CPO, RAD, STA1, INDA, FFD, FFP1, MID, CDIR, FAL, VARI):
// slots on a circle. AFSL counts to the centres of their round ends.
Result<void> Interpreter::mill_curved_slots(const Call& call, const Pocket& pocket, Vec3 centre,
                                            double count) {
    const Place where{call.line, call.column};
    control::CurvedSlot slot;
    slot.pocket = pocket;
    slot.pocket.centre = centre;
    slot.arc_radius = std::abs(call.at(10)) * std::abs(scale_[axes()[0]]) * unit_mm_;
    slot.sweep_rad = std::abs(call.at(6)) * math::kRadPerDeg;
    const double step_deg = call.at(12) != 0 ? call.at(12) : 360 / count;
    if (!(slot.arc_radius > pocket.half_width) || !(slot.sweep_rad > 0) ||
        !(slot.sweep_rad <= math::kTwoPi)) {
        return path_.refuse(where, "SLOT2: the slot is no arc", "correct AFSL, RAD or WID");
    }
    for (const double deg : {call.at(11), step_deg * count}) {
        if (auto good = path_.in_range(kLimits.rotary_angle, deg, where); !good) return good;
    }
    if (control::ring_count(slot) > kMostPasses)
        return path_.refuse(where, "SLOT2 needs more than 10000 rings", "take a larger infeed");
    for (double i = 0; i < count; ++i) {
        slot.pocket.angle_rad = (call.at(11) + i * step_deg) * math::kRadPerDeg;
        if (auto done = control::mill_slot(slot, to_plane(path_.tip()), mover()); !done) return done;
    }
    return {};
}

Result<void> Interpreter::mill_pocket(const Pocket& pocket, Place where) {
    const bool is_stud = pocket.blank_half_length > 0;
    if ((is_stud ? control::stud_ring_count(pocket) : control::ring_count(pocket)) > kMostPasses) {
        return path_.refuse(where, "the pocket needs more than 10000 rings", "take a larger infeed");
    }
    const Vec3 from = to_plane(path_.tip());
    return is_stud ? control::mill_stud(pocket, from, mover()) : control::mill_pocket(pocket, from, mover());
}

// CYCLE79(RTP, RFP, SDIS, DP, NUM, SWL, PA, PO, STA, RC, AP1, MIDA, MID, FAL, FALD, FFP1, CDIR, VARI, FS,
// ZFS, GMODE, DMODE, AMODE): a stud with equal sides; SWL is the width across them.
Result<void> Interpreter::mill_polygon(const Call& call) {
    const Place where{call.line, call.column};
    auto depths = depths_of(call, kNone, 22);
    if (!depths) return std::unexpected(depths.error());
    const auto feed = cycle_feed(call, 15);
    if (!feed) return std::unexpected(feed.error());
    const double radius = path_.clearing_radius_mm(unit_mm_, where.line);
    const double sides = call.at(4), scale = std::abs(scale_[axes()[0]]) * unit_mm_;
    const int kind = static_cast<int>(std::clamp(call.at(17), 0.0, 1e6));
    const int mode = static_cast<int>(std::clamp(call.at(22), 0.0, 1e6));
    if (!(sides >= 3) || !(sides <= kMostSides) || sides != std::floor(sides) || !(call.at(5) > 0)) {
        return path_.refuse(where, "CYCLE79 has no number of sides from 3 to 1000, or no width",
                            "correct NUM and SWL");
    }
    if (kind % 10 == 5 || kind >= 10 || mode >= 100) {
        return path_.refuse(where, "CYCLE79 by the length of a side, or with chamfers, is not read",
                            "write the width across the sides and a radius");
    }
    if (auto good = path_.in_range(kLimits.rotary_angle, call.at(8), where); !good) return good;
    control::Polygon polygon;
    polygon.sides = static_cast<int>(sides);
    Pocket& stud = polygon.stud;
    stud.depths = *depths;
    stud.centre = centre_of(call, 6, 7);
    stud.half_length = stud.half_width = call.at(5) / 2 * scale;
    stud.angle_rad = call.at(8) * math::kRadPerDeg;
    stud.corner = std::abs(call.at(9)) * scale;
    stud.blank_half_width = std::abs(call.at(10)) / 2 * scale;
    stud.radius = radius;
    stud.step = ring_step(call, 11, 22, radius);
    stud.infeed = std::abs(call.at(12)) * scale;
    stud.along_edge = kind % 10 >= 2;
    if (!stud.along_edge) {
        stud.allowance = std::abs(call.at(13)) * scale;
        stud.depths.bottom += std::abs(call.at(14)) * scale;
    }
    stud.clockwise = call.at(16) != 1;
    stud.feed = stud.plunge = *feed;
    if (control::ring_count(polygon) > kMostPasses)
        return path_.refuse(where, "CYCLE79 needs more than 10000 rings", "take a larger infeed");
    return control::mill_polygon(polygon, to_plane(path_.tip()), mover());
}

// CYCLE71(RTP, RFP, SDIS, DP, PA, PO, LENG, WID, STA, MID, MIDA, FDP, FALD, FFP1, VARI, FDP1) and
// CYCLE61(RTP, RFP, SDIS, DP, PA, PO, LENG, WID, MID, MIDA, FALZ, FF1, VARI, ...): lines over a face.
Result<void> Interpreter::mill_face(const Call& call) {
    const bool is_old = call.name == "CYCLE71";
    const Place where{call.line, call.column};
    auto depths = depths_of(call, kNone, is_old ? kNone : 15);
    if (!depths) return std::unexpected(depths.error());
    const auto feed = cycle_feed(call, is_old ? 13 : 11);
    if (!feed) return std::unexpected(feed.error());
    const double radius = path_.clearing_radius_mm(unit_mm_, where.line);
    const double scale = scale_[axes()[0]] * unit_mm_;
    const int kind = static_cast<int>(std::clamp(call.at(is_old ? 14 : 12), 0.0, 99.0));
    const double angle = is_old ? call.at(8) : 0;
    if (auto good = path_.in_range(kLimits.rotary_angle, angle, where); !good) return good;
    control::Face face;
    face.depths = *depths;
    face.depths.bottom += kind % 10 == 2 ? 0 : std::abs(call.at(is_old ? 12 : 10)) * scale;
    face.infeed = kind % 10 == 2 ? 0 : std::abs(call.at(is_old ? 9 : 8)) * scale;
    face.corner = {call.at(4) * scale, call.at(5) * scale, 0};
    face.length = call.at(6) * scale;
    face.width = call.at(7) * scale;
    face.angle_rad = angle * math::kRadPerDeg;
    face.along_width = kind / 10 == 2 || kind / 10 == 4;
    face.step = ring_step(call, is_old ? 10 : 9, is_old ? kNone : 15, radius);
    if (!(face.step > 0)) face.step = kUsualStep * 2 * radius;
    face.over = face.start_over = radius + (is_old ? std::abs(call.at(15)) * scale : 0);
    face.feed = *feed;
    face.between = *feed;
    const double count = control::line_count(face);
    if (!(count >= 1 && count <= kMostPasses))
        return path_.refuse(where, call.name + " needs no lines, or more than 10000", "correct its infeeds");
    return control::mill_face(face, to_plane(path_.tip()), mover());
}

}  // namespace tribo::readers::siemens
