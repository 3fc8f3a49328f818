// SPDX-License-Identifier: MIT
#include "elastic/small_relief.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace tribo::elastic {
namespace {

// Sigmas, relative to the longer side.
constexpr double kFinest = 1.0 / 400, kCoarsest = 1.0 / 32;
// Slope of noise, in brightness (0..1) over the longer side: the remainder of 8 bits and a JPEG on a plain
// surface.
constexpr double kNoise = 1;
constexpr int kPasses = 3;

// A box of 2 radius + 1 pixels, and a share `ends` of one more pixel on both sides. kPasses of them are
// nearly a Gaussian (Gwosdek, Grewenig, Bruhn, Weickert 2011).
struct Box {
    int radius;
    double ends, inverse_sum;

    explicit Box(double sigma) {
        const double variance = sigma * sigma / kPasses;
        radius = static_cast<int>(0.5 * std::sqrt(12 * variance + 1) - 0.5);
        const double r = radius;
        ends = (2 * r + 1) * (r * (r + 1) - 3 * variance) / (6 * (variance - (r + 1) * (r + 1)));
        inverse_sum = 1 / (2 * r + 1 + 2 * ends);
    }
};

void blur_once(const std::vector<float>& from, std::vector<float>& to, const Box& box) {
    const auto last = static_cast<std::ptrdiff_t>(from.size()) - 1;
    const auto at = [&](std::ptrdiff_t i) {
        return static_cast<double>(from[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i, 0, last))]);
    };
    const std::ptrdiff_t r = box.radius;
    double inside = 0;
    for (std::ptrdiff_t i = -r; i <= r; ++i) inside += at(i);
    for (std::ptrdiff_t i = 0; i <= last; ++i) {
        const double before = at(i - r - 1), behind = at(i + r + 1);
        to[static_cast<std::size_t>(i)] =
            static_cast<float>((inside + box.ends * (before + behind)) * box.inverse_sum);
        inside += behind - at(i - r);
    }
}

// Returns the plane with its rows blurred and then transposed.
std::vector<float> rows_blurred_and_turned(const std::vector<float>& plane, std::size_t width,
                                           const Box& box) {
    const std::size_t height = plane.size() / width;
    std::vector<float> turned(plane.size()), line(width), other(width);
    for (std::size_t y = 0; y < height; ++y) {
        std::copy_n(plane.begin() + static_cast<std::ptrdiff_t>(y * width), width, line.begin());
        for (int pass = 0; pass < kPasses; ++pass) {
            blur_once(line, other, box);
            std::swap(line, other);
        }
        for (std::size_t x = 0; x < width; ++x) turned[x * height + y] = line[x];
    }
    return turned;
}

std::vector<float> blurred(const std::vector<float>& plane, std::size_t width, double sigma) {
    const Box box(sigma);
    return rows_blurred_and_turned(rows_blurred_and_turned(plane, width, box), plane.size() / width, box);
}

}  // namespace

SmallRelief small_relief(std::span<const std::uint8_t> rgba, int width, int height, float rms_slope) {
    assert(width > 0 && height > 0);
    const auto columns = static_cast<std::size_t>(width), rows = static_cast<std::size_t>(height);
    assert(rgba.size() == 4 * columns * rows);
    SmallRelief relief{width, height, std::vector<std::int8_t>(2 * columns * rows)};

    std::vector<float> bright(columns * rows);
    for (std::size_t i = 0; i < bright.size(); ++i) {
        const std::uint8_t* pixel = &rgba[4 * i];
        bright[i] = (0.2126F * pixel[0] + 0.7152F * pixel[1] + 0.0722F * pixel[2]) / 255;
    }
    const double longer = std::max(width, height);
    const std::vector<float> coarse = blurred(bright, columns, kCoarsest * longer);
    std::vector<float> band = blurred(bright, columns, kFinest * longer);
    for (std::size_t i = 0; i < band.size(); ++i) band[i] -= coarse[i];

    // All slopes are twice the true ones.
    std::vector<float> slopes(2 * band.size());
    double sum = 0;
    for (std::size_t y = 0; y < rows; ++y) {
        const float* row = &band[y * columns];
        const float *above = y > 0 ? row - columns : row, *below = y + 1 < rows ? row + columns : row;
        for (std::size_t x = 0; x < columns; ++x) {
            const float right = row[std::min(x + 1, columns - 1)], left = row[x > 0 ? x - 1 : 0];
            float* slope = &slopes[2 * (y * columns + x)];
            slope[0] = left - right;
            slope[1] = above[x] - below[x];
            sum += static_cast<double>(slope[0]) * static_cast<double>(slope[0]) +
                   static_cast<double>(slope[1]) * static_cast<double>(slope[1]);
        }
    }
    const double noise = 2 * kNoise / longer;
    const double rms = std::sqrt(sum / static_cast<double>(band.size()) + noise * noise);
    const auto gain = static_cast<float>(static_cast<double>(rms_slope) / rms);
    for (std::size_t i = 0; i < slopes.size(); i += 2) {
        const float x = gain * slopes[i] / kSteepest, y = gain * slopes[i + 1] / kSteepest;
        const float steps = 127 / std::sqrt(1 + x * x + y * y);
        relief.slopes[i] = static_cast<std::int8_t>(std::lround(steps * x));
        relief.slopes[i + 1] = static_cast<std::int8_t>(std::lround(steps * y));
    }
    return relief;
}

}  // namespace tribo::elastic
