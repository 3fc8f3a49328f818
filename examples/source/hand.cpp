// Mills a job and lets a hand press down on the part, a millimetre deep, where the path says: a god-object's
// force, tick by tick.
//
//     hand examples/plate/plate.toml 40 30 12
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <haptics/contact/field_contact.hpp>
#include <tribo/mill.hpp>

int main(int argc, char** argv) {
    if (argc < 5) return std::puts("usage: hand JOB X Y Z"), 2;
    auto mill = tribo::Mill::open(argv[1]);
    if (!mill) return std::puts(mill.error().text().c_str()), 2;
    if (!mill->run()) return 1;

    tribo::haptics::FieldContact contact(mill->surface(), {.stiffness_n_per_mm = 0.5});
    const tribo::Vec3 above{std::atof(argv[2]), std::atof(argv[3]), std::atof(argv[4])};
    double most_n = 0;
    // A thousand ticks a second, 20 mm/s down.
    for (int tick = 0; tick < 2000; ++tick) {
        const tribo::Vec3 probe = above - tribo::Vec3{0, 0, 0.02 * tick};
        const tribo::haptics::ProbeContact felt = contact.update(probe);
        most_n = std::max(most_n, felt.force_n.z);
        if (felt.penetration_mm > 1) break;
    }
    std::printf("the hand is pushed up with %.2f N\n", most_n);
}
