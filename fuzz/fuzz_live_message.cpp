// SPDX-License-Identifier: MIT
// Lines of any bytes as the commands of a page: each is obeyed within the ranges of the settings, or refused
// in words. The settings survive being told to a page.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string_view>
#include <vector>

#include "protocol/live_message.hpp"
#include "session/block_setup.hpp"
#include "session/live/live_controller.hpp"

namespace {

using namespace tribo;

Result<session::MillSetup> slot() {
    session::MillSetup s =
        session::block_setup({{0, 0, -8}, {40, 20, 0}}, {.diameter_mm = 8, .length_mm = 20}, 4);
    session::add_cut(s, session::straight_cut({-5, 10, -2}, {45, 10, -2}, 750));
    return s;
}

void check(const Error& error) {
    if (error.cause.empty() || error.remedy.empty() || protocol::live_refusal(error).empty()) std::abort();
}

void check(const protocol::LiveSettings& settings) {
    for (const protocol::LiveNumber& number : protocol::kLiveNumbers) {
        const double value = settings.*number.member;
        if (!number.limit.range.contains(value)) std::abort();
    }
    if (!milling::find_material(settings.material)) std::abort();
    if (protocol::live_settings(settings).empty()) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::size_t largest = 1 << 14;
    if (size > largest) return 0;
    std::string_view text{reinterpret_cast<const char*>(data), size};
    std::vector<protocol::LiveCommand> commands;
    while (!text.empty()) {
        const std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(line.size() + 1, text.size()));
        auto command = protocol::parse_live_command(line);
        if (command)
            commands.push_back(*std::move(command));
        else
            check(command.error());
    }
    if (commands.empty()) return 0;
    const auto job = []() -> Result<session::LiveInput> {
        return session::LiveInput(*slot(), {.material = "al7075-t6"});
    };
    const std::unique_ptr<session::LiveMill> mill = *session::LiveMill::create(job, serial_for);
    session::LiveController controller(*mill, {}, nullptr, {});
    for (const protocol::LiveCommand& command : commands) {
        const protocol::LiveSettings before = controller.settings();
        if (const auto done = controller.obey(command); !done) {
            check(done.error());
            if (!(controller.settings() == before)) std::abort();
        }
        check(controller.settings());
        const session::LiveScene scene = controller.scene();
        if (!(scene.program_s >= 0 && scene.program_s <= mill->duration_s() && scene.pace >= 0)) std::abort();
        if (!(mill->speed() > 0 && mill->speed() <= session::LiveMill::kFastest)) std::abort();
    }
    return 0;
}
