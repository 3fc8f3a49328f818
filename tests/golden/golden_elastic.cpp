// SPDX-License-Identifier: MIT
#include <array>
#include <vector>

#include "base/hash.hpp"
#include "base/math.hpp"
#include "elastic/sheet.hpp"
#include "golden/golden.hpp"

namespace tribo::golden {

// Two fingers over a sheet of one material, a map and the published model, until it rests.
std::uint64_t elastic() {
    Hash hash;
    elastic::Sheet sheet({150, 117, 0.4});
    const auto add = [&] {
        sheet.update_normals();
        for (int y = 0; y < sheet.size().height; ++y) {
            for (int x = 0; x < sheet.size().width; ++x) {
                hash.add(sheet.heights(y)[x]);
                hash.add(sheet.normals_x(y)[x]);
                hash.add(sheet.normals_y(y)[x]);
            }
        }
    };
    const auto rub = [&](const elastic::PressOptions& options, elastic::TimeScheme scheme) {
        for (int i = 0; i < 30; ++i) {
            const std::array<elastic::ContactEllipse, 2> contacts{
                {{10.0 + i, 20 + 4 * math::sin(0.3 * i), 4, 6, 0.1 * i, 1 + 0.05 * i, i / 60.0},
                 {40, 30, 3, 3, 0, 0.5, i / 60.0}}};
            sheet.press(contacts, options);
            sheet.step(i % 3 == 0 ? 0.016 : 0.021, scheme);
            if (i % 5 == 0) add();
        }
    };
    sheet.set_material({1.4, 0.1});
    rub({}, elastic::TimeScheme::exact);
    rub({elastic::ContactShape::point, false}, elastic::TimeScheme::exact);
    rub({elastic::ContactShape::area, true}, elastic::TimeScheme::implicit_euler);

    std::vector<std::uint8_t> levels(150 * 117);
    for (std::size_t i = 0; i < levels.size(); ++i) levels[i] = static_cast<std::uint8_t>(i * i % 251);
    std::array<elastic::SheetMaterial, 256> palette;
    for (int i = 0; i < 256; ++i) palette[static_cast<std::size_t>(i)] = {1 + 0.05 * i, 0.5 - 0.001 * i};
    sheet.set_materials(levels, palette);
    rub({}, elastic::TimeScheme::exact);
    sheet.press({});
    int steps = 0;
    while (sheet.step(0.016) && steps < 2000) ++steps;
    hash.add(steps);
    add();
    return hash.value();
}

}  // namespace tribo::golden
