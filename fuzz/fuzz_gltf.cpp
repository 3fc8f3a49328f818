// SPDX-License-Identifier: MIT
#include "files/model/gltf.hpp"
#include "model_invariants.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    return tribo::readers::check_model(tribo::files::read_gltf(bytes, {.source_name = "fuzz.glb"}));
}
