// SPDX-License-Identifier: MIT
// The viscoelastic sheet: an image as a grid of one node per pixel, each a spring and a damper side by side
// that yields along z alone (touch paper, section 2.2, eq. 3): P = K E + nu dE/dt.
//
// Node (i, j) stands at ((i + 0.5), (j + 0.5)) spacings from the image's top left corner. Displacements are
// in mm, negative into the image, float32, in rows from the top. Only tiles of 16 x 16 nodes that move are
// computed; a sheet at rest is exactly 0 everywhere and costs nothing. Whatever comes in, every number stays
// finite. One thread at a time; memory is taken by the constructor, set_levels() and the first normals().
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
    double viscosity_n_s_per_mm = 0.3;  // nu: 0..1e6; nu / K is the time to 63 % of the way
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
    // The size is in range (asserted).
    explicit Sheet(SheetSize size);

    // One material everywhere. It is in range (asserted).
    void set_material(const SheetMaterial& material);
    // One that differs: levels of width x height nodes, row by row, and what each level means.
    void set_materials(std::span<const std::uint8_t> levels, std::span<const SheetMaterial, 256> palette);

    // What presses from now on; pressures of several contacts add up. Contacts that do not touch()
    // count as none. Costs nothing when nothing changed.
    void press(std::span<const ContactEllipse> contacts, const PressOptions& options = {});
    // Lets `duration_s` pass; not above 0 or not finite: nothing happens. False: nothing moves any more.
    bool step(double duration_s, TimeScheme scheme = TimeScheme::exact);
    // Back to exact rest, pressed by nothing.
    void reset();

    bool moving() const;
    const SheetSize& size() const { return size_; }
    // Floats from row to row, of all planes.
    std::ptrdiff_t stride() const { return stride_; }
    const float* heights(int row) const { return plane(heights_, row); }
    const float* pressures(int row) const { return plane(pressures_, row); }

    // Brings the normals of what moved up to date. They are (x, y, sqrt(1 - x^2 - y^2)), out of the image.
    void update_normals();
    const float* normals_x(int row) const { return plane(normals_x_, row); }
    const float* normals_y(int row) const { return plane(normals_y_, row); }

    // The rectangle that holds all nodes moved since the last call.
    NodeRect take_changes();

  private:
    enum Flag : std::uint8_t { kPressed = 1, kMoving = 2, kRedraw = 4, kRelight = 8 };

    // Rows start kGuard floats into the plane, and as many stand free between them.
    static constexpr std::ptrdiff_t kGuard = 8;

    // A number for each node. Processors hold a store back behind loads whose addresses agree in the lowest
    // twelve bits; so that node i of one plane is not at such an address of another, planes begin `skew`
    // floats into their memory: normals in WebAssembly took more than twice as long without.
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
