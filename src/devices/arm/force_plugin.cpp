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
    std::unique_ptr<ForcePlugin> plugin(new ForcePlugin(std::move(*loaded), library));
    SharedLibrary& l = plugin->library_;
    l.find("tribo_force_open", plugin->open_);
    l.find("tribo_force_render", plugin->render_);
    l.find("tribo_force_close", plugin->close_);
    if (!l.missing().empty()) {
        return fail("'" + library + "' has no function '" + l.missing() + "'",
                    "export the three functions of force_plugin.h with C names");
    }
    try {
        plugin->state_ = plugin->open_(TRIBO_FORCE_PLUGIN_VERSION, rate_hz);
    } catch (...) {
        return fail("'" + library + "' did not start: its tribo_force_open threw an exception",
                    "catch it there: the functions are called through C");
    }
    if (plugin->state_ == nullptr) {
        return fail("'" + library + "' did not start: its tribo_force_open gave NULL",
                    "see whether it speaks version " + std::to_string(TRIBO_FORCE_PLUGIN_VERSION) +
                        " of force_plugin.h and has what it needs");
    }
    return plugin;
}

ForcePlugin::~ForcePlugin() {
    try {
        if (state_ != nullptr) close_(state_);
    } catch (...) {
        has_thrown_ = true;  // after the last render(): the trace is kept
    }
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
    try {
        if (!has_thrown_) render_(state_, &h, &f);
    } catch (...) {
        has_thrown_ = true;
        f = {};
    }
    haptics::RenderedForce own;
    own.contact_n = taken(f.contact_n);
    own.driven_n = taken(f.driven_n);
    own.touching = f.touching != 0;
    own.simulation_s = felt.simulation_s;
    if (!is_finite(own.contact_n) || !is_finite(own.driven_n)) ++not_finite_;
    return own;
}

std::string ForcePlugin::trouble() const {
    if (has_thrown_) return "'" + name_ + "' threw an exception: there was no force from then on";
    if (not_finite_ > 0)
        return "'" + name_ + "' gave " + std::to_string(not_finite_) +
               " forces that are not finite: none was sent";
    return {};
}

}  // namespace tribo::devices
