// SPDX-License-Identifier: MIT
#include "tribo/touch_image.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>

#include "base/text/decimal.hpp"
#include "material/material_json.hpp"

namespace tribo {
namespace {

files::Image plain_image() {
    return {1, 1, {206, 200, 190, 255}};
}

}  // namespace

elastic::SheetSize TouchImage::sheet_size() const {
    return {image.width, image.height, width_mm / image.width};
}

elastic::SheetMaterial TouchImage::sheet_material() const {
    return {material.stiffness_n_per_mm, material.viscosity_n_s_per_mm};
}

elastic::Finish TouchImage::finish() const {
    return {.relief = &relief,
            .gloss = static_cast<float>(material.gloss),
            .roughness = static_cast<float>(material.roughness),
            .full_mm = static_cast<float>(kFullForceN / material.stiffness_n_per_mm),
            .pile = static_cast<float>(material.pile)};
}

FileResult<TouchImage> read_touch_image(const std::string& material_file, int size_px) {
    TouchImage touch;
    FileResult<material::Material> read = material::read_material(material_file);
    if (!read) return std::unexpected(read.error());
    touch.material = *std::move(read);
    const material::Material& m = touch.material;
    if (auto good = elastic::check(touch.sheet_material()); !good) {
        Error error = good.error();
        error.file = material_file;
        return std::unexpected(FileFailure(error));
    }
    const auto beside = [&](const std::string& file) {
        return (std::filesystem::path(material_file).parent_path() / file).string();
    };
    files::Image image = plain_image();
    std::optional<files::Image> map;
    if (m.image.empty()) {
        touch.warnings.push_back({material_file, 0, "the material has no image: a plain one stands for it"});
    } else {
        FileResult<files::Image> found = files::read_image(beside(m.image));
        if (!found) return std::unexpected(found.error());
        image = *std::move(found);
    }
    if (!m.height_map.empty()) {
        FileResult<files::Image> found = files::read_height_map(beside(m.height_map), image);
        if (!found) return std::unexpected(found.error());
        map = *std::move(found);
    }
    touch.width_mm = m.width_mm;
    if (!(touch.width_mm > 0)) {
        touch.width_mm = kAssumedWidthMm;
        touch.warnings.push_back({material_file, 0, "no width_mm: the image is taken to be 100 mm wide"});
    }
    touch.width_mm *= static_cast<double>(std::min(image.width, image.height)) / image.width;
    if (image.width != image.height) {
        touch.warnings.push_back({material_file, 0,
                                  "the image is no square: its upper left one is taken, " +
                                      format_decimal(touch.width_mm) + " mm wide"});
    }
    touch.image = files::square_at(image, size_px);
    const files::Image heights = map ? files::square_at(*map, size_px) : touch.image;
    touch.relief = elastic::small_relief(heights.rgba, size_px, size_px, static_cast<float>(m.relief_slope));
    return touch;
}

}  // namespace tribo
