// SPDX-License-Identifier: MIT
#include "contact/texture_record.hpp"

#include <cmath>

namespace tribo::contact {
namespace {

using Heights = std::array<std::array<double, TextureRecord::kEdge>, TextureRecord::kEdge>;

// Middle of a triangle in the patch's coordinates (along, across), each from -1 to 1.
struct Middle {
    double u, v;
};

// Height of the middle and slopes of one triangle.
struct Facet {
    Middle middle;
    double height, by_along, by_across;
};

// Returns triangle 0 or 1 of the square with the lower corner (i, j) in u and v.
Facet facet(const Heights& h, int i, int j, int which, double half_along, double half_across) {
    const auto at = [&](int di, int dj) {
        return h[static_cast<std::size_t>(j + dj)][static_cast<std::size_t>(i + di)];
    };
    const double u0 = i - 1, v0 = j - 1;
    if (which == 0) {  // (0,0) (1,0) (1,1)
        return {{u0 + 2.0 / 3, v0 + 1.0 / 3},
                (at(0, 0) + at(1, 0) + at(1, 1)) / 3,
                (at(1, 0) - at(0, 0)) / half_along,
                (at(1, 1) - at(1, 0)) / half_across};
    }
    return {{u0 + 1.0 / 3, v0 + 2.0 / 3},  // (0,0) (1,1) (0,1)
            (at(0, 0) + at(1, 1) + at(0, 1)) / 3,
            (at(1, 1) - at(0, 1)) / half_along,
            (at(0, 1) - at(0, 0)) / half_across};
}

// Scales the part that varies along, the part that varies across and the part that varies with both, each
// with its own gain.
Heights limited(const Heights& h, const TextureBand& band) {
    if (band.along >= 1 && band.across >= 1) return h;
    std::array<double, 3> column{}, row{};
    double mean = 0;
    for (std::size_t j = 0; j < 3; ++j) {
        for (std::size_t i = 0; i < 3; ++i) {
            column[i] += h[j][i] / 3;
            row[j] += h[j][i] / 3;
            mean += h[j][i] / 9;
        }
    }
    const double both = std::min(band.along, band.across);
    Heights out{};
    for (std::size_t j = 0; j < 3; ++j) {
        for (std::size_t i = 0; i < 3; ++i) {
            const double along = column[i] - mean, across = row[j] - mean;
            // The level of the patch has the larger of the two gains.
            out[j][i] = mean * std::max(band.along, band.across) + band.along * along + band.across * across +
                        both * (h[j][i] - mean - along - across);
        }
    }
    return out;
}

Vec3 facet_normal(const TextureRecord& r, Vec3 across, const Facet& f) {
    return normalized(r.normal - f.by_along * r.along - f.by_across * across, r.normal);
}

}  // namespace

std::array<TexturedTriangle, 8> TextureRecord::triangles() const {
    std::array<TexturedTriangle, 8> out;
    const Vec3 left = across();
    const auto corner = [&](int i, int j) {
        return place_mm + (i - 1) * half_along_mm * along + (j - 1) * half_across_mm * left +
               height_mm[static_cast<std::size_t>(j)][static_cast<std::size_t>(i)] * normal;
    };
    std::size_t n = 0;
    for (int j = 0; j < 2; ++j) {
        for (int i = 0; i < 2; ++i) {
            for (int which = 0; which < 2; ++which) {
                const Facet f = facet(height_mm, i, j, which, half_along_mm, half_across_mm);
                TexturedTriangle& t = out[n++];
                t.corners_mm = which == 0 ? std::array{corner(i, j), corner(i + 1, j), corner(i + 1, j + 1)}
                                          : std::array{corner(i, j), corner(i + 1, j + 1), corner(i, j + 1)};
                t.normal = facet_normal(*this, left, f);
                t.height_mm = f.height;
            }
        }
    }
    return out;
}

Vec3 texture_normal(const TextureRecord& r, Vec3 place_mm, double press_mm, const TextureBand& band) {
    if (!(r.half_along_mm > 0 && r.half_across_mm > 0)) return {};
    const Vec3 left = r.across(), off = place_mm - r.place_mm;
    const double u = std::clamp(dot(off, r.along) / r.half_along_mm, -1.0, 1.0);
    const double v = std::clamp(dot(off, left) / r.half_across_mm, -1.0, 1.0);
    const Heights heights = limited(r.height_mm, band);
    Vec3 sum;
    double weights = 0;
    for (int j = 0; j < 2; ++j) {
        for (int i = 0; i < 2; ++i) {
            for (int which = 0; which < 2; ++which) {
                const Facet f = facet(heights, i, j, which, r.half_along_mm, r.half_across_mm);
                const double du = u - f.middle.u, dv = v - f.middle.v;
                const double inside = 1 - (du * du + dv * dv) / 1.5;
                if (inside <= 0) continue;
                const double w = inside * inside;
                weights += w;
                sum += w * ((press_mm + f.height) * facet_normal(r, left, f));
            }
        }
    }
    return weights > 0 ? sum / weights - press_mm * r.normal : Vec3{};
}

}  // namespace tribo::contact
