// SPDX-License-Identifier: MIT
#include "session/feel/feel_session.hpp"

#include "surface/textured_triangles.hpp"

namespace tribo::session {
namespace {

// Length of the finger cylinder; beyond it begins the hand.
constexpr double kFingerMm = 40;
// A texture record is valid for positions up to this multiple of the record spacing away.
constexpr double kReach = 1.5;
constexpr std::size_t kMostRecords = 20'000;
// N/ms, for a device without motors to protect.
constexpr double kFreeSlew = 20;

}  // namespace

haptics::ProbeContact SurfaceContact::update(const haptics::HandReading& hand) noexcept {
    if (probe_.size() <= 1) return contact_.update(hand.position_mm);
    const std::span<Vec3> balls = std::span(balls_).first(probe_.size());
    probe_.turned(hand.stylus, balls);
    return contact_.update(hand.position_mm, balls);
}

haptics::RenderedForce InspectSource::render(const haptics::HandReading& hand, double now_s,
                                             double tick_s) noexcept {
    const haptics::ProbeContact contact = touch_.update(hand);
    haptics::RenderedForce felt;
    felt.contact_n = contact.force_n;
    if (waves_) felt.contact_n += waves_->force(contact, tick_s);
    felt.touching = contact.in_contact;
    felt.simulation_s = now_s;  // the part does not change any more
    return felt;
}

CutterTrack::CutterTrack(const MillSetup& setup)
    : moves_(setup.moves), schedule_(schedule_of(setup)), cutter_of_move_(setup.cutter_of_move) {
    for (const milling::Cutter& c : setup.cutters)
        cutters_.push_back({{}, {0, 0, 1}, c.radius_mm(), c.length_mm});
}

haptics::Cylinder CutterTrack::at(double t_s) const noexcept {
    const motion::ToolPose pose = motion::pose_at_time(moves_, *schedule_, t_s);
    haptics::Cylinder cutter = cutters_[cutter_of_move_[schedule_->move_at(t_s)]];
    cutter.end_mm = pose.tip_mm;
    cutter.axis = pose.axis;
    return cutter;
}

CutterForceRenderer::CutterForceRenderer(haptics::CuttingForce& force, double finger_mm, double tick_s)
    : finger_mm_(finger_mm), field_(force, [&] {
          haptics::ForceFieldOptions field;
          field.tick_s = tick_s;
          return field;
      }()) {}

haptics::FieldForce CutterForceRenderer::render(const haptics::HandReading& hand, double at_s,
                                                const CutterTrack& track,
                                                const haptics::TextureMap* textures) noexcept {
    haptics::ForceFieldInput moment;
    moment.at_s = at_s;
    moment.cutter = track.at(at_s);
    moment.finger = {hand.position_mm, hand.stylus, finger_mm_, kFingerMm};
    if (textures != nullptr) moment.texture = textures->nearest(moment.cutter.end_mm);
    return field_.render(moment);
}

haptics::TextureMap texture_map(std::span<const milling::CutRow> cut, const contact::DistanceField& machined,
                                const ParallelFor& parallel, double spacing_mm) {
    std::vector<const milling::CutRow*> places;
    for (const milling::CutRow& row : cut) {
        if (places.empty() || distance(places.back()->pose.tip_mm, row.pose.tip_mm) >= spacing_mm)
            places.push_back(&row);
    }
    // Thin evenly if there are too many.
    const std::size_t step = places.size() / kMostRecords + 1;
    std::vector<std::optional<contact::TextureRecord>> found((places.size() + step - 1) / step);
    parallel(found.size(), [&](std::size_t n) {
        const milling::CutRow& row = *places[n * step];
        surface::TextureOptions options;
        options.pitch_along_mm = row.feed.across_mm;
        found[n] = surface::textured_triangles(
            machined, {row.pose.tip_mm, row.pose.frame.z, row.pose.frame.x}, options);
    });
    std::vector<contact::TextureRecord> records;
    for (const auto& r : found) {
        if (r) records.push_back(*r);
    }
    return {std::move(records), kReach * spacing_mm * static_cast<double>(step)};
}

CutSource::CutSource(const CutterTrack& track, haptics::CuttingForce& force,
                     const haptics::TextureMap& textures, const CutSourceOptions& options)
    : track_(track),
      textures_(textures),
      options_(options),
      cutter_force_(force, options.finger_mm, options.tick_s) {
    if (options.part != nullptr) touch_.emplace(*options.part, options.contact, options.probe);
}

haptics::RenderedForce CutSource::render(const haptics::HandReading& hand, double now_s,
                                         double /*tick_s*/) noexcept {
    const haptics::FieldForce force =
        cutter_force_.render(hand, options_.start_s + now_s, track_, options_.texture ? &textures_ : nullptr);
    haptics::RenderedForce felt;
    felt.simulation_s = now_s;
    if (touch_) {
        (void)options_.part->refresh();
        const haptics::ProbeContact contact = touch_->update(hand);
        felt.contact_n = contact.force_n;
        felt.touching = contact.in_contact;
    }
    // The machine that moves the cutter causes both forces; the hand does no work for them.
    felt.driven_n = force.total_n();
    felt.touching = felt.touching || squared_length(force.cutting_n) > 0;
    return felt;
}

haptics::SafetyLimits safety_limits(const haptics::Device& device, double rate_hz) {
    haptics::SafetyLimits limits;
    limits.max_force_n = device.limits().max_force_n;
    limits.damping_n_s_per_mm = 0.5 * device.limits().max_damping_n_s_per_mm;
    limits.max_speed_mm_per_s *= device.limits().scale;
    limits.tick_s = 1 / rate_hz;
    if (!device.has_motors()) {
        limits.ramp_s = 0;
        limits.slew_n_per_ms = kFreeSlew;
    }
    return limits;
}

}  // namespace tribo::session
