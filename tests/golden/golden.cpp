// SPDX-License-Identifier: MIT
#include "golden/golden.hpp"

namespace tribo::golden {

std::span<const Golden> goldens() {
    static constexpr Golden kGoldens[] = {{"math", math},
                                          {"decimal", decimal},
                                          {"noise_hash", noise_hash},
                                          {"motion", motion},
                                          {"field", field},
                                          {"force", force},
                                          {"dynamics", dynamics},
                                          {"elastic", elastic},
                                          {"formats", readers},
                                          {"mill_three_axes", mill_three_axes},
                                          {"mill_five_axes", mill_five_axes},
                                          {"mill_profiles", mill_profiles},
                                          {"audit", audit},
                                          {"surface", surface},
                                          {"haptics", haptics},
                                          {"learning", learning}};
    return kGoldens;
}

}  // namespace tribo::golden
