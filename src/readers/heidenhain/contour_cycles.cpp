// SPDX-License-Identifier: MIT
// Contours that subprograms describe and cycles mill: 14 and 20 to 25. The way within a pocket is the
// control's own: rings are taken. TNC 640 manual, Programming of Machining Cycles: SL cycles.
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/math.hpp"
#include "readers/heidenhain/interpreter.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers::heidenhain {
namespace {

constexpr double kMostRings = 10'000, kMostPasses = 10'000;
constexpr std::size_t kMostElements = 1000;  // of all contours of a pocket
constexpr std::size_t kMostContours = 12;    // as the control

// Twice the area within a contour: positive if it runs counter-clockwise.
double signed_area(const control::Ring& ring) {
    double sum = 0;
    for (const gcode::Element& element : ring) {
        sum += element.start.u * element.end.v - element.start.v * element.end.u;
        const double radius = element.is_arc() ? gcode::distance(element.end, element.centre) : 0;
        sum += radius * radius * (element.turn_rad - math::sin(element.turn_rad));
    }
    return sum;
}

control::Ring turned_back(const control::Ring& ring) {
    control::Ring back(ring.rbegin(), ring.rend());
    for (gcode::Element& element : back) {
        std::swap(element.start, element.end);
        element.turn_rad *= -1;
    }
    return back;
}

}  // namespace

bool Interpreter::is_contour_cycle(int number) {
    return number >= 22 && number <= 25;
}

// CYCL DEF 14.1 CONTOUR LABEL 1 /2 /3
Result<void> Interpreter::choose_contours(LineReader& in) {
    contour_labels_.clear();
    const std::string_view text = line_.text.substr(static_cast<std::size_t>(in.column() - line_.column));
    for (std::size_t i = 0; i < text.size();) {
        std::size_t end = i;
        while (end < text.size() && is_digit(text[end])) ++end;
        if (end > i) contour_labels_.emplace_back(text.substr(i, end - i));
        i = std::max(end, i + 1);
    }
    if (contour_labels_.size() <= kMostContours) return skip_continuation();
    return path_.refuse(place(in.column()), "cycle 14 names more than 12 contours", "mill them one by one");
}

// 20: the data of the contours. 22 to 25: what runs at the call.
Result<void> Interpreter::define_contour_cycle(LineReader& in, int number) {
    Cycle cycle;
    cycle.number = number;
    cycle.place = place(line_.column);
    if (auto done = read_parameters(in, cycle); !done) return done;
    if (number == 20) {
        contour_data_ = std::move(cycle);
        return {};
    }
    cycle_ = std::move(cycle);
    cycle_at_every_position_ = false;
    return {};
}

// Runs a subprogram and keeps its elements.
Result<Interpreter::Captured> Interpreter::capture(const std::string& label) {
    const std::size_t back = at_, depth = calls_.size();
    const Line line = line_;
    const auto feed = path_.feed_mm_per_min;
    const Vec3 tangent = tangent_;
    const int side = std::exchange(side_, 0);
    captured_ = Captured{};
    auto done = go_to(label, line_.column);
    if (done) {
        calls_.push_back({back, false, unit_mm_});
        for (++at_; done && at_ < lines_.size() && !ended_ && calls_.size() > depth; ++at_) done = run_line();
        if (done && free_) done = close_free_contour();
    }
    calls_.resize(std::min(calls_.size(), depth));
    at_ = back;
    line_ = line;
    path_.feed_mm_per_min = feed;
    tangent_ = tangent;
    side_ = side;
    Captured found = *std::exchange(captured_, std::nullopt);
    if (!done) return std::unexpected(done.error());
    return found;
}

// A path function of the contour that is being read.
void Interpreter::keep_step(const Words& words, Vec3 to, const std::optional<motion::Arc>& arc) {
    const bool is_mirrored = mirror_.x * mirror_.y < 0;
    if (words.side && *words.side != 0) captured_->side = is_mirrored ? -*words.side : *words.side;
    const Vec3 from = here();
    const bool is_flat = arc || to.x != from.x || to.y != from.y;
    const bool is_start = captured_->steps.empty() && (words.axis[0] || words.axis[1] || words.polar_radius);
    if (is_start || (is_flat && !captured_->steps.empty()))
        captured_->steps.push_back({to, arc, 0, false, false});
}

Result<control::Ring> Interpreter::elements_of(const Captured& contour) {
    Contour open;
    if (contour.steps.size() < 2) {
        return path_.refuse(cycle_.place, "a contour of cycle 14 has no elements",
                            "write its start and its lines and circles behind its label");
    }
    open.open(contour.steps[0].to, 0, 0, false);
    open.add_steps(contour.steps, 0, contour_words(false));
    return open.elements(path_);
}

// A word of the cycle, else of cycle 20.
double Interpreter::contour_word(int parameter) const {
    return cycle_.at(parameter, contour_data_.at(parameter));
}

Result<double> Interpreter::contour_feed(int parameter) {
    double feed = contour_word(parameter);
    if (!(feed > 0)) feed = path_.feed_mm_per_min.value_or(0);
    feed = std::min(feed, kFastFeed);
    if (auto good = path_.in_range(kLimits.feed, feed, cycle_.place); !good)
        return std::unexpected(good.error());
    return feed;
}

control::PocketDepths Interpreter::contour_depths() const {
    const double top = contour_word(5), near = top + std::abs(contour_word(6));
    return {std::max(contour_word(7), near), top, near, top + contour_word(1)};
}

Result<void> Interpreter::mill_contour_cycle() {
    if (contour_labels_.empty()) {
        return path_.refuse(cycle_.place, "no contour is chosen for this cycle",
                            "write CYCL DEF 14 with the labels of the contours before it");
    }
    if (!(contour_word(1) < 0)) {
        return path_.refuse(cycle_.place, "the depth Q1 is not below zero",
                            "write CYCL DEF 20 with the depth and a minus sign");
    }
    if (cycle_.number == 25) return follow_contour();
    return mill_contour_pocket(cutter_radius());
}

// 22: all of it but the allowances; 23: its floor; 24: its edge.
Result<void> Interpreter::mill_contour_pocket(double radius) {
    std::vector<control::Ring> pockets, islands;
    std::size_t elements = 0;
    for (const std::string& label : contour_labels_) {
        const auto contour = capture(label);
        if (!contour) return std::unexpected(contour.error());
        auto ring = elements_of(*contour);
        if (!ring) return std::unexpected(ring.error());
        if (!control::close_ring(*ring)) {
            return path_.refuse(cycle_.place, "the contour LBL " + label + " is not closed",
                                "end it where it begins, or mill it with cycle 25");
        }
        elements += ring->size();
        const bool is_pocket = contour->side * signed_area(*ring) >= 0;
        (is_pocket ? pockets : islands).push_back(*std::move(ring));
    }
    const auto feed = contour_feed(12), plunge = contour_feed(11);
    if (!feed) return std::unexpected(feed.error());
    if (!plunge) return std::unexpected(plunge.error());
    const int number = cycle_.number;
    control::AreaMilling milling;
    milling.depths = contour_depths();
    milling.radius = radius;
    milling.allowance = std::max(number == 24 ? contour_word(14) : contour_word(3), 0.0);
    if (number == 22) milling.depths.bottom += std::max(contour_word(4), 0.0);
    milling.step = std::max(contour_word(2), 0.0) * radius;
    milling.infeed = number == 23 ? 0 : std::abs(contour_word(10));
    milling.along_edge = number == 24;
    milling.clockwise = contour_word(9) < 0;
    milling.feed = *feed;
    milling.plunge = *plunge;
    const std::string name = "cycle " + std::to_string(number);
    if (elements > kMostElements) {
        return path_.refuse(cycle_.place, name + " has contours with more than 1000 elements",
                            "let the CAM system write the path");
    }
    const control::Area area(std::move(pockets), std::move(islands));
    const auto rings = control::rings_of(area, milling);
    if (rings && rings->empty()) {
        return path_.refuse(cycle_.place, "the tool does not fit into the pocket of " + name,
                            "take a smaller tool, and write RL or RR so that it is on the pocket's side");
    }
    if (!(milling.depths.bottom < milling.depths.top) || !rings ||
        control::ring_count(*rings, milling) > kMostRings)
        return path_.refuse(cycle_.place, name + " needs no rings, or more than 10000", "correct Q2 and Q10");
    if (path_.first(kPocketWay)) {
        path_.warn(cycle_.place.line, "the way of the tool within " + name +
                                          " is the control's own: rings are taken, straight down at their "
                                          "start");
    }
    return control::mill_area(area, *rings, milling, path_.tip(), mover());
}

// 25: along the contour, depth by depth; Q15: 1 climbing, -1 not, 0 there and back.
Result<void> Interpreter::follow_contour() {
    const auto contour = capture(contour_labels_.front());
    if (!contour) return std::unexpected(contour.error());
    const auto elements = elements_of(*contour);
    if (!elements) return std::unexpected(elements.error());
    const double radius = contour->side == 0 ? 0 : cutter_radius() + std::max(contour_word(3), 0.0);
    const control::PocketDepths depths = contour_depths();
    const double height = depths.top - depths.bottom, infeed = std::abs(contour_word(10));
    const double passes = infeed > 0 ? std::max(1.0, std::ceil(height / infeed - 1e-9)) : 1;
    if (!(passes <= kMostPasses))
        return path_.refuse(cycle_.place, "cycle 25 needs more than 10000 passes", "correct Q10");
    const control::Ring back = turned_back(*elements);
    const double way = contour_word(15);
    for (double pass = 1; pass <= passes; ++pass) {
        const double z = depths.top - height * pass / passes;
        const bool there_and_back = way == 0 && std::fmod(pass, 2) == 0;
        const bool is_back = there_and_back || (way != 0 && way * contour->side < 0);
        if (auto done = follow_contour_at(is_back ? back : *elements,
                                          is_back ? -contour->side : contour->side, radius, z);
            !done)
            return done;
        if (auto done = go_to_height(depths.back, kRapid); !done) return done;
    }
    return {};
}

Result<void> Interpreter::follow_contour_at(const control::Ring& elements, int side, double radius,
                                            double z) {
    const auto feed = contour_feed(12), plunge = contour_feed(11);
    if (!feed) return std::unexpected(feed.error());
    if (!plunge) return std::unexpected(plunge.error());
    const auto modal = path_.feed_mm_per_min;
    path_.feed_mm_per_min = *feed;
    if (auto done = check_start(false); !done) return done;
    contour_.open({elements.front().start.u, elements.front().start.v, z}, side, radius, false);
    for (const gcode::Element& element : elements) {
        std::optional<motion::Arc> arc;
        if (element.is_arc()) {
            arc.emplace();
            arc->centre_mm = {element.centre.u, element.centre.v, z};
            arc->normal = {0, 0, element.turn_rad < 0 ? -1.0 : 1.0};
            arc->turn_rad = std::abs(element.turn_rad);
        }
        contour_.add({element.end.u, element.end.v, z}, arc, contour_words(false));
    }
    const auto begin = contour_.begin(path_);
    Result<void> done = begin ? Result<void>{} : std::unexpected(begin.error());
    if (done) done = go_to_height(contour_depths().back, kRapid);
    if (done) done = go_to_place(begin->x, begin->y, kRapid);
    if (done) done = go_to_height(z, *plunge);
    if (done) done = close_contour();
    contour_ = {};
    path_.feed_mm_per_min = modal;
    return done;
}

}  // namespace tribo::readers::heidenhain
