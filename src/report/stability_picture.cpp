// SPDX-License-Identifier: MIT
#include "report/stability_picture.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace tribo::report {
namespace {

constexpr int kWidth = 1200, kHeight = 730;
constexpr double kLeft = 110, kRight = 960, kTop = 90, kBottom = 650;  // of the chart
constexpr Colour kInk{0.1F, 0.1F, 0.1F}, kPale{0.72F, 0.72F, 0.72F}, kMark{0.82F, 0.1F, 0.1F};
constexpr Colour kSafe{0.0F, 0.36F, 0.62F}, kWhite{1, 1, 1};

// A vibration that grows by at most `most` in a period; darker from row to row.
struct Growth {
    double most;
    Colour colour;
    const char* text;
};
constexpr Growth kGrowths[] = {
    {1, {1, 1, 1}, "stable"},
    {1.1, {0.99F, 0.87F, 0.63F}, "up to 1.1"},
    {1.3, {0.96F, 0.68F, 0.38F}, "1.1 to 1.3"},
    {2, {0.83F, 0.45F, 0.29F}, "1.3 to 2"},
    {1e300, {0.55F, 0.25F, 0.26F}, "above 2"},
};

// The same for a probability of chatter of at most `most`, in the same colours.
constexpr Growth kShares[] = {
    {0.1, kGrowths[0].colour, "up to 10 %"},   {0.25, kGrowths[1].colour, "10 to 25 %"},
    {0.5, kGrowths[2].colour, "25 to 50 %"},   {0.75, kGrowths[3].colour, "50 to 75 %"},
    {1e300, kGrowths[4].colour, "above 75 %"},
};

std::size_t step_of(double value, const Growth (&steps)[5]) {
    std::size_t n = 0;
    while (n + 1 < std::size(steps) && value > steps[n].most) ++n;
    return n;
}

std::string short_number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

// A round number that is the `ways`th part of a range, or more.
double tick_step(double range, int ways) {
    const double least = range / ways, decade = std::pow(10.0, std::floor(std::log10(least)));
    for (const double times : {1.0, 2.0, 5.0})
        if (times * decade >= least) return times * decade;
    return 10 * decade;
}

class Chart {
  public:
    Chart(const dynamics::StabilityChart& chart, const StabilityNotes& notes) : chart_(chart), notes_(notes) {
        const std::vector<double>& rpm = chart.speeds_rpm;
        // Each point stands in the middle of its cell.
        half_rpm_ = rpm.size() > 1 ? 0.5 * (rpm[1] - rpm[0]) : std::max(1.0, 0.01 * rpm[0]);
        step_mm_ = chart.depths_mm[0];
        from_rpm_ = rpm.front() - half_rpm_;
        to_rpm_ = rpm.back() + half_rpm_;
        most_mm_ = chart.depths_mm.back() + 0.5 * step_mm_;
    }

    Drawing drawn() {
        drawing_ = {kWidth, kHeight, {}};
        cells();
        axes();
        border();
        own_point();
        pockets();
        legend();
        text(kLeft, 40, 15, notes_.title);
        return std::move(drawing_);
    }

  private:
    double x(double rpm) const {
        return kLeft + (rpm - from_rpm_) / (to_rpm_ - from_rpm_) * (kRight - kLeft);
    }
    double y(double mm) const { return kBottom - mm / most_mm_ * (kBottom - kTop); }
    void text(double at_x, double at_y, double height, std::string what,
              TextAnchor anchor = TextAnchor::start, const Colour& colour = kInk, bool upwards = false) {
        drawing_.shapes.emplace_back(DrawnText{at_x, at_y, height, std::move(what), anchor, upwards, colour});
    }
    // With white around it, on any ground; above the other labels if there is one already.
    void label(double at_x, double at_y, const std::string& what, const Colour& colour) {
        constexpr double kLetter = 11, kLine = 22;
        const double half = 0.5 * text_width(what, kLetter) + 5;
        const double middle = std::clamp(at_x, kLeft + half + 2, kRight - half - 2);
        const auto is_taken = [&] {
            return std::any_of(labels_.begin(), labels_.end(), [&](const DrawnArea& l) {
                return std::abs(l.x + 0.5 * l.width - middle) < half + 0.5 * l.width &&
                       std::abs(l.y + 15 - at_y) < kLine;
            });
        };
        at_y = std::clamp(at_y, kTop + kLine, kBottom - 8);
        const double way = at_y < kTop + 4 * kLine ? kLine : -kLine;
        while (is_taken()) at_y += way;
        labels_.push_back(
            {std::round(middle - half), std::round(at_y - 15), std::round(2 * half), 20, kWhite});
        drawing_.shapes.emplace_back(labels_.back());
        text(middle, at_y, kLetter, what, TextAnchor::middle, colour);
    }

    bool has_spread() const { return !chart_.probability.empty(); }
    std::size_t step_at(std::size_t speed, std::size_t depth) const {
        if (has_spread())
            return step_of(chart_.probability[speed * chart_.depths_mm.size() + depth], kShares);
        return step_of(chart_.at(speed, depth).multiplier, kGrowths);
    }

    void cells() {
        for (std::size_t s = 0; s < chart_.speeds_rpm.size(); ++s) {
            const double from = std::round(x(chart_.speeds_rpm[s] - half_rpm_));
            const double to = std::round(x(chart_.speeds_rpm[s] + half_rpm_));
            for (std::size_t n = 0; n < chart_.depths_mm.size();) {
                const std::size_t growth = step_at(s, n);
                std::size_t end = n;
                while (end < chart_.depths_mm.size() && step_at(s, end) == growth) ++end;
                const double low = std::round(y(chart_.depths_mm[n] - 0.5 * step_mm_));
                const double high = std::round(y(chart_.depths_mm[end - 1] + 0.5 * step_mm_));
                n = end;
                if (growth > 0 && to > from && low > high)
                    drawing_.shapes.emplace_back(
                        DrawnArea{from, high, to - from, low - high, kGrowths[growth].colour});
            }
        }
    }

    void line(double x0, double y0, double x1, double y1, double width, const Colour& colour) {
        drawing_.shapes.emplace_back(DrawnLine{{{x0, y0}, {x1, y1}}, width, colour});
    }

    void axes() {
        const double rpm_step = tick_step(to_rpm_ - from_rpm_, 9), mm_step = tick_step(most_mm_, 9);
        for (double rpm = std::ceil(from_rpm_ / rpm_step) * rpm_step; rpm <= to_rpm_; rpm += rpm_step) {
            line(x(rpm), kTop, x(rpm), kBottom + 6, 1, kPale);
            text(x(rpm), kBottom + 24, 11, short_number(rpm), TextAnchor::middle);
        }
        for (int n = 0; n * mm_step <= most_mm_; ++n) {
            const double mm = n * mm_step;
            line(kLeft - 6, y(mm), kRight, y(mm), 1, kPale);
            text(kLeft - 12, y(mm) + 5, 11, short_number(mm), TextAnchor::end);
        }
        drawing_.shapes.emplace_back(DrawnLine{
            {{kLeft, kTop}, {kLeft, kBottom}, {kRight, kBottom}, {kRight, kTop}, {kLeft, kTop}}, 1.5, kInk});
        text(0.5 * (kLeft + kRight), kBottom + 56, 13, "spindle speed, rpm", TextAnchor::middle);
        text(40, 0.5 * (kTop + kBottom), 13, "axial depth, mm", TextAnchor::middle, kInk, true);
    }

    double limit_mm(std::size_t speed) const {
        return chart_.limits[speed].depth_mm.value_or(chart_.depths_mm.back() + 0.5 * step_mm_);
    }

    void border() {
        DrawnLine line{{}, 2.5, kInk};
        for (std::size_t s = 0; s < chart_.speeds_rpm.size(); ++s)
            line.points.push_back({x(chart_.speeds_rpm[s]), y(limit_mm(s))});
        drawing_.shapes.emplace_back(std::move(line));
    }

    void pockets() {
        constexpr std::size_t kMost = 4;
        for (const dynamics::SafePocket& p : dynamics::safe_pockets(chart_, kMost)) {
            char words[80];
            std::snprintf(words, sizeof words, "%.6g rpm: %.3g mm%s", p.spindle_rpm, p.depth_mm,
                          p.deeper ? " or more" : "");
            drawing_.shapes.emplace_back(DrawnDisc{x(p.spindle_rpm), y(p.depth_mm), 5, kSafe});
            label(x(p.spindle_rpm), y(p.depth_mm) - 12, words, kSafe);
        }
    }

    void own_point() {
        const double rpm = notes_.spindle_rpm, mm = notes_.axial_depth_mm;
        if (rpm < from_rpm_ || rpm > to_rpm_ || mm > most_mm_) return;
        drawing_.shapes.emplace_back(DrawnDisc{x(rpm), y(mm), 9, kWhite});
        drawing_.shapes.emplace_back(DrawnDisc{x(rpm), y(mm), 7, kMark});
        drawing_.shapes.emplace_back(DrawnDisc{x(rpm), y(mm), 3, kWhite});
        char words[120], share[40] = "";
        if (notes_.probability)
            std::snprintf(share, sizeof share, "; probability %.0f %%", 100 * *notes_.probability);
        std::snprintf(words, sizeof words, "the job: %.6g rpm, %.4g mm, %s%s", rpm, mm,
                      notes_.stable ? "stable" : "chatters", share);
        label(x(rpm), y(mm) + (y(mm) + 30 < kBottom - 8 ? 30 : -16), words, kMark);
    }

    void legend() {
        const double left = kRight + 24;
        text(left, kTop + 12, 11, has_spread() ? "Of all cases in the" : "A vibration grows");
        text(left, kTop + 30, 11, has_spread() ? "band chatter" : "in a period by");
        double top = kTop + 48;
        for (const Growth& growth : has_spread() ? kShares : kGrowths) {
            drawing_.shapes.emplace_back(DrawnArea{left, top, 26, 18, kInk});
            drawing_.shapes.emplace_back(DrawnArea{left + 1, top + 1, 24, 16, growth.colour});
            text(left + 36, top + 14, 11, growth.text);
            top += 26;
        }
        line(left, top + 20, left + 26, top + 20, 2.5, kInk);
        text(left + 36, top + 25, 11, "border of the");
        text(left + 36, top + 43, 11, has_spread() ? "stated values" : "stable depths");
        drawing_.shapes.emplace_back(DrawnDisc{left + 13, top + 74, 5, kSafe});
        text(left + 36, top + 79, 11, "safe pocket");
        drawing_.shapes.emplace_back(DrawnDisc{left + 13, top + 104, 7, kMark});
        drawing_.shapes.emplace_back(DrawnDisc{left + 13, top + 104, 3, kWhite});
        text(left + 36, top + 109, 11, "the job");
    }

    const dynamics::StabilityChart& chart_;
    const StabilityNotes& notes_;
    double half_rpm_, step_mm_, from_rpm_, to_rpm_, most_mm_;
    Drawing drawing_;
    std::vector<DrawnArea> labels_;
};

}  // namespace

Drawing draw_stability(const dynamics::StabilityChart& chart, const StabilityNotes& notes) {
    return Chart(chart, notes).drawn();
}

}  // namespace tribo::report
