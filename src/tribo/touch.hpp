// SPDX-License-Identifier: MIT
// A material under a finger: its image yields, and rubbing sounds as recorded (docs/touch.md).
//
//     auto material = tribo::TouchMaterial::open(argv[1], {.size_px = 256});
//     const tribo::elastic::ContactEllipse finger{.x_mm = middle, .y_mm = middle, .force_n = 0.8};
//     material->press({&finger, 1});
//     for (int frame = 0; frame < 30; ++frame) material->step(1.0 / 60);
//     material->draw(rgba);
//     material->rub(n < 80 ? 120 : 0, 0.8);
//     material->render(block);
//
// The whole program: examples/source/touch.cpp.
//
// press(), step() and draw() are called by one thread; rub() and render() by one, which may be another.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "base/file_result.hpp"
#include "elastic/contact_ellipse.hpp"

namespace tribo {

struct TouchOptions {
    int size_px = 512;              // of the picture, a square: 16 ... 4096
    double sample_rate_hz = 48000;  // of the friction sound, 1000 ... 192000
    std::uint64_t seed = 1;         // of its noise
};

// A material that can be pressed, drawn and rubbed.
class TouchMaterial {
  public:
    // Opens a material file (docs/material.md) with its image and height map. Refuses, with file and key,
    // files that cannot be read, and options out of range.
    static FileResult<TouchMaterial> open(const std::string& file, const TouchOptions& options = {});
    TouchMaterial(TouchMaterial&&) noexcept;
    TouchMaterial& operator=(TouchMaterial&&) noexcept;
    ~TouchMaterial();

    const Warnings& warnings() const;  // for example a plain image in place of a missing one
    int size_px() const;
    double width_mm() const;  // of the picture; x to the right, y down, from the top left corner

    // Sets the contacts. A contact that does not touch (elastic::touches) has no effect.
    void press(std::span<const elastic::ContactEllipse> contacts);
    // Advances the time; values <= 0 or not finite have no effect. Returns false when nothing moves any more.
    bool step(double duration_s);
    // Depth of each pixel, mm, negative into the image; rows from the top.
    std::span<const float> depths_mm(int row) const;
    // Draws four bytes a pixel (RGBA, sRGB), from the top; at rest exactly the bytes of the image. `rgba`
    // must have size_px x size_px pixels (asserted).
    void draw(std::span<std::uint8_t> rgba) const;

    bool sounds() const;  // the material has voices
    // Sets the speed along the surface and the force into it. Values <= 0 and NaN give silence.
    void rub(double speed_mm_per_s, double force_n);
    // Renders the next frames, mono, within full scale 1; silence without voices. Real-time safe.
    void render(std::span<float> out);

  private:
    struct State;
    explicit TouchMaterial(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace tribo
