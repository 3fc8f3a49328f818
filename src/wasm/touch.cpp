// SPDX-License-Identifier: MIT
// The C ABI of touch.wasm for the page: a sheet. Handles are created by sheet_create and ended by
// sheet_destroy. Numbers out of range are clamped; NaN is ignored, as in the rooms. Buffers move when memory
// grows: request them after each call.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "elastic/pile.hpp"
#include "elastic/sheet.hpp"
#include "elastic/small_relief.hpp"
#include "material/material_schema.hpp"

#define TRIBO_EXPORT(name) extern "C" __attribute__((export_name(#name)))

namespace {

using tribo::elastic::ContactEllipse;
using tribo::elastic::Sheet;
using tribo::elastic::SheetMaterial;

constexpr std::uint32_t kMostContacts = 16;

struct TouchSheet {
    Sheet sheet;
    std::array<ContactEllipse, kMostContacts>
        contacts{};  // seven doubles each, in the order of ContactEllipse
    std::array<std::int32_t, 4> changes{};
    std::optional<tribo::elastic::Pile> pile{};
};

double within(double value, tribo::Range range) {
    return value >= range.min ? std::min(value, range.max) : range.min;
}

SheetMaterial material(double stiffness_n_per_mm, double viscosity_n_s_per_mm) {
    return {within(stiffness_n_per_mm, tribo::material::kStiffness),
            within(viscosity_n_s_per_mm, tribo::material::kViscosity)};
}

}  // namespace

TRIBO_EXPORT(sheet_create) TouchSheet* sheet_create(int width, int height, double spacing_mm) {
    const auto nodes = [](int n) { return std::clamp(n, 1, tribo::elastic::kMostNodesPerSide); };
    return new TouchSheet{Sheet({nodes(width), nodes(height), within(spacing_mm, {1e-6, 1e6})})};
}

TRIBO_EXPORT(sheet_destroy) void sheet_destroy(TouchSheet* s) {
    delete s;
}

TRIBO_EXPORT(sheet_set_material)
void sheet_set_material(TouchSheet* s, double stiffness_n_per_mm, double viscosity_n_s_per_mm) {
    s->sheet.set_material(material(stiffness_n_per_mm, viscosity_n_s_per_mm));
}

// Sets levels, one byte per node, row by row. `palette`: stiffness and viscosity of each of the 256 levels.
TRIBO_EXPORT(sheet_set_materials)
void sheet_set_materials(TouchSheet* s, const std::uint8_t* levels, const double* palette) {
    std::array<SheetMaterial, 256> materials;
    for (std::size_t i = 0; i < materials.size(); ++i) {
        materials[i] = material(palette[2 * i], palette[2 * i + 1]);
    }
    const auto& size = s->sheet.size();
    s->sheet.set_materials({levels, static_cast<std::size_t>(size.width * size.height)}, materials);
}

// Address for contacts, to be written before sheet_press: x_mm, y_mm, half_width_mm, half_height_mm,
// angle_rad, force_n, held_s; doubles.
TRIBO_EXPORT(sheet_contacts) ContactEllipse* sheet_contacts(TouchSheet* s) {
    static_assert(sizeof(ContactEllipse) == 7 * sizeof(double));
    return s->contacts.data();
}

TRIBO_EXPORT(sheet_press)
void sheet_press(TouchSheet* s, std::uint32_t count, std::uint32_t point, std::uint32_t as_published) {
    tribo::elastic::PressOptions options;
    if (point != 0) options.shape = tribo::elastic::ContactShape::point;
    options.as_published = as_published != 0;
    s->sheet.press({s->contacts.data(), std::min(count, kMostContacts)}, options);
}

// Brushes the pile with contact `n`, which has moved by (dx, dy) to its place.
TRIBO_EXPORT(sheet_brush) void sheet_brush(TouchSheet* s, std::uint32_t n, double dx_mm, double dy_mm) {
    if (!s->pile) s->pile.emplace(s->sheet.size());
    s->pile->brush(s->contacts[std::min(n, kMostContacts - 1)], dx_mm, dy_mm);
}

// Returns x and y of the lean at each node of the pile; null before the first brush.
TRIBO_EXPORT(sheet_leans) const float* sheet_leans(const TouchSheet* s) {
    return s->pile ? s->pile->leans().data() : nullptr;
}

// Returns 1 while anything moves.
TRIBO_EXPORT(sheet_step)
std::uint32_t sheet_step(TouchSheet* s, double duration_s, std::uint32_t as_published) {
    using tribo::elastic::TimeScheme;
    const bool moves =
        s->sheet.step(duration_s, as_published != 0 ? TimeScheme::implicit_euler : TimeScheme::exact);
    const bool rises = s->pile && s->pile->rise(duration_s);
    return moves || rises;
}

// Returns x, y, width, height of the region that changed since the last call; width 0: no change.
TRIBO_EXPORT(sheet_changes) const std::int32_t* sheet_changes(TouchSheet* s) {
    const tribo::elastic::NodeRect rect = s->sheet.take_changes();
    s->changes = {rect.x, rect.y, rect.width, rect.height};
    return s->changes.data();
}

// Returns the first node of the first row. Rows are sheet_stride floats apart.
TRIBO_EXPORT(sheet_heights) const float* sheet_heights(const TouchSheet* s) {
    return s->sheet.heights(0);
}
TRIBO_EXPORT(sheet_stride) std::int32_t sheet_stride(const TouchSheet* s) {
    return static_cast<std::int32_t>(s->sheet.stride());
}

// Computes the small relief of width x height pixels of four bytes, in place. The first two bytes of each
// pixel become the slopes x and y of SmallRelief, with an offset of 128.
TRIBO_EXPORT(sheet_small_relief)
void sheet_small_relief(std::uint8_t* rgba, int width, int height, double rms_slope) {
    const std::size_t bytes =
        std::size_t{4} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    const auto relief = tribo::elastic::small_relief(
        {rgba, bytes}, width, height, static_cast<float>(within(rms_slope, tribo::material::kShare)));
    for (std::size_t i = 0; i < relief.slopes.size(); ++i) {
        rgba[2 * i - i % 2] = static_cast<std::uint8_t>(relief.slopes[i] + 128);
    }
}
