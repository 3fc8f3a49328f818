// SPDX-License-Identifier: MIT
#include "milling/engagement/contact_scout.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tribo::milling {
namespace {

// Largest number of even rows; shortest row in cells; number of times that the first and the last row are
// halved.
constexpr int kRows = 32;
constexpr double kLeastCells = 1;
constexpr int kHalvings = 5;
constexpr double kColumnRad = math::kTwoPi / 64;
// Columns are looked at in parts of at most so many cells and mm: a rib of this width is surely met.
constexpr double kWidestPartCells = 1, kWidestPartMm = 2;
// Where columns are narrower than this, cuts one below the other are looked for first.
constexpr double kWidestColumnMm = 2;

}  // namespace

ContactScout::ContactScout(const Cutter& cutter)
    : profile_(cutter), radius_mm_(cutter.radius_mm()), length_mm_(cutter.length_mm) {
    const std::size_t most = kRows + 2 * kHalvings + 1;
    borders_.reserve(most);
    windows_.reserve(most);
    ends_.reserve(most);
    engaged_.reserve(most);
}

void ContactScout::set_rows(double s0, double s1, double cell) {
    const int even = std::clamp(static_cast<int>(std::ceil((s1 - s0) / (kLeastCells * cell))), 4, kRows);
    const double height = (s1 - s0) / even;
    borders_.clear();
    borders_.push_back(s0);
    for (int n = kHalvings; n > 0; --n) borders_.push_back(s0 + std::ldexp(height, -n));
    for (int n = 1; n < even; ++n) borders_.push_back(s0 + n * height);
    for (int n = 1; n <= kHalvings; ++n) borders_.push_back(s1 - std::ldexp(height, -n));
    borders_.push_back(s1);
}

void ContactScout::set_windows(const CutPose& pose) {
    const std::size_t rows = borders_.size() - 1;
    windows_.assign(rows, 0);
    ends_.assign(rows, {});
    const bool straight = profile_.is_straight(borders_.front());
    const bool alike = !pose.travel.turns() && (pose.travel.down_mm == 0 || straight);
    for (std::size_t row = 0; row < rows; ++row) {
        if (alike && row > 0) {
            windows_[row] = windows_[0];
            ends_[row] = ends_[0];
            continue;
        }
        const TurnWindow w = moving_outward(pose, profile_.at(middle(static_cast<int>(row))), length_mm_);
        if (w.empty()) continue;
        ends_[row] = w;
        front_ = 0.5 * (w.from_rad + w.to_rad) / kColumnRad;
        const int first = static_cast<int>(std::floor(w.from_rad / kColumnRad - 0.5)) + 1;
        const int last = static_cast<int>(std::ceil(w.to_rad / kColumnRad - 0.5)) - 1;
        for (int column = first; column <= last; ++column)
            windows_[row] |= std::uint64_t{1} << (column & (kColumns - 1));
    }
}

// Of a column on a circle.
int ContactScout::parts_of(double radius_mm) const {
    return std::max(1, static_cast<int>(std::ceil(radius_mm * kColumnRad / widest_part_mm_)));
}

// On a cylinder: drops the cells that an earlier cut is proven to have emptied, as the walls of a slot that
// goes down in layers, which no clear way can prove. Where both ends of a column lie in one cut, all between
// does.
void ContactScout::drop_emptied_cells(const field::CarvedView& stock, const CutPose& pose) {
    constexpr int kMostLooks = 3;  // for cuts one below the other, or for one below the blank's top
    const auto rows = static_cast<int>(windows_.size());
    const double radius = profile_.at(middle(0)).radius_mm;
    const int parts = parts_of(radius);
    std::uint64_t outward = 0;
    for (const std::uint64_t window : windows_) outward |= window;
    // The cut of the column before, and its lowest row there: most often they are those of the next column.
    const field::Shape* cut = nullptr;
    int lowest = 0;
    for (int column = 0; column < kColumns; ++column) {
        const std::uint64_t bit = std::uint64_t{1} << column;
        if ((outward & bit) == 0) continue;
        const AxisCircle around{{}, radius * pose.frame.x, radius * pose.frame.y, radius};
        const auto place = [&](int row, int part) {
            const Vec3 side = parts == 1 ? around.at_place(2 * column + 1)
                                         : around.at((column + (part + 0.5) / parts) * kColumnRad);
            return pose.on_axis(profile_.at(middle(row)).height_mm) + side;
        };
        const auto lies_in_cut = [&](int row) {
            for (int part = 0; part < parts; ++part)
                if (cut->distance_below(place(row, part), kSkin) >= kSkin) return false;
            return true;
        };
        int end = rows;
        for (int look = 0; look < kMostLooks && end > 0; ++look) {
            if (cut == nullptr || !lies_in_cut(end - 1))
                cut = stock.emptied_by(place(end - 1, parts / 2), kSkin);
            if (cut == nullptr || !lies_in_cut(end - 1)) {
                cut = nullptr;
                end /= 2;
                continue;
            }
            if (!cut->is_whole_along(pose.frame.z)) {
                cut = nullptr;
                break;
            }
            int below = -1, first = end - 1;
            if (lowest < first) (lies_in_cut(lowest) ? first : below) = lowest;
            if (first == lowest && first > 0 && !lies_in_cut(first - 1)) below = first - 1;
            while (first - below > 1) {
                const int half = (below + first) / 2;
                (lies_in_cut(half) ? first : below) = half;
            }
            for (int row = first; row < end; ++row) windows_[static_cast<std::size_t>(row)] &= ~bit;
            end = lowest = first;
        }
    }
}

// Looks beside the middle of a cell that is wider than a part.
bool ContactScout::meets(const field::CarvedView& stock, const AxisCircle& circle, int column,
                         double clear_mm) const {
    const double width_mm = circle.radius_mm * kColumnRad;
    const int parts = parts_of(circle.radius_mm);
    for (int n = 0; n < parts; ++n) {
        const double share = (n + 0.5) / parts;
        if (std::abs(share - 0.5) * width_mm < clear_mm) continue;
        if (stock.is_material(circle.at((column + share) * kColumnRad), kSkin)) return true;
    }
    return false;
}

// Where little is taken from a wall along the path, the contact is narrow and lies at an end of the window.
bool ContactScout::meets_at_end(const field::CarvedView& stock, const CutPose& pose, int row) const {
    constexpr double kLeastMm = 1e-4;  // what a searched surface may be off
    const TurnWindow& window = ends_[static_cast<std::size_t>(row)];
    if (window.empty()) return false;
    const ProfilePoint at = profile_.at(middle(row));
    const AxisCircle circle{pose.on_axis(at.height_mm), at.radius_mm * pose.frame.x,
                            at.radius_mm * pose.frame.y, at.radius_mm};
    return stock.is_material(circle.at(window.from_rad), kLeastMm) ||
           stock.is_material(circle.at(window.to_rad), kLeastMm);
}

void ContactScout::search(const field::CarvedView& stock, const CutPose& pose, Patch p) {
    const auto known = [&](int row) { return engaged_[static_cast<std::size_t>(row)] != 0; };
    while (p.row0 < p.row1 && known(p.row0)) ++p.row0;
    while (p.row0 < p.row1 && known(p.row1 - 1)) --p.row1;
    if (p.row0 == p.row1) return;
    const int columns = p.column1 - p.column0;
    const std::uint64_t all = columns == kColumns ? ~std::uint64_t{0} : (std::uint64_t{1} << columns) - 1;
    const std::uint64_t mask = all << p.column0;
    std::uint64_t outward = 0;
    for (int row = p.row0; row < p.row1; ++row) outward |= windows_[static_cast<std::size_t>(row)];
    if ((outward & mask) == 0) return;

    // `reach` bounds the distance from the patch's middle to the middle of any cell, or to its sides if it is
    // wide: along the meridian and then around the axis.
    const double s0 = middle(p.row0), s1 = middle(p.row1 - 1);
    const double widest = std::min(radius_mm_, s1);
    const bool wide = widest * kColumnRad > widest_part_mm_;
    const double half_s = 0.5 * (s1 - s0), half_turn = 0.5 * (columns - (wide ? 0 : 1)) * kColumnRad * widest;
    const double reach = std::sqrt(half_s * half_s + half_turn * half_turn);
    if (reach < radius_mm_) {
        const ProfilePoint at = profile_.at(0.5 * (s0 + s1));
        const AxisCircle circle{pose.on_axis(at.height_mm), at.radius_mm * pose.frame.x,
                                at.radius_mm * pose.frame.y, at.radius_mm};
        // The middle of the columns, in places of the circle.
        constexpr int kPlaces = kTurnPlaces / kColumns;
        static_assert(kPlaces == 2);
        const double way =
            stock.clear_way_mm(circle.at_place(p.column0 + p.column1), 1.01 * reach + kSkin) + kSkin;
        const bool cell = p.row1 - p.row0 == 1 && columns == 1;
        if (way > reach || (cell && way >= 0 && !(wide && meets(stock, circle, p.column0, way)))) return;
        if (way < -reach || cell) {
            for (int row = p.row0; row < p.row1; ++row) {
                const auto n = static_cast<std::size_t>(row);
                if ((windows_[n] & mask) != 0) engaged_[n] = 1;
            }
            return;
        }
    }
    Patch low = p, high = p;
    if (columns == 1 || half_s > half_turn) {
        low.row1 = high.row0 = (p.row0 + p.row1) / 2;
    } else {
        low.column1 = high.column0 = (p.column0 + p.column1) / 2;
    }
    // First the half where the envelope moves outward fastest: most often there is material, and a row counts
    // once.
    const auto off = [&](const Patch& part) {
        const double turn = (0.5 * (part.column0 + part.column1) - front_) / kColumns;
        return std::abs(turn - std::floor(turn + 0.5));
    };
    if (off(high) < off(low)) std::swap(low, high);
    search(stock, pose, low);
    search(stock, pose, high);
}

void ContactScout::look(const field::CarvedView& stock, const CutPose& pose, double s0, double s1,
                        std::vector<MeridianStretch>& out) {
    set_rows(s0, s1, stock.field().cell_mm());
    widest_part_mm_ = std::min(kWidestPartMm, kWidestPartCells * stock.field().cell_mm());
    set_windows(pose);
    const std::size_t rows = windows_.size();
    const bool is_cylinder = profile_.parts().empty() && profile_.is_straight(s0);
    if (is_cylinder && radius_mm_ * kColumnRad <= kWidestColumnMm) drop_emptied_cells(stock, pose);
    engaged_.assign(rows, 0);
    search(stock, pose, {0, static_cast<int>(rows), 0, kColumns});
    const bool any = std::ranges::any_of(engaged_, [](char row) { return row != 0; });
    for (std::size_t n = 0; n < rows && !any; ++n)
        engaged_[n] = meets_at_end(stock, pose, static_cast<int>(n)) ? 1 : 0;
    for (std::size_t n = 0; n < rows; ++n) {
        const bool before = n > 0 && engaged_[n - 1], after = n + 1 < rows && engaged_[n + 1];
        if (engaged_[n] && before) {
            out.back().s1_mm = borders_[n + 1];
        } else if (engaged_[n] || before || after) {
            out.push_back({borders_[n], borders_[n + 1], engaged_[n] != 0});
        }
    }
}

}  // namespace tribo::milling
