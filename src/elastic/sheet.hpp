// SPDX-License-Identifier: MIT
// The viscoelastic sheet: an image as a grid of one node per pixel. Each node is a spring and a damper in
// parallel and moves along z only (touch paper, section 2.2, eq. 3): P = K E + nu dE/dt.
//
// Node (i, j) is at ((i + 0.5), (j + 0.5)) spacings from the image's top left corner. Displacements are in
// mm, negative into the image, float32, in rows from the top. Only tiles of 16 x 16 nodes that move are
// computed. A sheet at rest is exactly 0 everywhere and costs nothing. Every number stays finite for any
// input. One thread at a time; only the constructor, set_materials() and the first update_normals() allocate
// memory.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/result.hpp"
#include "elastic/contact_ellipse.hpp"
#include "elastic/pressure.hpp"
#include "elastic/sheet_kernels.hpp"

namespace tribo::elastic {

inline constexpr int kMostNodesPerSide = 4096;

struct SheetSize {
    int width = 0, height = 0;  // nodes, 1..kMostNodesPerSide
    double spacing_mm = 0;      // from node to node, > 0
};

struct SheetMaterial {
    double stiffness_n_per_mm = 4;      // K: force over displacement, 1e-3..1e6
    double viscosity_n_s_per_mm = 0.3;  // nu: 0..1e6; nu / K is the time to 63 % of the displacement
};
// Refuses numbers outside of the ranges above.
Result<void> check(const SheetMaterial& material);

enum class TimeScheme {
    exact,           // E += (P / K - E) (1 - e^(-Ts K / nu)): the same at any frame time
    implicit_euler,  // eq. 3 as printed
};

struct PressOptions {
    ContactShape shape = ContactShape::area;
    bool as_published = false;  // equations 1 and 2; the radius is the contact's half width

    bool operator==(const PressOptions&) const = default;
};

// Nodes x..x+width-1, y..y+height-1.
struct NodeRect {
    int x = 0, y = 0, width = 0, height = 0;
    bool empty() const { return width == 0; }
};

class Sheet {
  public:
    // The size must be in range (asserted).
    explicit Sheet(SheetSize size);

    // One material everywhere. It must be in range (asserted).
    void set_material(const SheetMaterial& material);
    // A material that varies: levels of width x height nodes, row by row, and the material of each level.
    void set_materials(std::span<const std::uint8_t> levels, std::span<const SheetMaterial, 256> palette);

    // Sets the contacts from now on; pressures of several contacts add up. Contacts that do not touch() are
    // ignored. Costs nothing if nothing changed.
    void press(std::span<const ContactEllipse> contacts, const PressOptions& options = {});
    // Advances the time by `duration_s`. A value that is not above 0 or not finite changes nothing. Returns
    // false if nothing moves any more.
    bool step(double duration_s, TimeScheme scheme = TimeScheme::exact);
    // Returns the sheet to exact rest without contacts.
    void reset();

    bool moving() const;
    const SheetSize& size() const { return size_; }
    // Floats from row to row, in all planes.
    std::ptrdiff_t stride() const { return stride_; }
    const float* heights(int row) const { return plane(heights_, row); }
    const float* pressures(int row) const { return plane(pressures_, row); }

    // Updates the normals of the nodes that moved. They are (x, y, sqrt(1 - x^2 - y^2)), out of the image.
    void update_normals();
    const float* normals_x(int row) const { return plane(normals_x_, row); }
    const float* normals_y(int row) const { return plane(normals_y_, row); }

    // Returns the rectangle that contains all nodes moved since the last call.
    NodeRect take_changes();

  private:
    enum Flag : std::uint8_t { kPressed = 1, kMoving = 2, kRedraw = 4, kRelight = 8 };

    // Rows start kGuard floats into the plane, with as many free floats between them.
    static constexpr std::ptrdiff_t kGuard = 8;

    // One number for each node. Processors delay a store behind loads whose addresses agree in the lowest
    // twelve bits. Therefore planes begin `skew` floats into their memory, so that node i of one plane has
    // another such address than node i of the others. Without it, normals in WebAssembly took more than twice
    // as long.
    struct Plane {
        std::ptrdiff_t skew;
        std::vector<float> values{};
    };
    static constexpr std::ptrdiff_t kSkew = 256;

    float* plane(Plane& p, int row) { return p.values.data() + p.skew + kGuard + row * stride_; }
    const float* plane(const Plane& p, int row) const {
        return p.values.data() + p.skew + kGuard + row * stride_;
    }
    void resize(Plane& p);
    int rows_of(int tile_row) const;
    std::uint8_t& flags(int tile_x, int tile_y) {
        return flags_[static_cast<std::size_t>(tile_y * tiles_x_ + tile_x)];
    }
    void wake_all();
    void clear_pressure();
    NodeRect tiles_under(const ContactEllipse& contact, double reach) const;
    void press_default(const ContactEllipse& contact, bool over);
    void press_published(const ContactEllipse& contact);
    void step_run(int tile_x, int tiles, int tile_y, const float* shares);
    void settle(int tile_x, int tile_y, const TileMotion& motion);
    void relight_run(int tile_x, int tiles, int tile_y);
    NormalRows normal_rows(int row, int rows, int columns) const;

    SheetSize size_;
    int tiles_x_ = 0, tiles_y_ = 0, padded_ = 0;
    std::ptrdiff_t stride_ = 0;
    Plane heights_{0}, pressures_{kSkew}, normals_x_{2 * kSkew}, normals_y_{3 * kSkew};
    std::vector<std::uint8_t> flags_;   // of tiles
    std::vector<std::uint8_t> levels_;  // empty: one material
    std::array<SheetMaterial, 256> palette_{};
    std::array<float, 256> compliance_mm_per_n_{};
    std::vector<ContactEllipse> contacts_, touching_;
    PressOptions options_;
};

}  // namespace tribo::elastic
