// SPDX-License-Identifier: MIT
// Any text as the scene of a binary glTF whose buffer is good: what breaks is the structure, the extensions,
// the accessors, not the lengths of the chunks (fuzz_gltf).
#include <string>

#include "files/model/gltf.hpp"
#include "model_invariants.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::size_t largest = 1 << 16, buffer = 1024;
    if (size > largest) return 0;
    const auto number = [](std::size_t value) {
        std::string bytes;
        for (int k = 0; k < 4; ++k) bytes += static_cast<char>(value >> 8 * k & 255);
        return bytes;
    };
    std::string text(reinterpret_cast<const char*>(data), size);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    // Small whole numbers as bytes, shorts, words and floats alike.
    std::string binary;
    for (std::size_t n = 0; n < buffer; ++n) binary += static_cast<char>(n % 4 == 3 ? 0x3F : n / 4 % 7 * 16);
    const std::string chunks =
        number(text.size()) + "JSON" + text + number(binary.size()) + std::string("BIN\0", 4) + binary;
    const std::string bytes = "glTF" + number(2) + number(12 + chunks.size()) + chunks;
    return tribo::readers::check_model(tribo::files::read_gltf(bytes, {.source_name = "fuzz.glb"}));
}
