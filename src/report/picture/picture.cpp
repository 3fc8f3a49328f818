// SPDX-License-Identifier: MIT
#include "report/picture/picture.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>

#include "base/math.hpp"
#include "report/picture/disc_points.hpp"
#include "report/picture/raster.hpp"
#include "report/picture/saw_marks.hpp"
#include "report/picture/studio.hpp"
#include "report/picture/sun_shadow.hpp"

namespace tribo::report {
namespace {

constexpr int kSamples = 2;            // per pixel along each side
constexpr double kTanHalfView = 0.24;  // a portrait lens: 27 degrees, little distortion
constexpr double kLineLift = 2e-3;     // share of the distance by which lines are in front of the surface
// Of sawn metal, as in web/ui/src/studio.ts; marks make it that much lighter and darker.
constexpr Colour kSawn{0.522F, 0.537F, 0.561F};
constexpr float kMarks = 0.16F;

struct Camera {
    Vec3 right, up, back;  // unit; back points to the viewer
    Vec3 eye;
    double scale = 1, centre_x = 0, centre_y = 0;  // samples

    Seen see(Vec3 p) const {
        const Vec3 v = p - eye;
        const double inverse = 1 / -dot(v, back);
        return {centre_x + scale * dot(v, right) * inverse, centre_y - scale * dot(v, up) * inverse, inverse};
    }
    // From the eye through a sample, 1 deep.
    Vec3 ray(double x, double y) const {
        return ((x - centre_x) / scale) * right - ((y - centre_y) / scale) * up - back;
    }
    double mm_per_sample(double depth_mm) const { return depth_mm / scale; }
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

float to_linear(float srgb) {
    return srgb <= 0.04045F ? srgb / 12.92F : static_cast<float>(math::pow((srgb + 0.055) / 1.055, 2.4));
}

Rgb linear(const Colour& c) {
    return {to_linear(c[0]), to_linear(c[1]), to_linear(c[2])};
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

// Light and opacity of one pixel, premultiplied.
struct Pixel {
    float r = 0, g = 0, b = 0, a = 0;
};

const Studio& studio() {
    static const Studio studio;
    return studio;
}

// Paints what the buffer holds. A pixel whose samples are of one triangle is shaded once.
class Painter {
  public:
    Painter(const TriangleMesh& mesh, const Camera& camera, const std::vector<Seen>& seen,
            const Buffer& buffer, const SunShadow& shadow, const PictureOptions& options)
        : mesh_(mesh), camera_(camera), seen_(seen), buffer_(buffer), shadow_(shadow), options_(options) {
        machined_ = linear(options.colour);
        sawn_ = linear(kSawn);
        for (std::size_t k = 0; k < linear_.size(); ++k) linear_[k] = to_linear(static_cast<float>(k) / 255);
    }

    std::vector<Pixel> paint() const {
        std::vector<Pixel> pixels;
        pixels.reserve(static_cast<std::size_t>(options_.width) * static_cast<std::size_t>(options_.height));
        for (int y = 0; y < options_.height; ++y)
            for (int x = 0; x < options_.width; ++x) pixels.push_back(pixel(x, y));
        return pixels;
    }

  private:
    static constexpr float kShare = 1.0F / (kSamples * kSamples);

    Pixel pixel(int px, int py) const {
        std::array<std::uint32_t, kSamples * kSamples> triangles;
        std::size_t count = 0;
        for (int y = 0; y < kSamples; ++y)
            for (int x = 0; x < kSamples; ++x)
                triangles[count++] = buffer_.triangle[buffer_.at(px * kSamples + x, py * kSamples + y)];
        const bool one = std::all_of(triangles.begin(), triangles.end(),
                                     [&](std::uint32_t t) { return t == triangles[0]; });
        Pixel pixel;
        if (one && triangles[0] != kNothing) {
            const Rgb light = shade(triangles[0], px * kSamples, py * kSamples, 0.5 * kSamples);
            return {light.r, light.g, light.b, 1};
        }
        for (std::size_t n = 0; n < count && !one; ++n) {
            if (triangles[n] == kNothing) continue;
            const int x = px * kSamples + static_cast<int>(n) % kSamples,
                      y = py * kSamples + static_cast<int>(n) / kSamples;
            const Rgb light = shade(triangles[n], x, y, 0.5);
            pixel.r += kShare * light.r;
            pixel.g += kShare * light.g;
            pixel.b += kShare * light.b;
            pixel.a += kShare;
        }
        if (options_.on_ground) pixel.a += (1 - pixel.a) * ground(px, py);
        return pixel;
    }

    // Opacity of the shadow on the ground.
    float ground(int px, int py) const {
        constexpr float kOpacity = 0.3F;
        const Vec3 ray = camera_.ray((px + 0.5) * kSamples, (py + 0.5) * kSamples);
        const double deep = (shadow_.ground_mm() - camera_.eye.z) / ray.z;
        if (!(deep > 0) || !std::isfinite(deep)) return 0;
        return kOpacity * (1 - shadow_.light(camera_.eye + deep * ray, {0, 0, 1}));
    }

    // At `middle` samples to the right of and below a sample of the triangle.
    Rgb shade(std::uint32_t triangle, int x, int y, double middle) const {
        const Triangle& t = mesh_.triangles[triangle];
        const Vec3 normal = normal_at(mesh_, t, camera_, seen_, x + middle, y + middle);
        const Vec3 place = place_at(x, y), to_viewer = normalized(camera_.eye - place, camera_.back);
        Rgb colour = machined_;
        Finish finish = Finish::machined;
        if (!options_.triangle_colours.empty()) {
            const auto& own = options_.triangle_colours[triangle];
            colour = {linear_[own[0]], linear_[own[1]], linear_[own[2]]};
            finish = Finish::paint;
        } else if (!options_.sawn.empty() && options_.sawn[triangle] != 0) {
            const float lighter = 1 + kMarks * saw_marks(place, mark_pixel(x, y, place, normal));
            colour = {lighter * sawn_.r, lighter * sawn_.g, lighter * sawn_.b};
            finish = Finish::sawn;
        }
        const Rgb light = studio().on(finish, colour, normal, to_viewer, shadow_.light(place, normal));
        const float open = openness(x, y, place, normal);
        const Rgb out = toned({open * light.r, open * light.g, open * light.b});
        return {std::min(out.r, 1.0F), std::min(out.g, 1.0F), std::min(out.b, 1.0F)};
    }

    // How far the marks of a saw change from a sample of a surface to the next pixels right and below.
    double mark_pixel(int x, int y, Vec3 place, Vec3 normal) const {
        const auto next = [&](int dx, int dy) {
            const Vec3 ray = camera_.ray(x + dx + 0.5, y + dy + 0.5);
            const Vec3 there = camera_.eye + (dot(place - camera_.eye, normal) / dot(ray, normal)) * ray;
            return std::abs(saw_path(there) - saw_path(place));
        };
        return next(kSamples, 0) + next(0, kSamples);
    }

    Vec3 place_at(int x, int y) const {
        const double deep = 1 / static_cast<double>(buffer_.nearness[buffer_.at(x, y)]);
        return camera_.eye + deep * camera_.ray(x + 0.5, y + 0.5);
    }

    // The share of the sky that neighbours within some pixels leave free (after McGuire et al. 2011, Alchemy
    // obscurance): with it grooves of some hundredths of a millimetre are seen.
    float openness(int x, int y, Vec3 place, Vec3 normal) const {
        constexpr double kReach = 20 * kSamples;  // samples
        const double depth = 1 / static_cast<double>(buffer_.nearness[buffer_.at(x, y)]),
                     mm = camera_.mm_per_sample(depth), radius = kReach * mm;
        double hidden = 0;
        for (const Vec3 way : around_) {
            const int u = x + static_cast<int>(std::lround(kReach * way.x)),
                      v = y + static_cast<int>(std::lround(kReach * way.y));
            if (u < 0 || v < 0 || u >= buffer_.width || v >= buffer_.height ||
                buffer_.triangle[buffer_.at(u, v)] == kNothing)
                continue;
            const Vec3 to = place_at(u, v) - place;
            const double square = squared_length(to),
                         near = std::clamp(1 - square / (4 * radius * radius), 0.0, 1.0);
            hidden += near * std::max(0.0, dot(to, normal) - 0.3 * kSamples * mm) /
                      (square + 0.04 * radius * radius);
        }
        return static_cast<float>(
            std::clamp(1 - 1.1 * radius * hidden / static_cast<double>(around_.size()), 0.25, 1.0));
    }

    const TriangleMesh& mesh_;
    const Camera& camera_;
    const std::vector<Seen>& seen_;
    const Buffer& buffer_;
    const SunShadow& shadow_;
    const PictureOptions& options_;
    Rgb machined_, sawn_;
    std::array<float, 256> linear_;  // light of the bytes of a colour
    std::array<Vec3, 12> around_ = disc_points<12>();
};

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
            const double depth = (a.nearness + t * (b.nearness - a.nearness)) * (1 + kLineLift);
            if (cover <= 0 || depth < buffer.nearness[buffer.at(x * kSamples, y * kSamples)]) continue;
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
    const Rgb c = linear(line.colours.empty() ? Colour{0.9F, 0.4F, 0.1F}
                                              : line.colours[std::min(i, line.colours.size() - 1)]);
    return {c.r, c.g, c.b};
}

}  // namespace

files::Image draw_part(const TriangleMesh& mesh, const std::vector<PictureLine>& lines,
                       const PictureOptions& options) {
    assert(options.width >= 1 && options.width <= 8192 && options.height >= 1 && options.height <= 8192);
    files::Image image{options.width, options.height, {}};
    image.rgba.resize(std::size_t{4} * static_cast<std::size_t>(image.width) *
                      static_cast<std::size_t>(image.height));
    if (mesh.positions.empty()) return image;

    const SunShadow shadow(mesh);
    std::vector<Point3f> framed = mesh.positions;
    if (options.on_ground) {
        for (std::uint32_t i = 0; i < mesh.positions.size(); ++i) {
            const Vec3 p = shadow.on_ground(mesh.position(i));
            framed.push_back(to_float(p));
        }
    }
    const Camera camera = frame(framed, options);
    std::vector<Seen> seen(mesh.positions.size());
    for (std::uint32_t i = 0; i < seen.size(); ++i) seen[i] = camera.see(mesh.position(i));

    Buffer buffer(options.width * kSamples, options.height * kSamples);
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        const Triangle& t = mesh.triangles[i];
        fill(buffer, i, seen[t[0]], seen[t[1]], seen[t[2]]);
    }

    std::vector<Pixel> pixels = Painter(mesh, camera, seen, buffer, shadow, options).paint();
    for (const PictureLine& line : lines) {
        for (std::size_t i = 1; i < line.points_mm.size(); ++i) {
            const Seen a = camera.see(line.points_mm[i - 1]), b = camera.see(line.points_mm[i]);
            if (!(a.nearness > 0) || !(b.nearness > 0)) continue;  // behind the viewer
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
