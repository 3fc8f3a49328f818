// SPDX-License-Identifier: MIT
#include <cstdint>

#include "golden/golden.hpp"

extern "C" {

__attribute__((export_name("golden_count"))) std::uint32_t golden_count() {
    return static_cast<std::uint32_t>(tribo::golden::goldens().size());
}
__attribute__((export_name("golden_name"))) const char* golden_name(std::uint32_t which) {
    return tribo::golden::goldens()[which].name;
}
__attribute__((export_name("golden_hash"))) std::uint64_t golden_hash(std::uint32_t which) {
    return tribo::golden::goldens()[which].hash();
}
}
