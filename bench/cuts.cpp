// SPDX-License-Identifier: MIT
#include "cuts.hpp"

#include <cmath>
#include <cstdio>

#include "field/shape/box_shape.hpp"

namespace tribo::bench {

milling::Cutter end_mill(milling::CutterKind kind, double diameter_mm, int flutes, double length_mm) {
    milling::Cutter cutter;
    cutter.kind = kind;
    cutter.diameter_mm = diameter_mm;
    cutter.flutes = flutes;
    cutter.length_mm = length_mm;
    return cutter;
}

std::unique_ptr<field::CarvedField> block(const Box3& box_mm, double cell_mm) {
    return std::make_unique<field::CarvedField>(std::make_unique<field::BoxShape>(box_mm), cell_mm);
}

motion::Move straight(Vec3 from, Vec3 to) {
    motion::Move move;
    move.start.tip_mm = from;
    move.end.tip_mm = to;
    move.feed_mm_per_min = 1000;
    return move;
}

std::vector<motion::Move> pass(Vec3 from, Vec3 to, double move_mm) {
    const double whole = distance(from, to);
    const int count = static_cast<int>(std::ceil(whole / move_mm - 1e-9));
    std::vector<motion::Move> moves;
    for (int n = 0; n < count; ++n) {
        const double a = n * move_mm / whole, b = std::min(1.0, (n + 1) * move_mm / whole);
        moves.push_back(straight(lerp(from, to, a), lerp(from, to, b)));
    }
    return moves;
}

Cuts half_immersion(double move_mm, int passes) {
    Cuts cuts;
    cuts.cutter = end_mill(milling::CutterKind::flat, 12, 4, 30);
    cuts.block_mm = {{-10, -10, -10}, {100, 6.0 * passes + 10, 0}};
    for (int n = 0; n < passes; ++n) {
        cuts.passes.push_back(pass({-5.03, 6.0 * n, -5.017}, {84.97, 6.0 * n, -5.017}, move_mm));
    }
    return cuts;
}

Cuts layers(std::size_t moves) {
    Cuts cuts;
    cuts.cutter = end_mill(milling::CutterKind::flat, 6, 2, 30);
    cuts.block_mm = {{0, 0, -20}, {100, 100, 0}};
    std::size_t count = 0;
    for (int layer = 1; count < moves; ++layer) {
        const double z = -layer - 0.017;
        for (int n = 0; n < 33 && count < moves; ++n) {
            const double y = 1.5 + 3 * n;
            const bool forth = n % 2 == 0;
            cuts.passes.push_back(pass({forth ? 0.0 : 100.0, y, z}, {forth ? 100.0 : 0.0, y, z}, 0.5));
            if (cuts.passes.back().size() > moves - count) cuts.passes.back().resize(moves - count);
            count += cuts.passes.back().size();
        }
    }
    return cuts;
}

FinishingJob::FinishingJob() : cutter(end_mill(milling::CutterKind::flat, 1, 2, 6)) {
    constexpr int kPasses = 130, kMoves = 123;
    tips.push_back({0, 0, 1});
    for (int j = 0; j < kPasses; ++j) {
        for (int i = 0; i <= kMoves; ++i) {
            const double along = 65.0 * i / kMoves, x = j % 2 == 0 ? along : 65 - along, y = 0.25 + 0.5 * j;
            tips.push_back({x, y, -1 - 0.5 * std::sin(0.6 * x) * std::cos(0.5 * y)});
        }
    }
}

std::string FinishingJob::gcode() const {
    std::string text = "G21 G90 G17 G94\nS20000 M3\nG0 X0 Y0 Z1\nF1000\n";
    for (std::size_t n = 1; n < tips.size(); ++n) {
        char line[80];
        std::snprintf(line, sizeof line, "G1 X%.4f Y%.4f Z%.4f\n", tips[n].x, tips[n].y, tips[n].z);
        text += line;
    }
    return text + "M5\nM30\n";
}

std::string FinishingJob::toml(const std::string& gcode_name) const {
    return "[stock]\nbox_mm = [[0, 0, -10], [65, 65, 0]]\n\n"
           "[cutter]\nkind = \"flat\"\ndiameter_mm = 1.0\nflutes = 2\nhelix_deg = 30.0\nlength_mm = 6.0\n\n"
           "[material]\nname = \"al7075-t6\"\n\n"
           "[process]\nspindle_rpm = 20000\nfeed_mm_per_min = 1000\n\n"
           "[path]\ngcode = \"" +
           gcode_name + "\"\n";
}

std::vector<motion::Move> moves_through(const std::vector<Vec3>& tips) {
    std::vector<motion::Move> moves;
    for (std::size_t n = 1; n < tips.size(); ++n) {
        moves.push_back(straight(tips[n - 1], tips[n]));
        moves.back().line = static_cast<int>(n);
    }
    return moves;
}

session::MillSetup session_setup(const Box3& block_mm, const milling::Cutter& cutter,
                                 const std::vector<motion::Move>& moves, double cell_mm) {
    session::MillSetup setup;
    setup.moves = moves;
    setup.cutter_of_move.assign(moves.size(), 0);
    setup.rpm_of_move.assign(moves.size(), 20000);
    setup.cutters = {cutter};
    setup.coefficients = kAluminium;
    setup.blank = std::make_unique<field::BoxShape>(block_mm);
    setup.blank_volume_mm3 = block_mm.volume();
    setup.cell_mm = cell_mm;
    return setup;
}

}  // namespace tribo::bench
