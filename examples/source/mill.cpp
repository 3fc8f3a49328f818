// Mills a job or a program and says what each line of it needs; writes the sound as raw stereo floats.
//
//     mill examples/plate/plate.toml sound.f32
//     play -t f32 -r 48000 -c 2 sound.f32
#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <map>
#include <tribo/mill.hpp>
#include <tribo/sound.hpp>

using tribo::milling::CutRow;
using tribo::milling::RowForce;

int main(int argc, char** argv) {
    if (argc < 2) return std::puts("usage: mill JOB [SOUND]"), 2;
    auto mill = tribo::Mill::open(argv[1]);
    if (!mill) return std::puts(mill.error().text().c_str()), 2;
    auto sound = tribo::CutSound::of(*mill, {.ears = tribo::Ears::sphere});
    if (!sound) return std::puts(sound.error().text().c_str()), 2;

    std::ofstream file;
    if (argc > 2) file.open(argv[2], std::ios::binary);
    std::array<float, 512> block{};
    std::map<int, double> peak_n;  // by line
    const bool done = mill->run([&](const CutRow& row, const RowForce& force) {
        double& peak = peak_n[row.line];
        peak = std::max(peak, force.peaks.peak_force_n);
        if (!file.is_open()) return;
        sound->excite(mill->contact(row, force, row.start_s));
        while (sound->frames_left() > 0) {
            sound->render(block);
            file.write(reinterpret_cast<const char*>(block.data()), sizeof block);
        }
    });
    if (!done) return 1;
    for (const auto& [line, newton] : peak_n) std::printf("line %4d: peak %.1f N\n", line, newton);
    for (const tribo::Warning& warning : mill->warnings()) std::puts(warning.message().c_str());

    const tribo::session::MillTotals& totals = mill->totals();
    const tribo::TriangleMesh part = mill->part();
    std::printf("removed %.1f mm3, left %.1f mm3 in %zu triangles, energy balance %.4f\n", totals.removed_mm3,
                tribo::volume_mm3(part), part.triangles.size(), totals.energy_balance.value_or(0));
}
