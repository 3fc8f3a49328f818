// SPDX-License-Identifier: MIT
// Force source from a shared library of the user (force_plugin.h). It wraps the force source of Tribo.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "base/result.hpp"
#include "devices/arm/shared_library.hpp"
#include "devices/force_plugin.h"
#include "haptics/servo/servo.hpp"

namespace tribo::devices {

// One thread. render() is real-time safe if the function of the library is. The safety guard stops forces
// that are not finite. After an exception of the library there is no force.
class ForcePlugin final : public haptics::ForceSource {
  public:
    // Refuses a missing library, a missing function and an unsupported version.
    static Result<std::unique_ptr<ForcePlugin>> open(const std::string& library, double rate_hz);
    ForcePlugin(const ForcePlugin&) = delete;
    ForcePlugin& operator=(const ForcePlugin&) = delete;
    ~ForcePlugin() override;

    // The wrapped force source; must outlive this object. Call before the first render().
    void set_inner(haptics::ForceSource& inner) { inner_ = &inner; }
    haptics::RenderedForce render(const haptics::HandReading& hand, double now_s,
                                  double tick_s) noexcept override;

    // What the library did that it should not, by its name; empty: nothing. After the last render().
    std::string trouble() const;

  private:
    explicit ForcePlugin(SharedLibrary library, std::string name)
        : library_(std::move(library)), name_(std::move(name)) {}

    SharedLibrary library_;
    std::string name_;
    bool has_thrown_ = false;
    std::uint64_t not_finite_ = 0;  // forces
    haptics::ForceSource* inner_ = nullptr;
    decltype(&tribo_force_open) open_ = nullptr;
    decltype(&tribo_force_render) render_ = nullptr;
    decltype(&tribo_force_close) close_ = nullptr;
    void* state_ = nullptr;
};

}  // namespace tribo::devices
