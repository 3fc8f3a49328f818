// SPDX-License-Identifier: MIT
// Any bytes give a file within the limit, or an error with a remedy.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "files/zip.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::uint64_t limit_bytes = 1 << 16;
    const auto file =
        tribo::files::unzip({reinterpret_cast<const char*>(data), size}, ".json", limit_bytes, "fuzz.zip");
    if (file && file->size() > limit_bytes) std::abort();
    if (!file && (file.error().cause.empty() || file.error().remedy.empty())) std::abort();
    return 0;
}
