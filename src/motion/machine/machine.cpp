// SPDX-License-Identifier: MIT
#include "motion/machine/machine.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "base/math.hpp"
#include "base/text/nearest.hpp"

namespace tribo::motion {
namespace {

// Directions nearer than this to one line or plane count as lying in it.
constexpr double kDegenerate = 1e-6;

constexpr double kAny = std::numeric_limits<double>::infinity();

struct NamedAxis {
    char word;
    Vec3 direction;
    double min_deg = -kAny, max_deg = kAny;
    double max_rpm = kAny;
};
struct Named {
    std::string_view name;
    std::span<const NamedAxis> part_side, tool_side;
};
constexpr std::array kXyzac{NamedAxis{'A', {1, 0, 0}}, NamedAxis{'C', {0, 0, 1}}};
constexpr std::array kXyzbc{NamedAxis{'B', {0, 1, 0}}, NamedAxis{'C', {0, 0, 1}}};
constexpr std::array kXyzab{NamedAxis{'B', {0, -1, 0}}, NamedAxis{'A', {-1, 0, 0}}};
constexpr std::array kHeadHead{NamedAxis{'C', {0, 0, 1}}, NamedAxis{'B', {0, 1, 0}}};
constexpr std::array kHead{NamedAxis{'B', {0, 1, 0}}};
constexpr std::array kTable{NamedAxis{'C', {0, 0, -1}}};
constexpr std::array kIndexer{NamedAxis{'A', {-1, 0, 0}}};
// Travel and speed of rotary axes as data sheets of such machines give them, rounded; models differ.
constexpr std::array kTableTable{NamedAxis{'A', {-1, 0, 0}, -120, 120, 25},
                                 NamedAxis{'C', {0, 0, -1}, -kAny, kAny, 40}};
constexpr std::array kHaasUmc{NamedAxis{'B', {0, -1, 0}, -35, 120, 8},
                              NamedAxis{'C', {0, 0, -1}, -kAny, kAny, 8}};
constexpr std::array kHaasTr{NamedAxis{'A', {-1, 0, 0}, -120, 120, 13},
                             NamedAxis{'C', {0, 0, -1}, -kAny, kAny, 13}};
constexpr std::array kDmgDmu{NamedAxis{'B', {0, -1, 0}, -35, 110, 30},
                             NamedAxis{'C', {0, 0, -1}, -kAny, kAny, 30}};
constexpr std::array kHermleC{NamedAxis{'A', {-1, 0, 0}, -130, 130, 25},
                              NamedAxis{'C', {0, 0, -1}, -kAny, kAny, 40}};
// Half of the root of two: the part of a unit vector at 45 degrees along each axis.
constexpr double kHalf = 0.70710678118654752440;
constexpr std::array kNutatingTable{NamedAxis{'B', {0, -kHalf, -kHalf}, -180, 180, 30},
                                    NamedAxis{'C', {0, 0, -1}, -kAny, kAny, 30}};
constexpr std::array kNutatingHead{NamedAxis{'B', {0, kHalf, kHalf}, -180, 180, 30}};
constexpr std::array kRoundTable{NamedAxis{'C', {0, 0, -1}, -kAny, kAny, 30}};
constexpr std::array kNutatingHeads{NamedAxis{'C', {0, 0, 1}, -360, 360, 30},
                                    NamedAxis{'B', {0, kHalf, kHalf}, -180, 180, 30}};
constexpr std::array kNamed{
    Named{"xyzac-trt", kXyzac, {}},
    Named{"xyzbc-trt", kXyzbc, {}},
    Named{"xyzab-tdr", kXyzab, {}},
    Named{"head-head", {}, kHeadHead},
    Named{"head-table", kTable, kHead},
    Named{"xyza", kIndexer, {}},
    Named{"table-table", kTableTable, {}},
    Named{"haas-umc", kHaasUmc, {}},
    Named{"haas-tr", kHaasTr, {}},
    Named{"dmg-dmu", kDmgDmu, {}},
    Named{"hermle-c", kHermleC, {}},
    Named{"nutating-table", kNutatingTable, {}},
    Named{"nutating-head", kRoundTable, kNutatingHead},
    Named{"nutating-head-head", {}, kNutatingHeads},
};

std::vector<MachineAxis> axes_of(std::span<const NamedAxis> named) {
    std::vector<MachineAxis> axes;
    for (const NamedAxis& axis : named) {
        axes.push_back({.word = axis.word,
                        .direction = axis.direction,
                        .min = axis.min_deg * math::kRadPerDeg,
                        .max = axis.max_deg * math::kRadPerDeg,
                        .max_speed = axis.max_rpm * math::kTwoPi / 60});
    }
    return axes;
}

Result<void> check_axis(const MachineAxis& axis) {
    const std::string name = std::string("axis ") + axis.word;
    if (std::string_view("XYZABC").find(axis.word) == std::string_view::npos)
        return fail(name + " has no meaning here", "use X, Y and Z for linear, A, B and C for rotary axes");
    if (!is_finite(axis.direction) || std::abs(length(axis.direction) - 1) > kDegenerate)
        return fail("the direction of " + name + " is not a unit vector", "give a direction with a length");
    if (!is_finite(axis.pivot_mm) || !std::isfinite(axis.zero))
        return fail(name + " holds a number that is not finite", "give finite numbers");
    if (!(axis.min < axis.max))
        return fail("the limits of " + name + " leave no travel", "give the lower limit first");
    if (!(axis.max_speed > 0)) return fail("the speed of " + name + " is not above 0", "correct it");
    return {};
}

}  // namespace

bool Machine::turns_head() const {
    return std::any_of(tool_side.begin(), tool_side.end(), [](const MachineAxis& a) { return a.turns(); });
}

const MachineAxis* Machine::axis(char word) const {
    for (const auto* side : {&part_side, &tool_side}) {
        for (const MachineAxis& axis : *side) {
            if (axis.word == word) return &axis;
        }
    }
    return nullptr;
}

void add_linear_axes(Machine& machine) {
    std::vector<MachineAxis> missing;
    for (int k = 0; k < 3; ++k) {
        const char word = "XYZ"[k];
        if (machine.axis(word) != nullptr) continue;
        MachineAxis axis;
        axis.word = word;
        axis.direction = {};
        axis.direction[k] = 1;
        missing.push_back(axis);
    }
    machine.tool_side.insert(machine.tool_side.begin(), missing.begin(), missing.end());
}

Result<void> check(const Machine& machine) {
    std::string words;
    std::vector<Vec3> linear, rotary;  // rotary ones from the part to the tool
    const auto take = [&](const MachineAxis& axis) -> Result<void> {
        if (auto good = check_axis(axis); !good) return good;
        if (words.find(axis.word) != std::string::npos)
            return fail(std::string("the machine has two axes ") + axis.word, "give each axis its own word");
        words += axis.word;
        (axis.turns() ? rotary : linear).push_back(axis.direction);
        return {};
    };
    for (auto axis = machine.part_side.rbegin(); axis != machine.part_side.rend(); ++axis) {
        if (auto good = take(*axis); !good) return good;
    }
    for (const MachineAxis& axis : machine.tool_side) {
        if (auto good = take(axis); !good) return good;
    }
    if (linear.size() != 3)
        return fail("the machine has no axis " + std::string(1, words.find('X') == std::string::npos   ? 'X'
                                                                : words.find('Y') == std::string::npos ? 'Y'
                                                                                                       : 'Z'),
                    "describe X, Y and Z");
    if (std::abs(dot(cross(linear[0], linear[1]), linear[2])) < kDegenerate)
        return fail("the linear axes lie in one plane", "correct their directions");
    if (rotary.size() > 2)
        return fail("the machine has three rotary axes", "describe the two that the program uses");
    if (rotary.size() == 2 && length(cross(rotary[0], rotary[1])) < kDegenerate)
        return fail("both rotary axes have one direction", "correct a direction");
    if (!rotary.empty() && length(cross(rotary.back(), {0, 0, 1})) < kDegenerate)
        return fail("the rotary axis nearest to the tool turns about the spindle: it tilts nothing",
                    "list the axes of each side from the frame outwards, or correct its direction");
    if (!is_finite(machine.stock_mm) || (machine.tool_length_mm && !std::isfinite(*machine.tool_length_mm)))
        return fail("the machine holds a number that is not finite", "give finite numbers");
    return {};
}

Result<Machine> named_machine(std::string_view name) {
    std::vector<std::string_view> names;
    for (const Named& named : kNamed) {
        names.push_back(named.name);
        if (named.name != name) continue;
        Machine machine;
        machine.name = name;
        machine.part_side = axes_of(named.part_side);
        machine.tool_side = axes_of(named.tool_side);
        add_linear_axes(machine);
        return machine;
    }
    return fail("there is no machine '" + std::string(name) + "'",
                suggestion(name, names) + ", or the name of a .toml file that describes one");
}

std::string machine_names() {
    std::string text;
    for (const Named& named : kNamed) text += (text.empty() ? "" : ", ") + std::string(named.name);
    return text;
}

}  // namespace tribo::motion
