// SPDX-License-Identifier: MIT
#include "job/assumption.hpp"

#include <algorithm>
#include <cmath>

#include "base/text/decimal.hpp"
#include "job/program_tools.hpp"

namespace tribo::job {
namespace {

constexpr double kSpindleRpm = 10000, kFeedMmPerMin = 600, kDiameterMm = 6;
constexpr const char* kMaterial = "al7075-t6";
// Material beside and below the path, mm.
constexpr double kBelowMm = 3;

// Around the feed moves. Where they reach below zero, zero is the top, as programs are mostly written; else
// the top is what the highest feed move that is not a plunge touches.
Box3 block(const motion::Program& program, double radius_mm) {
    Box3 path;
    for (const motion::Move& move : program.moves) {
        if (move.kind == motion::MoveKind::feed) path.include(motion::tip_bounds(move));
    }
    if (path.empty()) return path;
    Box3 box = path.inflated(radius_mm);
    box.min.z = path.min.z - kBelowMm;
    box.max.z = path.min.z < 0 ? 0 : std::max(path.max.z, path.min.z + 1);
    const auto outwards = [](double v) { return v < 0 ? std::floor(v) : std::ceil(v); };
    for (int axis = 0; axis < 2; ++axis) {
        box.min[axis] = std::floor(box.min[axis]);
        box.max[axis] = std::ceil(box.max[axis]);
    }
    box.min.z = outwards(box.min.z);
    return box;
}

std::string corner(Vec3 p) {
    return "[" + format_decimal(p.x) + ", " + format_decimal(p.y) + ", " + format_decimal(p.z) + "]";
}

}  // namespace

Job job_of_program(const std::string& file, PathKind kind) {
    Job job;
    job.file = file;
    job.path.kind = kind;
    job.path.file = file;
    job.process = {kSpindleRpm, kFeedMmPerMin};
    job.material.name = kMaterial;
    return job;
}

Result<void> assume_job(Job& job, const motion::Program& program, Warnings& warnings) {
    const auto tools = called_tools(program);
    if (!tools) return std::unexpected(tools.error());
    const bool speed = std::any_of(program.moves.begin(), program.moves.end(),
                                   [](const motion::Move& move) { return move.spindle_rpm > 0; });
    const DeclaredTools declared(program);
    for (const int tool : *tools) {
        const bool described = std::any_of(job.cutters.begin(), job.cutters.end(),
                                           [&](const milling::Cutter& c) { return c.number == tool; });
        if (described || declared.find(tool) != nullptr) continue;
        milling::Cutter cutter;
        cutter.number = tool;
        cutter.diameter_mm = kDiameterMm;
        job.cutters.push_back(cutter);
        warnings.push_back({program.source, 0,
                            (tool > 0 ? "tool T" + std::to_string(tool) : std::string("the tool")) +
                                " is not described: a flat end mill of " + format_decimal(kDiameterMm) +
                                " mm with " + std::to_string(cutter.flutes) + " flutes is assumed"});
    }
    double radius = 0.5 * kDiameterMm;
    for (const milling::Cutter& c : job.cutters) radius = std::max(radius, c.radius_mm());
    if (job.stock.box_mm.empty() && !job.stock.model && !program.stock) {
        job.stock.box_mm = block(program, radius);
        if (!job.stock.box_mm.empty()) {
            warnings.push_back({program.source, 0,
                                "the program declares no stock: a block from " +
                                    corner(job.stock.box_mm.min) + " to " + corner(job.stock.box_mm.max) +
                                    " mm is assumed"});
        }
    }
    if (!speed) {
        warnings.push_back(
            {program.source, 0,
             "the program says no spindle speed: " + format_decimal(kSpindleRpm) + " rpm are assumed"});
    }
    warnings.push_back({program.source, 0, std::string("the material is assumed: ") + kMaterial});
    return {};
}

}  // namespace tribo::job
