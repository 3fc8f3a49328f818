// SPDX-License-Identifier: MIT
// A force that comes from a shared library of the user's (force_plugin.h), around the one that Tribo has.
#pragma once

#include <memory>
#include <string>

#include "base/result.hpp"
#include "devices/arm/shared_library.hpp"
#include "devices/force_plugin.h"
#include "haptics/servo/servo.hpp"

namespace tribo::devices {

// One thread; render() is as real-time safe as the library's function is. What is not a number stops at the
// servo's guard.
class ForcePlugin final : public haptics::ForceSource {
  public:
    // Refused: no such library, a function missing, or one that does not speak this version.
    static Result<std::unique_ptr<ForcePlugin>> open(const std::string& library, double rate_hz);
    ForcePlugin(const ForcePlugin&) = delete;
    ForcePlugin& operator=(const ForcePlugin&) = delete;
    ~ForcePlugin() override;

    // What Tribo would give, from now on; must live as long. Before the first render().
    void set_inner(haptics::ForceSource& inner) { inner_ = &inner; }
    haptics::RenderedForce render(const haptics::HandReading& hand, double now_s,
                                  double tick_s) noexcept override;

  private:
    explicit ForcePlugin(SharedLibrary library) : library_(std::move(library)) {}

    SharedLibrary library_;
    haptics::ForceSource* inner_ = nullptr;
    decltype(&tribo_force_open) open_ = nullptr;
    decltype(&tribo_force_render) render_ = nullptr;
    decltype(&tribo_force_close) close_ = nullptr;
    void* state_ = nullptr;
};

}  // namespace tribo::devices
