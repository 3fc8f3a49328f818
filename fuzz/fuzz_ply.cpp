// SPDX-License-Identifier: MIT
#include "model_invariants.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return tribo::readers::check_model(data, size, tribo::readers::ModelFormat::ply);
}
