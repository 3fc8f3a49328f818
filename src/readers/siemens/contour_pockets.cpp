// SPDX-License-Identifier: MIT
// CYCLE63: pockets within the contours of CYCLE62, with islands. The way within them is the control's own.
#include <algorithm>
#include <cmath>

#include "readers/control/area_milling.hpp"
#include "readers/siemens/interpreter.hpp"

namespace tribo::readers::siemens {
namespace {

constexpr double kMostRings = 10'000;
constexpr std::size_t kMostElements = 1000;  // of all contours of a pocket

}  // namespace

// A contour that ends where it begins; none if its program is not at hand.
Result<std::optional<control::Ring>> Interpreter::closed_contour(const ContourName& name, const Call& call) {
    const Place where{call.line, call.column};
    const auto captured = capture_contour(name, call);
    if (!captured) return std::unexpected(captured.error());
    if (!*captured) return std::nullopt;
    const std::vector<ContourStep> steps = *std::move(captured_);
    captured_.reset();
    control::Contour contour;
    if (!steps.empty()) contour.open(steps[0].to, 0, 0, false);
    contour.add_steps(steps, 0, contour_words(false));
    auto ring = contour.elements(path_);
    if (!ring) return std::unexpected(ring.error());
    if (control::close_ring(*ring)) return *std::move(ring);
    return path_.refuse(where, "the contour of " + call.name + " is not closed", "end it where it begins");
}

// CYCLE63(PRG, VARI, RP, Z0, SC, Z1, F, FZ, DXY, DZ, UXY, UZ, CDIR, XS, YS, ER, EP, EW, FS, ZFS, TR, DR,
// UMODE, GMODE, DMODE, AMODE)
Result<void> Interpreter::mill_contour_pocket(const Call& named) {
    const Place where{named.line, named.column};
    contours_are_used_ = true;
    Call call = named;
    call.given.erase(
        call.given.begin(),
        call.given.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(2, call.given.size())));
    const auto ready = prepare_cycle(call);
    if (!ready) return std::unexpected(ready.error());
    if (!*ready) return {};
    const auto [u, v, w] = axes();
    if (std::abs(scale_[u]) != std::abs(scale_[v]) || scale_[u] * scale_[v] < 0) {
        return path_.refuse(where, "CYCLE63 in a mirrored or unevenly scaled frame",
                            "end SCALE and MIRROR before it");
    }
    const int kind = static_cast<int>(std::clamp(named.at(1), 0.0, 1e6)) % 10;
    if (kind == 5) return path_.refuse(where, "CYCLE63 for a chamfer is not read", "write CYCLE72");
    const auto depths = depths_of(call, kNoParameter, 23);
    if (!depths) return std::unexpected(depths.error());
    const auto feed = cycle_feed(call, 4), plunge = cycle_feed(call, 5);
    if (!feed) return std::unexpected(feed.error());
    if (!plunge) return std::unexpected(plunge.error());
    const double radius = path_.clearing_radius_mm(unit_mm_, where.line);
    const double scale = std::abs(scale_[u]) * unit_mm_;
    control::AreaMilling milling;
    milling.depths = *depths;
    milling.radius = radius;
    milling.step = ring_step(call, 6, 23, radius);
    milling.infeed = std::abs(call.at(7)) * scale;
    if (kind != 4) milling.allowance = std::abs(call.at(8)) * scale;
    if (kind != 3) milling.depths.bottom += std::abs(call.at(9)) * scale;
    if (kind == 3) milling.infeed = 0;  // the bottom alone
    milling.along_edge = kind == 4;
    milling.clockwise = call.at(10) == 1;
    milling.feed = *feed;
    milling.plunge = *plunge;
    std::vector<control::Ring> contours;
    std::size_t elements = 0;
    for (const ContourName& name : chosen_contours_) {
        auto ring = closed_contour(name, named);
        if (!ring) return std::unexpected(ring.error());
        if (!*ring) return {};
        elements += (*ring)->size();
        contours.push_back(**std::move(ring));
    }
    if (contours.empty() || elements > kMostElements) {
        return path_.refuse(where, "CYCLE63 without a contour, or with more than 1000 elements",
                            "write CYCLE62 before it");
    }
    check_start(false);
    note_own_way("CYCLE63");
    const control::Area area(std::move(contours));
    const auto rings = control::rings_of(area, milling);
    if (rings && rings->empty())
        return path_.refuse(where, "the tool does not fit into the pocket of CYCLE63", "take a smaller tool");
    if (!(milling.depths.bottom < milling.depths.top) || !rings ||
        control::ring_count(*rings, milling) > kMostRings)
        return path_.refuse(where, "CYCLE63 needs no rings, or more than 10000", "correct its infeeds");
    return control::mill_area(area, *rings, milling, to_plane(path_.tip()), mover());
}

}  // namespace tribo::readers::siemens
