// SPDX-License-Identifier: MIT
#include "report/picture/picture.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>

#include "base/math.hpp"

namespace tribo::report {
namespace {

constexpr int kSamples = 2;            // per pixel along each side
constexpr int kSubpixel = 256;         // steps of a vertex between two samples
constexpr double kTanHalfView = 0.24;  // a portrait lens: 27 degrees, little distortion
constexpr std::uint32_t kNothing = std::numeric_limits<std::uint32_t>::max();
constexpr double kLineLift = 2e-3;  // share of the distance by which lines are in front of the surface

// Projection of a point: sample coordinates, and 1 / depth along the view, which is linear on the screen.
struct Seen {
    double x = 0, y = 0, inverse_depth = 0;
};

struct Camera {
    Vec3 right, up, back;  // unit; back points to the viewer
    Vec3 eye;
    double scale = 1, centre_x = 0, centre_y = 0;  // samples

    Seen see(Vec3 p) const {
        const Vec3 v = p - eye;
        const double inverse = 1 / -dot(v, back);
        return {centre_x + scale * dot(v, right) * inverse, centre_y - scale * dot(v, up) * inverse, inverse};
    }
};

// Places the eye so that all points are in the frame and fill it.
Camera frame(const std::vector<Point3f>& points, const PictureOptions& options) {
    Camera camera;
    camera.back = normalized(options.towards_viewer);
    const Vec3 zenith = std::abs(camera.back.z) > 0.999 ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
    camera.right = normalized(cross(zenith, camera.back));
    camera.up = cross(camera.back, camera.right);

    const double width = options.width * kSamples, height = options.height * kSamples;
    const double shorter = std::min(width, height) * (1 - 2 * options.margin);
    const double margin = std::min(width, height) * 2 * options.margin;
    camera.scale = 0.5 * shorter / kTanHalfView;
    camera.centre_x = 0.5 * width;
    camera.centre_y = 0.5 * height;
    const double tan_x = kTanHalfView * (width - margin) / shorter;
    const double tan_y = kTanHalfView * (height - margin) / shorter;

    // In the axes of the camera, an eye at (ex, ey, ez) sees a point (x, y, z) if |x - ex| <= tan_x (ez - z),
    // and likewise in y. The extremes of the four planes give ez and the centre directly.
    constexpr double kFar = std::numeric_limits<double>::infinity();
    double left = -kFar, right = -kFar, top = -kFar, bottom = -kFar, nearest = -kFar;
    for (const Point3f& q : points) {
        const Vec3 p{q[0], q[1], q[2]};
        const double x = dot(p, camera.right), y = dot(p, camera.up), z = dot(p, camera.back);
        right = std::max(right, x + tan_x * z);
        left = std::max(left, -x + tan_x * z);
        top = std::max(top, y + tan_y * z);
        bottom = std::max(bottom, -y + tan_y * z);
        nearest = std::max(nearest, z);
    }
    double ez = std::max(0.5 * (left + right) / tan_x, 0.5 * (top + bottom) / tan_y);
    ez = std::max(ez, nearest + std::max(1e-6, 1e-3 * (ez - nearest)));
    camera.eye = 0.5 * (right - left) * camera.right + 0.5 * (top - bottom) * camera.up + ez * camera.back;
    return camera;
}

// For each sample the nearest triangle and its depth.
struct Buffer {
    int width = 0, height = 0;  // samples
    std::vector<float> inverse_depth;
    std::vector<std::uint32_t> triangle;

    std::size_t at(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    }
};

struct FixedPoint {
    std::int64_t x, y;
};

// Twice the area of a, b, p in subpixel units, positive if p is right of a -> b (y points down).
std::int64_t side(FixedPoint a, FixedPoint b, FixedPoint p) {
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

// Top-left rule: a sample exactly on a common edge belongs to one of the two triangles.
bool owns_edge(FixedPoint a, FixedPoint b) {
    return b.y < a.y || (b.y == a.y && b.x > a.x);
}

// Edge functions on a grid of 1/256 sample are exact in 64 bits, so neighbours have no gaps and no overlaps.
void fill(Buffer& buffer, std::uint32_t index, Seen a, Seen b, Seen c) {
    const auto fixed = [](Seen s) {
        return FixedPoint{static_cast<std::int64_t>(std::floor(s.x * kSubpixel + 0.5)),
                          static_cast<std::int64_t>(std::floor(s.y * kSubpixel + 0.5))};
    };
    FixedPoint p[3] = {fixed(a), fixed(b), fixed(c)};
    double depth[3] = {a.inverse_depth, b.inverse_depth, c.inverse_depth};
    std::int64_t area = side(p[0], p[1], p[2]);
    if (area == 0) return;
    if (area < 0) {
        std::swap(p[1], p[2]);
        std::swap(depth[1], depth[2]);
        area = -area;
    }
    // Samples are at half-integer positions.
    const auto first = [](std::int64_t v) { return (v + kSubpixel / 2 - 1) / kSubpixel; };
    const auto last = [](std::int64_t v) { return (v - kSubpixel / 2) / kSubpixel; };
    const auto [x_min, x_max] = std::minmax({p[0].x, p[1].x, p[2].x});
    const auto [y_min, y_max] = std::minmax({p[0].y, p[1].y, p[2].y});
    const int x0 = static_cast<int>(std::max<std::int64_t>(0, first(x_min)));
    const int x1 = static_cast<int>(std::min<std::int64_t>(buffer.width - 1, last(x_max)));
    const int y0 = static_cast<int>(std::max<std::int64_t>(0, first(y_min)));
    const int y1 = static_cast<int>(std::min<std::int64_t>(buffer.height - 1, last(y_max)));
    if (x0 > x1 || y0 > y1) return;

    const FixedPoint start{std::int64_t{x0} * kSubpixel + kSubpixel / 2,
                           std::int64_t{y0} * kSubpixel + kSubpixel / 2};
    std::int64_t row[3], step_x[3], step_y[3];
    double weight[3];
    for (int i = 0; i < 3; ++i) {
        const FixedPoint from = p[(i + 1) % 3], to = p[(i + 2) % 3];  // the edge opposite to corner i
        row[i] = side(from, to, start) - (owns_edge(from, to) ? 0 : 1);
        step_x[i] = -(to.y - from.y) * kSubpixel;
        step_y[i] = (to.x - from.x) * kSubpixel;
        weight[i] = depth[i] / static_cast<double>(area);
    }
    for (int y = y0; y <= y1; ++y) {
        std::int64_t e[3] = {row[0], row[1], row[2]};
        std::size_t at = buffer.at(x0, y);
        for (int x = x0; x <= x1; ++x, ++at) {
            if ((e[0] | e[1] | e[2]) >= 0) {
                const double d = static_cast<double>(e[0]) * weight[0] +
                                 static_cast<double>(e[1]) * weight[1] +
                                 static_cast<double>(e[2]) * weight[2];
                if (static_cast<float>(d) > buffer.inverse_depth[at]) {
                    buffer.inverse_depth[at] = static_cast<float>(d);
                    buffer.triangle[at] = index;
                }
            }
            for (int i = 0; i < 3; ++i) e[i] += step_x[i];
        }
        for (int i = 0; i < 3; ++i) row[i] += step_y[i];
    }
}

float to_linear(float srgb) {
    return srgb <= 0.04045F ? srgb / 12.92F : static_cast<float>(math::pow((srgb + 0.055) / 1.055, 2.4));
}

// Converts linear light 0..1 to sRGB bytes.
class Encoder {
  public:
    Encoder() {
        for (int i = 0; i <= kSteps; ++i) {
            const double v = static_cast<double>(i) / kSteps;
            const double srgb = v <= 0.0031308 ? 12.92 * v : 1.055 * math::pow(v, 1 / 2.4) - 0.055;
            table_[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(255 * srgb + 0.5);
        }
    }
    std::uint8_t operator()(float linear) const {
        return table_[static_cast<std::size_t>(std::clamp(linear, 0.0F, 1.0F) * kSteps + 0.5F)];
    }

  private:
    static constexpr int kSteps = 8191;
    std::array<std::uint8_t, kSteps + 1> table_ = {};
};

// Lights: a low key light from the left, so that shallow grooves are visible; a soft light from the right; a
// sky.
class Lights {
  public:
    explicit Lights(const Camera& camera)
        : key_(normalized(-0.90 * camera.right + 0.25 * camera.back + Vec3{0, 0, 0.42})),
          fill_(normalized(0.9 * camera.right + 0.2 * camera.up + 0.6 * camera.back)),
          half_(normalized(key_ + camera.back)) {}

    struct Light {
        float diffuse, shine;
    };
    Light on(Vec3 normal) const {
        const double key = std::max(0.0, dot(normal, key_)), soft = std::max(0.0, dot(normal, fill_));
        const double sky = 0.5 + 0.5 * normal.z;
        double shine = std::max(0.0, dot(normal, half_));
        for (int i = 0; i < 5; ++i) shine *= shine;  // the 32nd power
        return {static_cast<float>(0.78 * key + 0.22 * soft + 0.10 + 0.20 * sky),
                static_cast<float>(0.22 * shine)};
    }

  private:
    Vec3 key_, fill_, half_;
};

// Returns the normal of the triangle at a sample, towards the viewer. It is interpolated if the mesh has
// normals.
Vec3 normal_at(const TriangleMesh& mesh, const Triangle& t, const Camera& camera,
               const std::vector<Seen>& seen, double x, double y) {
    const Vec3 a = mesh.position(t[0]), b = mesh.position(t[1]), c = mesh.position(t[2]);
    Vec3 normal = normalized(cross(b - a, c - a), camera.back);
    const bool flip = dot(normal, camera.eye - a) < 0;
    if (!mesh.normals.empty()) {
        const Seen &sa = seen[t[0]], &sb = seen[t[1]], &sc = seen[t[2]];
        const double area = (sb.x - sa.x) * (sc.y - sa.y) - (sb.y - sa.y) * (sc.x - sa.x);
        const double v = ((x - sa.x) * (sc.y - sa.y) - (y - sa.y) * (sc.x - sa.x)) / area;
        const double w = ((sb.x - sa.x) * (y - sa.y) - (sb.y - sa.y) * (x - sa.x)) / area;
        if (std::isfinite(v) && std::isfinite(w)) {
            const auto at = [&](std::uint32_t i) {
                const Point3f& n = mesh.normals[i];
                return Vec3{n[0], n[1], n[2]};
            };
            normal = normalized((1 - v - w) * at(t[0]) + v * at(t[1]) + w * at(t[2]), normal);
        }
    }
    return flip ? -normal : normal;
}

Colour linear(const std::array<std::uint8_t, 3>& srgb) {
    Colour out{};
    for (std::size_t k = 0; k < 3; ++k) out[k] = to_linear(static_cast<float>(srgb[k]) / 255);
    return out;
}

// Light and opacity of one pixel, premultiplied.
struct Pixel {
    float r = 0, g = 0, b = 0, a = 0;
};

std::vector<Pixel> shade(const TriangleMesh& mesh, const Camera& camera, const std::vector<Seen>& seen,
                         const Buffer& buffer, const PictureOptions& options) {
    const Lights lights(camera);
    const Colour base{to_linear(options.colour[0]), to_linear(options.colour[1]),
                      to_linear(options.colour[2])};
    constexpr float kShare = 1.0F / (kSamples * kSamples);
    std::vector<Pixel> pixels(static_cast<std::size_t>(options.width) *
                              static_cast<std::size_t>(options.height));
    for (int y = 0; y < buffer.height; ++y) {
        for (int x = 0; x < buffer.width; ++x) {
            const std::uint32_t index = buffer.triangle[buffer.at(x, y)];
            if (index == kNothing) continue;
            const Colour own =
                options.triangle_colours.empty() ? base : linear(options.triangle_colours[index]);
            const Lights::Light light =
                lights.on(normal_at(mesh, mesh.triangles[index], camera, seen, x + 0.5, y + 0.5));
            Pixel& pixel =
                pixels[static_cast<std::size_t>(y / kSamples) * static_cast<std::size_t>(options.width) +
                       static_cast<std::size_t>(x / kSamples)];
            // Clip before taking the mean; otherwise the edge of a highlight would have steps.
            pixel.r += kShare * std::min(1.0F, own[0] * light.diffuse + light.shine);
            pixel.g += kShare * std::min(1.0F, own[1] * light.diffuse + light.shine);
            pixel.b += kShare * std::min(1.0F, own[2] * light.diffuse + light.shine);
            pixel.a += kShare;
        }
    }
    return pixels;
}

// The columns of row `y` (relative to the start of a line) that may be within `reach` of the line.
struct Columns {
    double from, to;
};
Columns columns_near(double y, double dx, double dy, double reach) {
    constexpr double kAll = 1e9;
    if (std::abs(dy) < 1e-6) return {-kAll, kAll};
    const double middle = y * dx / dy, half = reach * std::sqrt(dx * dx + dy * dy) / std::abs(dy);
    return {middle - half, middle + half};
}

// Draws one piece of a line, `width` pixels wide, where the part does not hide it.
void draw_segment(std::vector<Pixel>& pixels, const Buffer& buffer, const PictureOptions& options, Seen a,
                  Seen b, const Colour& ca, const Colour& cb, double width) {
    const double ax = a.x / kSamples, ay = a.y / kSamples, bx = b.x / kSamples, by = b.y / kSamples;
    const double reach = 0.5 * width + 0.5, dx = bx - ax, dy = by - ay, squared = dx * dx + dy * dy;
    const auto inside = [](double v, int end) { return static_cast<int>(std::clamp(v, 0.0, 1.0 * end)); };
    const double left = std::min(ax, bx) - reach, right = std::max(ax, bx) + reach + 1;
    const int y1 = inside(std::max(ay, by) + reach + 1, options.height);
    for (int y = inside(std::min(ay, by) - reach, options.height); y < y1; ++y) {
        const double py = y + 0.5 - ay;
        const Columns near = columns_near(py, dx, dy, reach);
        const int x1 = inside(std::min(right, ax + near.to + 1), options.width);
        for (int x = inside(std::max(left, ax + near.from - 1), options.width); x < x1; ++x) {
            const double px = x + 0.5 - ax;
            const double t = squared > 0 ? std::clamp((px * dx + py * dy) / squared, 0.0, 1.0) : 0.0;
            const double away = std::sqrt((px - t * dx) * (px - t * dx) + (py - t * dy) * (py - t * dy));
            const float cover = static_cast<float>(std::clamp(reach - away, 0.0, 1.0));
            const double depth =
                (a.inverse_depth + t * (b.inverse_depth - a.inverse_depth)) * (1 + kLineLift);
            if (cover <= 0 || depth < buffer.inverse_depth[buffer.at(x * kSamples, y * kSamples)]) continue;
            Pixel& pixel = pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(options.width) +
                                  static_cast<std::size_t>(x)];
            const float s = static_cast<float>(t), keep = 1 - cover;
            pixel.r = keep * pixel.r + cover * (ca[0] + s * (cb[0] - ca[0]));
            pixel.g = keep * pixel.g + cover * (ca[1] + s * (cb[1] - ca[1]));
            pixel.b = keep * pixel.b + cover * (ca[2] + s * (cb[2] - ca[2]));
            pixel.a = keep * pixel.a + cover;
        }
    }
}

Colour linear_colour(const PictureLine& line, std::size_t i) {
    const Colour c =
        line.colours.empty() ? Colour{0.9F, 0.4F, 0.1F} : line.colours[std::min(i, line.colours.size() - 1)];
    return {to_linear(c[0]), to_linear(c[1]), to_linear(c[2])};
}

}  // namespace

files::Image draw_part(const TriangleMesh& mesh, const std::vector<PictureLine>& lines,
                       const PictureOptions& options) {
    assert(options.width >= 1 && options.width <= 8192 && options.height >= 1 && options.height <= 8192);
    files::Image image{options.width, options.height, {}};
    image.rgba.resize(std::size_t{4} * static_cast<std::size_t>(image.width) *
                      static_cast<std::size_t>(image.height));
    if (mesh.positions.empty()) return image;

    const Camera camera = frame(mesh.positions, options);
    std::vector<Seen> seen(mesh.positions.size());
    for (std::uint32_t i = 0; i < seen.size(); ++i) seen[i] = camera.see(mesh.position(i));

    Buffer buffer{options.width * kSamples, options.height * kSamples, {}, {}};
    const std::size_t samples =
        static_cast<std::size_t>(buffer.width) * static_cast<std::size_t>(buffer.height);
    buffer.inverse_depth.assign(samples, 0);
    buffer.triangle.assign(samples, kNothing);
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        const Triangle& t = mesh.triangles[i];
        fill(buffer, i, seen[t[0]], seen[t[1]], seen[t[2]]);
    }

    std::vector<Pixel> pixels = shade(mesh, camera, seen, buffer, options);
    for (const PictureLine& line : lines) {
        for (std::size_t i = 1; i < line.points_mm.size(); ++i) {
            const Seen a = camera.see(line.points_mm[i - 1]), b = camera.see(line.points_mm[i]);
            if (!(a.inverse_depth > 0) || !(b.inverse_depth > 0)) continue;  // behind the viewer
            draw_segment(pixels, buffer, options, a, b, linear_colour(line, i - 1), linear_colour(line, i),
                         line.width_px);
        }
    }

    const Encoder encode;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const Pixel& p = pixels[i];
        if (p.a <= 0) continue;
        std::uint8_t* out = &image.rgba[4 * i];
        out[0] = encode(p.r / p.a);
        out[1] = encode(p.g / p.a);
        out[2] = encode(p.b / p.a);
        out[3] = static_cast<std::uint8_t>(255 * std::min(p.a, 1.0F) + 0.5F);
    }
    return image;
}

}  // namespace tribo::report
