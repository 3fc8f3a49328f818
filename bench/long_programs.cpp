// SPDX-License-Identifier: MIT
#include "long_programs.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "base/vec3.hpp"
#include "child.hpp"
#include "harness.hpp"

namespace tribo::bench {
namespace {

// The text of a program, move by move.
class Program {
  public:
    explicit Program(bool is_apt) : is_apt_(is_apt) {
        text_ = is_apt ? "UNITS/MM\nMULTAX/ON\nSPINDL/RPM,8000,CLW\n" : "G21 G90 G17 G94\nS20000 M3\nF1000\n";
    }
    void rapid(double x, double y, double z) {
        if (is_apt_) text_ += "RAPID\n";
        go("G0", x, y, z, {0, 0, 1});
        if (is_apt_) text_ += "FEDRAT/MMPM,1000\n";
    }
    void feed(double x, double y, double z, Vec3 axis = {0, 0, 1}) {
        go("G1", x, y, z, axis);
        ++moves_;
    }
    std::size_t moves() const { return moves_; }
    void write(const std::filesystem::path& file) const {
        std::ofstream(file) << text_ << (is_apt_ ? "FINI\n" : "M5\nM30\n");
    }

  private:
    void go(const char* word, double x, double y, double z, Vec3 axis) {
        char line[120];
        if (is_apt_) {
            std::snprintf(line, sizeof line, "GOTO/%.4f,%.4f,%.4f,%.6f,%.6f,%.6f\n", x, y, z, axis.x, axis.y,
                          axis.z);
        } else {
            std::snprintf(line, sizeof line, "%s X%.4f Y%.4f Z%.4f\n", word, x, y, z);
        }
        text_ += line;
    }

    bool is_apt_;
    std::string text_;
    std::size_t moves_ = 0;
};

struct Block {
    double x = 0, y = 0, z = 0;  // from (0, 0, -z) to (x, y, 0)
};

// Blocks of 60 mm side by side, each with 60 layers.
template <class Layer>
Block in_layers(Program& program, std::size_t moves, const Layer& layer) {
    constexpr int kBlocksInRow = 6, kLayers = 60;
    constexpr double kSpacing = 60, kDown = 0.05;
    for (int block = 0;; ++block) {
        const double x = kSpacing * (block % kBlocksInRow) + 5, y = kSpacing * (block / kBlocksInRow) + 5;
        program.rapid(x, y, 2);
        for (int n = 1; n <= kLayers; ++n) {
            program.feed(x, y, -kDown * n);
            layer(x, y, -kDown * n);
            if (program.moves() >= moves)
                return {kSpacing * std::min(block + 1, kBlocksInRow), kSpacing * (block / kBlocksInRow + 1),
                        10};
        }
        program.rapid(x, y, 2);
    }
}

Block contour(Program& program, std::size_t moves) {
    return in_layers(program, moves, [&](double x, double y, double z) {
        for (int n = 1; n <= 50; ++n) program.feed(x + n, y, z);
        for (int n = 1; n <= 47; ++n) program.feed(x + 50, y + n, z);
        for (int n = 49; n >= 0; --n) program.feed(x + n, y + 47.5, z);
        for (int n = 46; n >= 0; --n) program.feed(x, y + n, z);
    });
}

Block pocket(Program& program, std::size_t moves) {
    return in_layers(program, moves, [&](double x, double y, double z) {
        for (int row = 0; row < 13; ++row) {
            for (int n = 0; n < 15; ++n) program.feed(x + (row % 2 == 0 ? n : 14 - n), y + 1.5 * row, z);
        }
    });
}

Block raster(Program& program, std::size_t moves) {
    constexpr double kLength = 100, kMove = 0.5, kAside = 0.4;
    const auto z = [](double x, double y) { return -1.5 - 0.5 * std::sin(0.15 * x) * std::cos(0.12 * y); };
    program.rapid(0, 0, 2);
    for (int line = 0;; ++line) {
        const double y = 0.2 + kAside * line;
        for (int n = 0; n <= static_cast<int>(kLength / kMove); ++n) {
            const double x = line % 2 == 0 ? kMove * n : kLength - kMove * n;
            program.feed(x, y, z(x, y));
        }
        if (program.moves() >= moves) return {kLength, y + 1, 10};
    }
}

Block tilted(Program& program, std::size_t moves) {
    constexpr double kLength = 300, kMove = 3, kDown = 1;
    constexpr int kLines = 350;
    for (int layer = 0;; ++layer) {
        for (int line = 0; line < kLines; ++line) {
            const double y = (line + 0.5) * kLength / kLines;
            for (int n = 0; n <= static_cast<int>(kLength / kMove); ++n) {
                const double x = line % 2 == 0 ? kMove * n : kLength - kMove * n;
                const double turn = 0.35 * std::sin(0.05 * x + 0.02 * y);
                const Vec3 axis = normalized(Vec3{std::sin(turn), 0.2 * std::cos(0.03 * x), std::cos(turn)});
                const double z = -2 - kDown * layer - std::sin(0.04 * x) * std::cos(0.03 * y);
                if (n == 0 && line == 0) program.rapid(x, y, 20);
                program.feed(x, y, z, axis);
            }
            if (program.moves() >= moves) return {kLength, kLength, 40};
        }
    }
}

struct Kind {
    const char* name;
    const char* cutter;
    Block (*write)(Program&, std::size_t moves);
    const char* resolution;
    bool is_apt = false;
};

const Kind& kind_of(LongProgram kind) {
    static constexpr const char* kFlat = "kind = \"flat\"\ndiameter_mm = 3.0\nlength_mm = 9.0\n";
    static constexpr Kind kinds[] = {
        {"contour", kFlat, contour, "0.1"},
        {"pocket", kFlat, pocket, "0.1"},
        {"raster", "kind = \"ball\"\ndiameter_mm = 6.0\nlength_mm = 12.0\n", raster, "0.2"},
        {"tilted", "kind = \"ball\"\ndiameter_mm = 12.0\nlength_mm = 40.0\n", tilted, "1", true}};
    return kinds[static_cast<std::size_t>(kind)];
}

}  // namespace

std::string write_long_program(LongProgram kind, std::size_t moves, const std::filesystem::path& folder) {
    const Kind& k = kind_of(kind);
    Program program(k.is_apt);
    const Block block = k.write(program, moves);
    program.write(folder / "path.txt");
    const std::filesystem::path job = folder / "job.toml";
    std::ofstream(job) << "[stock]\nbox_mm = [[0, 0, " << -block.z << "], [" << block.x << ", " << block.y
                       << ", 0]]\n\n[cutter]\n"
                       << k.cutter << "flutes = 2\n\n[material]\nname = \"al7075-t6\"\n\n[path]\n"
                       << (k.is_apt ? "apt" : "gcode") << " = \"path.txt\"\n";
    return job;
}

// Time per move must not grow with the number of moves.
void measure_long_programs(Report& report) {
    report.section("Long programs as a process on 2 processors, --only summary");
    const TemporaryFolder folder;
    if (folder.path().empty()) return report.note("no temporary folder: left out");
    const std::string log = folder.path() / "log.txt", out = folder.path() / "out";
    const auto cost_of = [&](LongProgram program, std::size_t moves) {
        const std::string job = write_long_program(program, moves, folder.path());
        const auto cost = run(
            TRIBO_PROGRAM,
            {"render", job, "--out", out, "--resolution", kind_of(program).resolution, "--only", "summary"},
            log);
        if (!cost) report.note(job + ": tribo render failed");
        return cost.value_or(Cost{});
    };
    for (const LongProgram program : {LongProgram::contour, LongProgram::pocket}) {
        const Cost layers = cost_of(program, 60 * 195);
        report.add({std::string("60 layers of a ") + kind_of(program).name + ", 11,700 moves of 1 mm",
                    layers.seconds, "s", 15});
    }
    for (const LongProgram program :
         {LongProgram::contour, LongProgram::pocket, LongProgram::raster, LongProgram::tilted}) {
        const char* name = kind_of(program).name;
        double least = 1e300, most = 0;
        for (const std::size_t moves : {1'000u, 10'000u, 35'000u, 200'000u}) {
            const Cost cost = cost_of(program, moves);
            const double us = 1e6 * cost.processor_s / static_cast<double>(moves);
            least = std::min(least, us);
            most = std::max(most, us);
            char text[60];
            std::snprintf(text, sizeof text, "%s, %zu moves", name, moves);
            report.add({std::string(text) + ", processor time per move", us, "us"});
            Entry peak{std::string(text) + ", peak memory", cost.peak_mb, "MB"};
            if (program == LongProgram::tilted && moves == 35'000) peak.goal = 2000;
            report.add(peak);
        }
        report.add({std::string(name) + ", dearest move over cheapest", most / least, "times", 1.3});
    }
}

}  // namespace tribo::bench
