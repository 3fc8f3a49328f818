// SPDX-License-Identifier: MIT
#include "elastic/picture.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "base/math.hpp"

namespace tribo::elastic {
namespace {

// Where to read between four nodes; beyond the border as on it. x and y in nodes from the first one.
struct Between {
    int x0, x1, y0, y1;
    float fx, fy;

    Between(float x, float y, int width, int height) {
        x = std::clamp(x, 0.0F, static_cast<float>(width - 1));
        y = std::clamp(y, 0.0F, static_cast<float>(height - 1));
        x0 = static_cast<int>(x);
        y0 = static_cast<int>(y);
        x1 = std::min(x0 + 1, width - 1);
        y1 = std::min(y0 + 1, height - 1);
        fx = x - static_cast<float>(x0);
        fy = y - static_cast<float>(y0);
    }
    float mix(float a, float b, float c, float d) const {
        const float upper = a + (b - a) * fx, lower = c + (d - c) * fx;
        return upper + (lower - upper) * fy;
    }
};

class Painter {
  public:
    Painter(const Sheet& sheet, const PictureView& view) : sheet_(sheet), view_(view) {
        const SheetSize& size = sheet.size();
        const auto longer = static_cast<float>(std::max(size.width, size.height));
        spacing_mm_ = static_cast<float>(size.spacing_mm);
        eye_x_ = 0.5F * static_cast<float>(size.width) - 0.5F;
        eye_y_ = 0.5F * static_cast<float>(size.height) - 0.5F + view.eye_below * longer;
        per_eye_height_ = 1 / (view.eye_height * longer * spacing_mm_);
        const float plane = std::sqrt(view.light_x * view.light_x + view.light_y * view.light_y);
        to_light_x_ = view.light_x / plane;
        to_light_y_ = view.light_y / plane;
        shadow_reach_ = view.shadow_reach * longer;
        sky_reach_ = view.sky_reach * longer;
    }

    // As it is drawn.
    float height_mm(float x, float y) const {
        const Between at(x, y, sheet_.size().width, sheet_.size().height);
        const float *upper = sheet_.heights(at.y0), *lower = sheet_.heights(at.y1);
        const float e = at.mix(upper[at.x0], upper[at.x1], lower[at.x0], lower[at.x1]);
        return view_.relief * e / (1 + std::abs(e) / view_.half_mm);
    }

    // The node that the eye sees through node (x, y) of the flat image.
    std::array<float, 2> seen(float x, float y) const {
        float sx = x, sy = y;
        for (int i = 0; i < kParallaxSteps; ++i) {
            const float aside = -height_mm(sx, sy) * per_eye_height_;
            sx = x + (x - eye_x_) * aside;
            sy = y + (y - eye_y_) * aside;
        }
        return {sx, sy};
    }

    // How bright the sheet is there, linear; 1 where it is flat.
    float brightness(float x, float y) const {
        const float per_mm = 0.5F / spacing_mm_;
        const float nx = (height_mm(x - 1, y) - height_mm(x + 1, y)) * per_mm;
        const float ny = (height_mm(x, y - 1) - height_mm(x, y + 1)) * per_mm;
        const float towards =
            (nx * view_.light_x + ny * view_.light_y + view_.light_z) / std::sqrt(nx * nx + ny * ny + 1);
        const float diffuse = std::max(towards, 0.0F) / view_.light_z;
        const float here = height_mm(x, y);
        float horizon = 0;
        for (int i = 1; i <= kShadowSteps; ++i) {
            const float part = static_cast<float>(i) / kShadowSteps, away = shadow_reach_ * part * part;
            const float rise = height_mm(x + to_light_x_ * away, y + to_light_y_ * away) - here;
            horizon = std::max(horizon, rise / (away * spacing_mm_));
        }
        const float hidden =
            std::clamp((horizon - view_.slope_low) / (view_.slope_high - view_.slope_low), 0.0F, 1.0F);
        const float d = sky_reach_, walls = (height_mm(x - d, y) + height_mm(x + d, y) + height_mm(x, y - d) +
                                             height_mm(x, y + d)) /
                                            4;
        const float m = std::max(walls - here, 0.0F) / (d * spacing_mm_);
        return view_.ambient / (1 + m * m) + (1 - view_.ambient) * diffuse * (1 - view_.shadow * hidden);
    }

  private:
    const Sheet& sheet_;
    const PictureView& view_;
    float spacing_mm_, eye_x_, eye_y_, per_eye_height_, to_light_x_, to_light_y_, shadow_reach_, sky_reach_;
};

// Light goes by the power 2.2 of a colour's number, so a number goes by this power of the light.
constexpr double kGamma = 1 / 2.2;
constexpr float kBrightest = 2;
constexpr int kGammaKnots = 2048;

const std::array<float, kGammaKnots + 2>& gamma_table() {
    static const auto table = [] {
        std::array<float, kGammaKnots + 2> values{};
        for (int i = 0; i < kGammaKnots + 2; ++i) {
            const double light = kBrightest * static_cast<double>(i) / kGammaKnots;
            values[static_cast<std::size_t>(i)] = static_cast<float>(math::pow(light, kGamma));
        }
        return values;
    }();
    return table;
}

float colour_factor(float light) {
    const float at = std::clamp(light, 0.0F, kBrightest) * (kGammaKnots / kBrightest);
    const auto knot = static_cast<std::size_t>(at);
    const auto& table = gamma_table();
    return table[knot] + (table[knot + 1] - table[knot]) * (at - static_cast<float>(knot));
}

}  // namespace

void draw_rows(const Sheet& sheet, std::span<const std::uint8_t> image, std::span<std::uint8_t> out,
               int first, int rows, const PictureView& view) {
    const int width = sheet.size().width, height = sheet.size().height;
    assert(image.size() ==
           std::size_t{4} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    assert(out.size() == image.size() && first >= 0 && first + rows <= height);
    const Painter painter(sheet, view);
    const auto texel = [&](int x, int y) { return image.data() + 4 * (std::ptrdiff_t{y} * width + x); };
    for (int y = first; y < first + rows; ++y) {
        for (int x = 0; x < width; ++x) {
            const auto [sx, sy] = painter.seen(static_cast<float>(x), static_cast<float>(y));
            const float factor = colour_factor(painter.brightness(sx, sy));
            const Between at(sx, sy, width, height);
            const std::uint8_t *a = texel(at.x0, at.y0), *b = texel(at.x1, at.y0), *c = texel(at.x0, at.y1),
                               *d = texel(at.x1, at.y1);
            std::uint8_t* pixel = out.data() + 4 * (std::ptrdiff_t{y} * width + x);
            for (int channel = 0; channel < 4; ++channel) {
                const float colour = at.mix(a[channel], b[channel], c[channel], d[channel]);
                const float lit = channel < 3 ? std::min(colour * factor, 255.0F) : colour;
                pixel[channel] = static_cast<std::uint8_t>(lit + 0.5F);
            }
        }
    }
}

}  // namespace tribo::elastic
