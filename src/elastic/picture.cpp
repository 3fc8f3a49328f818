// SPDX-License-Identifier: MIT
#include "elastic/picture.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "base/math.hpp"

namespace tribo::elastic {
namespace {

// Interpolation between four nodes; beyond the border it uses the border. x and y in nodes from the first
// one.
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
    // `full_mm`: see Finish; 0: depths are drawn as published.
    Painter(const Sheet& sheet, const PictureView& view, float full_mm)
        : sheet_(sheet), view_(view), full_mm_(full_mm) {
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

    // The height as drawn.
    float height_mm(float x, float y) const {
        const Between at(x, y, sheet_.size().width, sheet_.size().height);
        const float *upper = sheet_.heights(at.y0), *lower = sheet_.heights(at.y1);
        const float e = at.mix(upper[at.x0], upper[at.x1], lower[at.x0], lower[at.x1]);
        if (!(full_mm_ > 0)) return relieved(e);
        const float part = e * e / (full_mm_ * full_mm_);
        return 0.5F * (relieved(e) - relieved(full_mm_) * (1 + kEdge) * part / (part + kEdge));
    }

    // Returns the node that the eye sees through node (x, y) of the flat image.
    std::array<float, 2> seen(float x, float y) const {
        float sx = x, sy = y;
        for (int i = 0; i < kParallaxSteps; ++i) {
            const float aside = -height_mm(sx, sy) * per_eye_height_;
            sx = x + (x - eye_x_) * aside;
            sy = y + (y - eye_y_) * aside;
        }
        return {sx, sy};
    }

    // The place of node (x, y) in another grid over the same image.
    Between over_all(float x, float y, int width, int height) const {
        const auto scaled = [](float node, int nodes, int others) {
            return (node + 0.5F) * static_cast<float>(others) / static_cast<float>(nodes) - 0.5F;
        };
        return {scaled(x, sheet_.size().width, width), scaled(y, sheet_.size().height, height), width,
                height};
    }
    float per_mm() const { return 1 / spacing_mm_; }

    // The light that reaches one point of the sheet.
    struct Light {
        float height_mm = 0, slope_x = 0, slope_y = 0;  // as drawn; slopes as in SmallRelief
        float walls = 0;  // slope of the walls around; below 0 on a rim, which stands above them
        float sun = 0;    // visible share of the disc, 0..1
    };
    Light light(float x, float y) const {
        Light light;
        const float per_mm = 0.5F / spacing_mm_;
        light.slope_x = (height_mm(x - 1, y) - height_mm(x + 1, y)) * per_mm;
        light.slope_y = (height_mm(x, y - 1) - height_mm(x, y + 1)) * per_mm;
        const float here = light.height_mm = height_mm(x, y);
        float horizon = 0;
        for (int i = 1; i <= kShadowSteps; ++i) {
            const float part = static_cast<float>(i) / kShadowSteps, away = shadow_reach_ * part * part;
            const float rise = height_mm(x + to_light_x_ * away, y + to_light_y_ * away) - here;
            horizon = std::max(horizon, rise / (away * spacing_mm_));
        }
        const float hidden =
            std::clamp((horizon - view_.slope_low) / (view_.slope_high - view_.slope_low), 0.0F, 1.0F);
        light.sun = 1 - view_.shadow * hidden;
        const float d = sky_reach_, walls = (height_mm(x - d, y) + height_mm(x + d, y) + height_mm(x, y - d) +
                                             height_mm(x, y + d)) /
                                            4;
        light.walls = (walls - here) / (d * spacing_mm_);
        return light;
    }

    // Light of the sun on a slope (1 where it is flat).
    float diffuse(float nx, float ny) const {
        const float towards =
            (nx * view_.light_x + ny * view_.light_y + view_.light_z) / std::sqrt(nx * nx + ny * ny + 1);
        return std::max(towards, 0.0F) / view_.light_z;
    }

    // Returns the linear brightness of the smooth sheet at this point; 1 where it is flat.
    float brightness(float x, float y) const {
        const Light l = light(x, y);
        return view_.ambient / (1 + l.walls * std::max(l.walls, 0.0F)) +
               (1 - view_.ambient) * diffuse(l.slope_x, l.slope_y) * l.sun;
    }

  private:
    // Where the dent has its wall: the square of the depth there over that of a full press.
    static constexpr float kEdge = 0.1F;

    float relieved(float e) const { return view_.relief * e / (1 + std::abs(e) / view_.half_mm); }

    const Sheet& sheet_;
    const PictureView& view_;
    float full_mm_;
    float spacing_mm_, eye_x_, eye_y_, per_eye_height_, to_light_x_, to_light_y_, shadow_reach_, sky_reach_;
};

// The light is the power 2.2 of the value of a colour.
constexpr double kGamma = 2.2;
constexpr float kBrightest = 2;
constexpr int kGammaKnots = 2048;

const std::array<float, kGammaKnots + 2>& gamma_table() {
    static const auto table = [] {
        std::array<float, kGammaKnots + 2> values{};
        for (int i = 0; i < kGammaKnots + 2; ++i) {
            const double light = kBrightest * static_cast<double>(i) / kGammaKnots;
            values[static_cast<std::size_t>(i)] = static_cast<float>(math::pow(light, 1 / kGamma));
        }
        return values;
    }();
    return table;
}

template <std::size_t N>
float between(const std::array<float, N>& table, float at) {
    const auto knot = static_cast<std::size_t>(at);
    return table[knot] + (table[knot + 1] - table[knot]) * (at - static_cast<float>(knot));
}

float colour_factor(float light) {
    return between(gamma_table(), std::clamp(light, 0.0F, kBrightest) * (kGammaKnots / kBrightest));
}

// Light of a colour value, 0..255, and back. The way back is a table over the root of the light, because it
// is nearly straight over it.
constexpr int kRootKnots = 1024;
struct Lights {
    std::array<float, 257> of_number{};
    std::array<float, kRootKnots + 2> number_of_root{};

    Lights() {
        for (int i = 0; i < 257; ++i)
            of_number[static_cast<std::size_t>(i)] = static_cast<float>(math::pow(i / 255.0, kGamma));
        for (int i = 0; i < kRootKnots + 2; ++i) {
            const double root = static_cast<double>(i) / kRootKnots;
            number_of_root[static_cast<std::size_t>(i)] =
                static_cast<float>(255 * math::pow(root, 2 / kGamma));
        }
    }
};
const Lights& lights() {
    static const Lights tables;
    return tables;
}

// Effect of a finish on the light: a factor on the image's own light, and the mirrored light that is added.
struct Shade {
    float factor = 1, mirrored = 0;
};

class Finisher {
  public:
    Finisher(const Painter& painter, const PictureView& view, const Finish& finish)
        : painter_(painter), view_(view), finish_(finish) {
        // Eye and light are far away, over the middle of the image.
        const float eye = 1 / std::sqrt(view.eye_below * view.eye_below + view.eye_height * view.eye_height);
        half_x_ = view.light_x;
        half_y_ = view.light_y + eye * view.eye_below;
        half_z_ = view.light_z + eye * view.eye_height;
        const float length = std::sqrt(half_x_ * half_x_ + half_y_ * half_y_ + half_z_ * half_z_);
        half_x_ /= length;
        half_y_ /= length;
        half_z_ /= length;
        assert(finish.roughness > 0 && finish.roughness <= 1);
        power_ = 2 / (finish.roughness * finish.roughness) - 2;
        peak_ = finish.gloss * (power_ + 2) / 8;
    }

    // Slope of the hairs at this point of the sheet.
    std::array<float, 2> lean(float x, float y) const {
        if (finish_.hairs == nullptr) return {0, 0};
        const Pile& hairs = *finish_.hairs;
        const Between at = painter_.over_all(x, y, hairs.width(), hairs.height());
        const auto node = [&](int i, int j) {
            return hairs.leans().data() + 2 * (std::ptrdiff_t{j} * hairs.width() + i);
        };
        const float *a = node(at.x0, at.y0), *b = node(at.x1, at.y0), *c = node(at.x0, at.y1),
                    *d = node(at.x1, at.y1);
        return {finish_.pile * at.mix(a[0], b[0], c[0], d[0]), finish_.pile * at.mix(a[1], b[1], c[1], d[1])};
    }
    // Returns the node of the image that is seen at this point of the sheet: tips lean away from it.
    std::array<float, 2> tip(float x, float y, const std::array<float, 2>& lean) const {
        return {x - lean[0] * finish_.hair_mm * painter_.per_mm(),
                y - lean[1] * finish_.hair_mm * painter_.per_mm()};
    }

    // `tip`: of the hairs that lean at (x, y).
    Shade shade(float x, float y, const std::array<float, 2>& lean, const std::array<float, 2>& tip) const {
        const Painter::Light light = painter_.light(x, y);
        const auto [rx, ry] = small_slope(tip[0], tip[1]);
        const float kept = 1 / (1 + std::max(-light.height_mm, 0.0F) / finish_.flatten_mm);
        const float ex = finish_.steeper * light.slope_x, ey = finish_.steeper * light.slope_y;
        const float bend = 1 / std::sqrt(1 + (ex * ex + ey * ey) / (finish_.steepest * finish_.steepest));
        const float nx = bend * ex + kept * rx, ny = bend * ey + kept * ry;
        const float sun = (1 - view_.ambient) * painter_.diffuse(nx, ny) * light.sun;
        const float sun_at_rest = (1 - view_.ambient) * painter_.diffuse(rx, ry);
        // The mirrored light beyond the mirrored light at rest, without an edge where it begins.
        const float mirrored = sun * lobe(nx, ny);
        const float more = std::max(mirrored - sun_at_rest * lobe(rx, ry), 0.0F);
        // Walls hide the light of what is between them; a rim sees more than a flat place does.
        const float walls = 1 - light.walls / std::sqrt(1 + 4 * light.walls * light.walls);
        const float side = lean[0] * view_.light_x + lean[1] * view_.light_y;
        return {(view_.ambient + sun) * walls * (1 - side) / ((1 + side) * (view_.ambient + sun_at_rest)),
                more > 0 ? more * more / mirrored : 0};
    }

    // Returns the shaded value of `colour`, 0 to 255.
    float shaded(float colour, Shade shade) const {
        const float own = between(lights().of_number, colour);
        float light = own * shade.factor + shade.mirrored;
        const float knee = std::max(own, finish_.knee);
        if (light > knee) {
            const float room = finish_.headroom * (1 - knee), over = light - knee;
            light = knee + room * over / (room + over);
        }
        return between(lights().number_of_root, std::sqrt(light) * kRootKnots);
    }

  private:
    std::array<float, 2> small_slope(float x, float y) const {
        if (finish_.relief == nullptr) return {0, 0};
        const SmallRelief& relief = *finish_.relief;
        const Between at(x, y, relief.width, relief.height);
        const auto node = [&](int i, int j) {
            return relief.slopes.data() + 2 * (std::ptrdiff_t{j} * relief.width + i);
        };
        const std::int8_t *a = node(at.x0, at.y0), *b = node(at.x1, at.y0), *c = node(at.x0, at.y1),
                          *d = node(at.x1, at.y1);
        constexpr float kStep = kSteepest / 127;
        return {kStep * at.mix(a[0], b[0], c[0], d[0]), kStep * at.mix(a[1], b[1], c[1], d[1])};
    }
    float lobe(float nx, float ny) const {
        const float along = (nx * half_x_ + ny * half_y_ + half_z_) / std::sqrt(nx * nx + ny * ny + 1);
        const float t = std::max(along, 1e-3F);
        return peak_ * t / (power_ - power_ * t + t);
    }

    const Painter& painter_;
    const PictureView& view_;
    Finish finish_;
    float half_x_, half_y_, half_z_, power_, peak_;
};

}  // namespace

void draw_rows(const Sheet& sheet, std::span<const std::uint8_t> image, std::span<std::uint8_t> out,
               int first, int rows, const Finish* finish, const PictureView& view) {
    const int width = sheet.size().width, height = sheet.size().height;
    assert(image.size() ==
           std::size_t{4} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    assert(out.size() == image.size() && first >= 0 && first + rows <= height);
    assert(finish == nullptr || finish->relief == nullptr ||
           (finish->relief->width == width && finish->relief->height == height));
    const Painter painter(sheet, view, finish != nullptr ? finish->full_mm : 0);
    const Finisher finisher(painter, view, finish != nullptr ? *finish : Finish{});
    const auto texel = [&](int x, int y) { return image.data() + 4 * (std::ptrdiff_t{y} * width + x); };
    for (int y = first; y < first + rows; ++y) {
        for (int x = 0; x < width; ++x) {
            const auto [sx, sy] = painter.seen(static_cast<float>(x), static_cast<float>(y));
            const std::array<float, 2> lean = finisher.lean(sx, sy), tip = finisher.tip(sx, sy, lean);
            const Between at(tip[0], tip[1], width, height);
            const std::uint8_t *a = texel(at.x0, at.y0), *b = texel(at.x1, at.y0), *c = texel(at.x0, at.y1),
                               *d = texel(at.x1, at.y1);
            std::array<float, 4> colour;
            for (int channel = 0; channel < 4; ++channel) {
                colour[static_cast<std::size_t>(channel)] =
                    at.mix(a[channel], b[channel], c[channel], d[channel]);
            }
            if (finish == nullptr) {
                const float factor = colour_factor(painter.brightness(sx, sy));
                for (int channel = 0; channel < 3; ++channel) {
                    float& value = colour[static_cast<std::size_t>(channel)];
                    value = std::min(value * factor, 255.0F);
                }
            } else if (const Shade shade = finisher.shade(sx, sy, lean, tip);
                       shade.factor != 1 || shade.mirrored != 0) {
                for (int channel = 0; channel < 3; ++channel) {
                    float& value = colour[static_cast<std::size_t>(channel)];
                    value = finisher.shaded(value, shade);
                }
            }
            std::uint8_t* pixel = out.data() + 4 * (std::ptrdiff_t{y} * width + x);
            for (const float value : colour) *pixel++ = static_cast<std::uint8_t>(value + 0.5F);
        }
    }
}

}  // namespace tribo::elastic
