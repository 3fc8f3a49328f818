// SPDX-License-Identifier: MIT
#include "job/listening.hpp"

#include <algorithm>

namespace tribo::job {
namespace {

template <class Named>
std::size_t index_of(std::span<const Named> all, std::string_view name) {
    const auto at = std::find_if(all.begin(), all.end(), [&](const Named& n) { return n.name == name; });
    return at == all.end() ? 0 : static_cast<std::size_t>(at - all.begin());
}

sound::Body ringing(const milling::Cutter& cutter, std::string_view material) {
    return sound::tool_body(cutter.diameter_mm, cutter.length_mm, sound::material_damping(material));
}

Vec3 middle_of_top(const Box3& box) {
    return {box.centre().x, box.centre().y, box.max.z};
}

}  // namespace

Listening listening_to(const Job& job, const Box3& blank_mm) {
    const JobSound& sound = job.sound;
    Listening l;
    l.listener_mm = sound.listener_mm.value_or(middle_of_top(blank_mm));
    l.distance_factor = sound.distance_factor;
    l.gain_db = sound.gain_db;
    l.reference_distance_m = sound.reference_distance_m;
    l.tool = ringing(job.cutters.front(), job.material.name);
    l.workshop.machine = index_of(sound::machines(), sound.machine);
    l.workshop.room = index_of(sound::rooms(), sound.room);
    if (l.workshop.machine > 0) l.workshop.chips = sound::chip_material(job.material.name);
    l.workshop.cut_db = sound.cut_db;
    l.workshop.spindle_db = sound.spindle_db;
    l.workshop.chips_db = sound.chips_db;
    l.workshop.room_db = sound.room_db;
    return l;
}

void apply(const Listening& listening, sound::SoundtrackOptions& options) {
    options.listener_mm = listening.listener_mm;
    options.distance_factor = listening.distance_factor;
    options.gain_db = listening.gain_db;
    options.reference_distance_m = listening.reference_distance_m;
    options.tool = listening.tool;
    sound::apply(listening.workshop, options);
}

}  // namespace tribo::job
