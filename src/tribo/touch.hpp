// SPDX-License-Identifier: MIT
// A material under a finger: its image yields, and rubbing it sounds as it was recorded (docs/touch.md).
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

// A material that is pressed, drawn and rubbed.
class TouchMaterial {
  public:
    // A material file (docs/material.md) with its image and height map. Refused, with file and key: what
    // cannot be read, and options out of range.
    static FileResult<TouchMaterial> open(const std::string& file, const TouchOptions& options = {});
    TouchMaterial(TouchMaterial&&) noexcept;
    TouchMaterial& operator=(TouchMaterial&&) noexcept;
    ~TouchMaterial();

    const Warnings& warnings() const;  // that a plain image stands for a missing one, for instance
    int size_px() const;
    double width_mm() const;  // of the picture; x to the right, y down, from its top left corner

    // What presses from now on. A contact that does not touch (elastic::touches) counts as none.
    void press(std::span<const elastic::ContactEllipse> contacts);
    // Lets time pass; not above 0 or not finite: nothing happens. False: nothing moves any more.
    bool step(double duration_s);
    // How deep each pixel is pressed, mm, negative into the image; rows from the top.
    std::span<const float> depths_mm(int row) const;
    // Four bytes a pixel (RGBA, sRGB), from the top; at rest the image itself, byte by byte. `rgba` holds
    // size_px x size_px pixels (asserted).
    void draw(std::span<std::uint8_t> rgba) const;

    bool sounds() const;  // the material has voices
    // Speed along the surface and force into it; 0 or less of either, or what is not a number: silence.
    void rub(double speed_mm_per_s, double force_n);
    // The next frames, mono, full scale 1 and never beyond; silence without voices. Real-time safe.
    void render(std::span<float> out);

  private:
    struct State;
    explicit TouchMaterial(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace tribo
