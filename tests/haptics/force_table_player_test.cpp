// SPDX-License-Identifier: MIT
#include "haptics/servo/force_table_player.hpp"

#include <atomic>
#include <gtest/gtest.h>
#include <thread>

namespace tribo::haptics {
namespace {

// A steady force over ten seconds, cut into pieces so that tables differ in size.
contact::ForceTable steady(double newtons, int pieces) {
    std::vector<contact::ForceStretch> cut;
    for (int n = 0; n < pieces; ++n) {
        contact::ForceStretch s;
        s.start_s = 10.0 * n / pieces;
        s.end_s = 10.0 * (n + 1) / pieces - (n % 2 == 0 ? 0 : 1e-6);  // pauses
        s.rate_rad_per_s = 600;
        s.spectrum.harmonics.resize(1);
        s.spectrum.harmonics[0].z = newtons;
        cut.push_back(s);
    }
    const contact::ForceTableOptions options;
    return build_force_table(force_function(cut, options), options);
}

TEST(ForceTablePlayer, plays_whole_tables_while_others_are_swapped_in) {
    ForceTablePlayer force(1000);
    EXPECT_EQ(force.force_n(1), Vec3{});  // none yet
    force.replace(steady(100, 2), {});
    ASSERT_NEAR(force.force_n(1).z, 1, 1e-6);
    std::atomic<bool> over{false};
    std::thread rebuild([&] {
        for (int n = 0; n < 300; ++n) force.replace(steady(n % 2 == 0 ? 200 : 100, 1 + n % 40), {});
        over = true;
    });
    double t_s = 0;
    while (!over) {
        t_s = t_s > 9.9 ? 0 : t_s + 1e-3;
        const double z = force.force_n(t_s).z;
        // One table's force or the other's, or none in a pause; never anything between.
        ASSERT_TRUE(z == 0 || std::abs(z - 1) < 1e-6 || std::abs(z - 2) < 1e-6) << z;
    }
    rebuild.join();
}

}  // namespace
}  // namespace tribo::haptics
