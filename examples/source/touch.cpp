// Presses a finger into a material for half a second and writes the picture, as PPM, and the friction sound
// of a stroke, as raw floats.
//
//     touch examples/materials/sponge.json pressed.ppm rubbed.f32
#include <array>
#include <cstdio>
#include <fstream>
#include <tribo/touch.hpp>
#include <vector>

int main(int argc, char** argv) {
    if (argc < 4) return std::puts("usage: touch MATERIAL PICTURE SOUND"), 2;
    auto material = tribo::TouchMaterial::open(argv[1], {.size_px = 256});
    if (!material) return std::puts(material.error().text().c_str()), 2;
    for (const tribo::Warning& warning : material->warnings()) std::puts(warning.message().c_str());

    const double middle = 0.5 * material->width_mm();
    const tribo::elastic::ContactEllipse finger{.x_mm = middle, .y_mm = middle, .force_n = 0.8};
    material->press({&finger, 1});
    for (int frame = 0; frame < 30; ++frame) material->step(1.0 / 60);
    std::vector<std::uint8_t> rgba(4 * 256 * 256);
    material->draw(rgba);
    std::ofstream picture(argv[2], std::ios::binary);
    picture << "P6\n256 256\n255\n";
    for (std::size_t n = 0; n < rgba.size(); n += 4) {
        for (std::size_t k = 0; k < 3; ++k) picture.put(static_cast<char>(rgba[n + k]));
    }

    std::ofstream sound(argv[3], std::ios::binary);
    std::array<float, 480> block{};
    for (int n = 0; n < 100; ++n) {
        material->rub(n < 80 ? 120 : 0, 0.8);
        material->render(block);
        sound.write(reinterpret_cast<const char*>(block.data()), sizeof block);
    }
    const std::span<const float> row = material->depths_mm(128);
    std::printf("the middle is pressed in by %.3f mm\n", -row[128]);
}
