// SPDX-License-Identifier: MIT
#include "elastic/sheet.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/math.hpp"

namespace tribo::elastic {
namespace {

// A pressed tile is not computed any further when all its nodes are this near to their target.
constexpr float kStillMm = 1e-6F;
// A free tile is set to exact rest when all its nodes are this near to rest.
constexpr float kRestMm = 1e-6F;

// A row of nodes through an ellipse: node x is at (u0 + x du, v0 + x dv) in half axes.
class Chord {
  public:
    Chord(double u0, double du, double v0, double dv)
        : step_(math::hypot(du, dv)),
          start_((u0 * du + v0 * dv) / step_),
          miss_((u0 * dv - v0 * du) / step_) {}

    double step() const { return step_; }
    double miss2() const { return miss_ * miss_; }
    // The column where the row passes the centre, limited to columns that are exact in float.
    int middle() const { return static_cast<int>(std::clamp(-start_ / step_, -1e6, 1e6)); }
    // Position along the row, from the place where it passes the centre.
    double at(int column) const { return start_ + column * step_; }

    // Returns columns of 0 .. columns - 1 that contain all nodes nearer than `radius`, in multiples of eight,
    // with some more; {0, 0} if there are none.
    ColumnRange within(double radius, int columns) const {
        const double inside = radius * radius - miss2();
        if (!(radius > 0) || !(inside > 0)) return {};
        const double middle = -start_ / step_, side = std::sqrt(inside) / step_;
        const auto column = [columns](double x) {
            return static_cast<int>(std::clamp(x, 0.0, static_cast<double>(columns)));
        };
        const int first = column(middle - side - 1) / 8 * 8, last = (column(middle + side + 2) + 7) / 8 * 8;
        return first < last ? ColumnRange{first, last} : ColumnRange{};
    }

  private:
    double step_, start_, miss_;
};

// Returns the share of the way to P / K that one step covers.
double share_of(const SheetMaterial& m, double duration_s, TimeScheme scheme) {
    const double k = m.stiffness_n_per_mm, nu = m.viscosity_n_s_per_mm;
    if (nu <= 0) return 1;
    if (scheme == TimeScheme::exact) return 1 - math::exp(-duration_s * k / nu);
    // (P + nu / Ts E) / (K + nu / Ts), written as a step from E.
    const double steady = k * duration_s;
    return steady > 1e300 ? 1 : steady / (steady + nu);
}

}  // namespace

Result<void> check(const SheetMaterial& m) {
    if (!(m.stiffness_n_per_mm >= 1e-3 && m.stiffness_n_per_mm <= 1e6)) {
        return fail("the stiffness is not between 0.001 and 1000000 N/mm", "give one of 1 to 10");
    }
    if (!(m.viscosity_n_s_per_mm >= 0 && m.viscosity_n_s_per_mm <= 1e6)) {
        return fail("the viscosity is not between 0 and 1000000 N s/mm", "give one of 0.1 to 1");
    }
    return {};
}

Sheet::Sheet(SheetSize size) : size_(size) {
    assert(size.width >= 1 && size.width <= kMostNodesPerSide);
    assert(size.height >= 1 && size.height <= kMostNodesPerSide);
    assert(size.spacing_mm > 0 && std::isfinite(size.spacing_mm));
    tiles_x_ = (size.width + kTileWidth - 1) / kTileWidth;
    tiles_y_ = (size.height + kTileHeight - 1) / kTileHeight;
    padded_ = tiles_x_ * kTileWidth;
    stride_ = padded_ + 2 * kGuard;
    resize(heights_);
    resize(pressures_);
    flags_.resize(static_cast<std::size_t>(tiles_x_) * static_cast<std::size_t>(tiles_y_));
    set_material({});
}

void Sheet::resize(Plane& p) {
    p.values.resize(static_cast<std::size_t>(p.skew + stride_ * size_.height));
}

int Sheet::rows_of(int tile_row) const {
    return std::min(kTileHeight, size_.height - tile_row * kTileHeight);
}

void Sheet::wake_all() {
    for (std::uint8_t& flag : flags_) {
        if (flag & kPressed) flag |= kMoving;
    }
}

void Sheet::set_material(const SheetMaterial& material) {
    assert(check(material));
    levels_.clear();
    palette_[0] = material;
    compliance_mm_per_n_[0] = static_cast<float>(1 / material.stiffness_n_per_mm);
    wake_all();
}

void Sheet::set_materials(std::span<const std::uint8_t> levels, std::span<const SheetMaterial, 256> palette) {
    const auto width = static_cast<std::size_t>(size_.width);
    assert(levels.size() == width * static_cast<std::size_t>(size_.height));
    levels_.assign(heights_.values.size(), 0);
    for (int y = 0; y < size_.height; ++y) {
        const auto row = levels.subspan(static_cast<std::size_t>(y) * width, width);
        std::uint8_t* at = levels_.data() + kGuard + y * stride_;
        std::copy(row.begin(), row.end(), at);
        // Nodes beyond the image repeat its last column.
        std::fill(at + size_.width, at + padded_, row.back());
    }
    for (std::size_t i = 0; i < palette.size(); ++i) {
        assert(check(palette[i]));
        palette_[i] = palette[i];
        compliance_mm_per_n_[i] = static_cast<float>(1 / palette[i].stiffness_n_per_mm);
    }
    wake_all();
}

// Clears all pressures except those that the first contact will overwrite.
void Sheet::clear_pressure() {
    const bool over = !options_.as_published && !contacts_.empty();
    const NodeRect kept = over ? tiles_under(contacts_.front(), kReach) : NodeRect{};
    for (int ty = 0; ty < tiles_y_; ++ty) {
        for (int tx = 0; tx < tiles_x_; ++tx) {
            std::uint8_t& flag = flags(tx, ty);
            if (!(flag & kPressed)) continue;
            flag = static_cast<std::uint8_t>((flag & ~kPressed) | kMoving);
            const bool inside = tx >= kept.x && tx < kept.x + kept.width && ty >= kept.y;
            if (inside && ty < kept.y + kept.height) continue;
            for (int y = ty * kTileHeight; y < ty * kTileHeight + rows_of(ty); ++y) {
                std::fill_n(plane(pressures_, y) + tx * kTileWidth, kTileWidth, 0.0F);
            }
        }
    }
}

// Returns the tiles that the box of `reach` half axes of the contact meets, in tiles.
NodeRect Sheet::tiles_under(const ContactEllipse& c, double reach) const {
    double sine = 0, cosine = 0;
    math::sincos(c.angle_rad, sine, cosine);
    const double half_x = reach * math::hypot(c.half_width_mm * cosine, c.half_height_mm * sine);
    const double half_y = reach * math::hypot(c.half_width_mm * sine, c.half_height_mm * cosine);
    const auto tile = [this](double mm, int tile_nodes, int tiles) {
        const double at = mm / size_.spacing_mm / tile_nodes;
        return static_cast<int>(std::clamp(std::floor(at), -1.0, static_cast<double>(tiles)));
    };
    const int x0 = std::max(0, tile(c.x_mm - half_x, kTileWidth, tiles_x_));
    const int y0 = std::max(0, tile(c.y_mm - half_y, kTileHeight, tiles_y_));
    const int x1 = std::min(tiles_x_ - 1, tile(c.x_mm + half_x, kTileWidth, tiles_x_));
    const int y1 = std::min(tiles_y_ - 1, tile(c.y_mm + half_y, kTileHeight, tiles_y_));
    if (x1 < x0 || y1 < y0) return {};
    return {x0, y0, x1 - x0 + 1, y1 - y0 + 1};
}

void Sheet::press_default(const ContactEllipse& c, bool over) {
    const NodeRect tiles = tiles_under(c, kReach);
    double sine = 0, cosine = 0;
    math::sincos(c.angle_rad, sine, cosine);
    const double spacing = size_.spacing_mm;
    const double dx0 = (tiles.x * kTileWidth + 0.5) * spacing - c.x_mm;
    const double ux = cosine / c.half_width_mm, vx = -sine / c.half_height_mm;
    const int columns = tiles.width * kTileWidth;
    PressRow row;
    row.over = over;
    row.force_n = static_cast<float>(c.force_n);
    row.law = share_law(options_.shape);
    const SheetKernels& kernels = sheet_kernels();
    for (int ty = tiles.y; ty < tiles.y + tiles.height; ++ty) {
        int first = columns, last = 0;
        for (int y = ty * kTileHeight; y < ty * kTileHeight + rows_of(ty); ++y) {
            const double dy = (y + 0.5) * spacing - c.y_mm;
            const double u0 = ux * dx0 + sine * dy / c.half_width_mm;
            const double v0 = vx * dx0 + cosine * dy / c.half_height_mm;
            const Chord chord(u0, ux * spacing, v0, vx * spacing);
            row.middle = chord.middle();
            row.start = static_cast<float>(chord.at(row.middle));
            row.step = static_cast<float>(chord.step());
            row.miss2 = static_cast<float>(chord.miss2());
            row.reached = chord.within(kReach, columns);
            row.within = chord.within(row.law.edge, columns);
            if (row.within.last == 0) row.within = {row.reached.last, row.reached.last};
            kernels.press(plane(pressures_, y) + tiles.x * kTileWidth, columns, row);
            first = std::min(first, row.reached.first);
            last = std::max(last, row.reached.last);
        }
        for (int tx = first / kTileWidth; tx * kTileWidth < last; ++tx) {
            flags(tiles.x + tx, ty) |= kPressed | kMoving;
        }
    }
    // Nodes beyond the image repeat its last column.
    if (tiles.x + tiles.width < tiles_x_ || padded_ == size_.width) return;
    for (int y = tiles.y * kTileHeight; y < std::min(size_.height, (tiles.y + tiles.height) * kTileHeight);
         ++y) {
        float* end = plane(pressures_, y) + size_.width;
        std::fill(end, end + (padded_ - size_.width), end[-1]);
    }
}

void Sheet::press_published(const ContactEllipse& c) {
    const double radius_mm = c.half_width_mm, spacing = size_.spacing_mm;
    for (int y = 0; y < size_.height; ++y) {
        const double dy = (y + 0.5) * spacing - c.y_mm;
        float* row = plane(pressures_, y);
        for (int x = 0; x < padded_; ++x) {
            const double dx = (std::min(x, size_.width - 1) + 0.5) * spacing - c.x_mm;
            const double distance_mm = std::sqrt(dx * dx + dy * dy);
            row[x] +=
                static_cast<float>(published_pressure(options_.shape, distance_mm, c.held_s, radius_mm));
        }
    }
    for (std::uint8_t& flag : flags_) flag |= kPressed | kMoving;
}

void Sheet::press(std::span<const ContactEllipse> contacts, const PressOptions& options) {
    touching_.clear();
    for (const ContactEllipse& c : contacts) {
        if (touches(c)) touching_.push_back(c);
        // By default only the force counts, not its duration.
        if (touches(c) && !options.as_published) touching_.back().held_s = 0;
    }
    if (touching_ == contacts_ && options == options_) return;
    std::swap(contacts_, touching_);
    options_ = options;
    clear_pressure();
    for (const ContactEllipse& c : contacts_) {
        if (options.as_published) {
            press_published(c);
        } else {
            press_default(c, &c == contacts_.data());
        }
    }
}

void Sheet::settle(int tile_x, int tile_y, const TileMotion& motion) {
    std::uint8_t& flag = flags(tile_x, tile_y);
    if (motion.moved) flag |= kRedraw | kRelight;
    if (flag & kPressed) {
        if (motion.way_mm < kStillMm || !motion.moved) flag &= static_cast<std::uint8_t>(~kMoving);
        return;
    }
    if (motion.way_mm >= kRestMm) return;
    for (int y = tile_y * kTileHeight; y < tile_y * kTileHeight + rows_of(tile_y); ++y) {
        std::fill_n(plane(heights_, y) + tile_x * kTileWidth, kTileWidth, 0.0F);
    }
    flag = static_cast<std::uint8_t>((flag & ~kMoving) | kRedraw | kRelight);
}

void Sheet::step_run(int tile_x, int tiles, int tile_y, const float* shares) {
    std::array<TileMotion, kMostRunTiles> motion;
    const int first = tile_y * kTileHeight, rows = rows_of(tile_y);
    float* e = plane(heights_, first) + tile_x * kTileWidth;
    const float* p = plane(pressures_, first) + tile_x * kTileWidth;
    const SheetKernels& kernels = sheet_kernels();
    if (levels_.empty()) {
        kernels.step(e, p, stride_, tiles, rows, {compliance_mm_per_n_[0], shares[0]}, motion.data());
    } else {
        const std::uint8_t* levels = levels_.data() + kGuard + first * stride_ + tile_x * kTileWidth;
        kernels.step_mapped(e, p, stride_, tiles, rows, {levels, compliance_mm_per_n_.data(), shares},
                            motion.data());
    }
    for (int t = 0; t < tiles; ++t) settle(tile_x + t, tile_y, motion[static_cast<std::size_t>(t)]);
    for (int y = first; y < first + rows; ++y) {
        float* row = plane(heights_, y);
        row[-1] = row[0];
        row[padded_] = row[padded_ - 1];
    }
}

bool Sheet::step(double duration_s, TimeScheme scheme) {
    if (!(duration_s > 0) || !std::isfinite(duration_s)) return moving();
    std::array<float, 256> shares;
    const std::size_t materials = levels_.empty() ? 1 : palette_.size();
    for (std::size_t i = 0; i < materials; ++i) {
        shares[i] = static_cast<float>(share_of(palette_[i], duration_s, scheme));
    }
    for (int ty = 0; ty < tiles_y_; ++ty) {
        for (int tx = 0; tx < tiles_x_;) {
            int tiles = 0;
            while (tiles < kMostRunTiles && tx + tiles < tiles_x_ && (flags(tx + tiles, ty) & kMoving)) {
                ++tiles;
            }
            if (tiles > 0) step_run(tx, tiles, ty, shares.data());
            tx += std::max(tiles, 1);
        }
    }
    return moving();
}

void Sheet::reset() {
    contacts_.clear();
    std::fill(pressures_.values.begin(), pressures_.values.end(), 0.0F);
    std::fill(heights_.values.begin(), heights_.values.end(), 0.0F);
    std::fill(flags_.begin(), flags_.end(), kRedraw | kRelight);
}

bool Sheet::moving() const {
    return std::any_of(flags_.begin(), flags_.end(), [](std::uint8_t f) { return (f & kMoving) != 0; });
}

NormalRows Sheet::normal_rows(int row, int rows, int columns) const {
    return {stride_,
            columns,
            rows,
            row > 0,
            row + rows < size_.height,
            static_cast<float>(std::clamp(2 * size_.spacing_mm, 1e-9, 1e9))};
}

void Sheet::relight_run(int tile_x, int tiles, int tile_y) {
    const SheetKernels& kernels = sheet_kernels();
    const int first = tile_y * kTileHeight, rows = rows_of(tile_y);
    // The columns beside the run also depend on it.
    const int x0 = std::max(0, tile_x * kTileWidth - 8);
    const int x1 = std::min(padded_, (tile_x + tiles) * kTileWidth + 8);
    kernels.normals(plane(heights_, first) + x0, plane(normals_x_, first) + x0, plane(normals_y_, first) + x0,
                    normal_rows(first, rows, x1 - x0));
    for (const int beside : {tile_y - 1, tile_y + 1}) {
        if (beside < 0 || beside >= tiles_y_) continue;
        const int row = beside < tile_y ? first - 1 : first + rows;
        for (int tx = tile_x; tx < tile_x + tiles; ++tx) {
            if (flags(tx, beside) & kRelight) continue;
            const int x = tx * kTileWidth;
            kernels.normals(plane(heights_, row) + x, plane(normals_x_, row) + x, plane(normals_y_, row) + x,
                            normal_rows(row, 1, kTileWidth));
        }
    }
}

void Sheet::update_normals() {
    resize(normals_x_);
    resize(normals_y_);
    for (int ty = 0; ty < tiles_y_; ++ty) {
        for (int tx = 0; tx < tiles_x_;) {
            int tiles = 0;
            while (tx + tiles < tiles_x_ && (flags(tx + tiles, ty) & kRelight)) ++tiles;
            if (tiles > 0) relight_run(tx, tiles, ty);
            tx += std::max(tiles, 1);
        }
    }
    for (std::uint8_t& flag : flags_) flag &= static_cast<std::uint8_t>(~kRelight);
}

NodeRect Sheet::take_changes() {
    int x0 = tiles_x_, x1 = 0, y0 = tiles_y_, y1 = 0;
    for (int ty = 0; ty < tiles_y_; ++ty) {
        for (int tx = 0; tx < tiles_x_; ++tx) {
            std::uint8_t& flag = flags(tx, ty);
            if (!(flag & kRedraw)) continue;
            flag &= static_cast<std::uint8_t>(~kRedraw);
            x0 = std::min(x0, tx);
            x1 = std::max(x1, tx + 1);
            y0 = std::min(y0, ty);
            y1 = std::max(y1, ty + 1);
        }
    }
    if (x1 == 0) return {};
    const int x = x0 * kTileWidth, y = y0 * kTileHeight;
    return {x, y, std::min(size_.width, x1 * kTileWidth) - x, std::min(size_.height, y1 * kTileHeight) - y};
}

}  // namespace tribo::elastic
