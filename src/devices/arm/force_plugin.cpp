// SPDX-License-Identifier: MIT
#include "devices/arm/force_plugin.hpp"

#include <utility>

namespace tribo::devices {
namespace {

void put(Vec3 v, double (&out)[3]) {
    out[0] = v.x;
    out[1] = v.y;
    out[2] = v.z;
}

Vec3 taken(const double (&v)[3]) {
    return {v[0], v[1], v[2]};
}

}  // namespace

Result<std::unique_ptr<ForcePlugin>> ForcePlugin::open(const std::string& library, double rate_hz) {
    // A plain name is a file of the user, not a library of the system.
    auto loaded = SharedLibrary::open({library.find('/') == std::string::npos ? "./" + library : library});
    if (!loaded) return fail(loaded.error().cause, "give the file that your compiler made, with its folder");
    std::unique_ptr<ForcePlugin> plugin(new ForcePlugin(std::move(*loaded)));
    SharedLibrary& l = plugin->library_;
    l.find("tribo_force_open", plugin->open_);
    l.find("tribo_force_render", plugin->render_);
    l.find("tribo_force_close", plugin->close_);
    if (!l.missing().empty()) {
        return fail("'" + library + "' has no function '" + l.missing() + "'",
                    "export the three functions of force_plugin.h with C names");
    }
    plugin->state_ = plugin->open_(TRIBO_FORCE_PLUGIN_VERSION, rate_hz);
    if (plugin->state_ == nullptr) {
        return fail("'" + library + "' did not start: its tribo_force_open gave NULL",
                    "see whether it speaks version " + std::to_string(TRIBO_FORCE_PLUGIN_VERSION) +
                        " of force_plugin.h and has what it needs");
    }
    return plugin;
}

ForcePlugin::~ForcePlugin() {
    if (state_ != nullptr) close_(state_);
}

haptics::RenderedForce ForcePlugin::render(const haptics::HandReading& hand, double now_s,
                                           double tick_s) noexcept {
    const haptics::RenderedForce felt = inner_->render(hand, now_s, tick_s);
    tribo_hand h{};
    h.now_s = now_s;
    h.tick_s = tick_s;
    put(hand.position_mm, h.position_mm);
    put(hand.velocity_mm_per_s, h.velocity_mm_per_s);
    put(hand.stylus, h.stylus);
    h.buttons = hand.buttons;
    h.touching = felt.touching ? 1 : 0;
    put(felt.contact_n, h.contact_n);
    put(felt.driven_n, h.driven_n);
    tribo_force f{};
    render_(state_, &h, &f);
    haptics::RenderedForce own;
    own.contact_n = taken(f.contact_n);
    own.driven_n = taken(f.driven_n);
    own.touching = f.touching != 0;
    own.simulation_s = felt.simulation_s;
    return own;
}

}  // namespace tribo::devices
