// SPDX-License-Identifier: MIT
// A material file with the images that it names, as a square picture. Not installed.
#pragma once

#include <string>

#include "base/file_result.hpp"
#include "elastic/picture.hpp"
#include "elastic/sheet.hpp"
#include "files/image/image_file.hpp"
#include "material/material.hpp"

namespace tribo {

struct TouchImage {
    material::Material material;
    files::Image image;           // size_px x size_px: the top left square
    elastic::SmallRelief relief;  // of the same pixels
    double width_mm = 0;          // of the picture
    Warnings warnings;

    elastic::SheetSize sheet_size() const;
    elastic::SheetMaterial sheet_material() const;
    elastic::Finish finish() const;  // borrows the relief
};

// The force of a full press, as on a page.
inline constexpr double kFullForceN = 2;

// If the image or width_mm is missing, uses a plain image or kAssumedWidthMm, with a warning.
inline constexpr double kAssumedWidthMm = 100;
FileResult<TouchImage> read_touch_image(const std::string& material_file, int size_px);

}  // namespace tribo
