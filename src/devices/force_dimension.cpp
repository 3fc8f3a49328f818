// SPDX-License-Identifier: MIT
#include "devices/force_dimension.hpp"

#include <array>
#include <atomic>

#include "devices/shared_library.hpp"

namespace tribo::devices {
namespace {

using haptics::DeviceState;

// Names and values as dhdc.h has them.
constexpr int DHD_TIMEGUARD = 1, DHD_MOTOR_SATURATED = 2;  // answers that are not errors
constexpr int DHD_STATUS_CONNECTED = 1, DHD_STATUS_FORCE = 5, DHD_STATUS_COUNT = 17;
constexpr int kOldestSdk = 3;
// In units of 125 us: 5 ms without a command, and the firmware lets go.
constexpr unsigned char kWatchdog = 40;
constexpr double kMmPerM = 1e3;

struct Api {
    int (*open)();
    int (*close)(char);
    int (*stop)(char);
    const char* (*system_name)(char);
    void (*sdk_version)(int*, int*, int*, int*);
    int (*position)(double*, double*, double*, char);
    int (*velocity)(double*, double*, double*, char);
    unsigned int (*buttons)(char);
    int (*set_force)(double, double, double, char);
    int (*enable_force)(unsigned char, char);
    int (*set_watchdog)(unsigned char, char);
    int (*status)(int*, char);
    const char* (*last_error)();
};

bool bind(SharedLibrary& library, Api& api) {
    bool all = library.find("dhdOpen", api.open);
    all &= library.find("dhdClose", api.close);
    all &= library.find("dhdStop", api.stop);
    all &= library.find("dhdGetSystemName", api.system_name);
    all &= library.find("dhdGetSDKVersion", api.sdk_version);
    all &= library.find("dhdGetPosition", api.position);
    all &= library.find("dhdGetLinearVelocity", api.velocity);
    all &= library.find("dhdGetButtonMask", api.buttons);
    all &= library.find("dhdSetForce", api.set_force);
    all &= library.find("dhdEnableForce", api.enable_force);
    all &= library.find("dhdSetWatchdog", api.set_watchdog);
    all &= library.find("dhdGetStatus", api.status);
    all &= library.find("dhdErrorGetLastStr", api.last_error);
    return all;
}

std::string words(const char* text) {
    return text != nullptr ? text : "no reason given";
}

class ForceDimension final : public haptics::Device {
  public:
    ForceDimension(SharedLibrary library, const Api& api, char id, const ForceDimensionOptions& options)
        : library_(std::move(library)), api_(api), id_(id), mounting_(options.mounting) {
        name_ = words(api_.system_name(id_));
        limits_ = haptics::limits_of(name_);
        limits_.name = name_;
        api_.set_watchdog(kWatchdog, id_);
        api_.enable_force(1, id_);
    }
    ~ForceDimension() override {
        api_.set_force(0, 0, 0, id_);
        api_.stop(id_);
        api_.close(id_);
    }

    const haptics::DeviceLimits& limits() const override { return limits_; }
    DeviceState read(haptics::HandReading& reading) noexcept override {
        std::array<double, 3> p{}, v{};
        const int place = api_.position(&p[0], &p[1], &p[2], id_);
        const int speed = api_.velocity(&v[0], &v[1], &v[2], id_);
        if (place < 0 || speed < 0) return failed();
        failures_ = 0;
        reading.position_mm =
            mounting_.origin_mm + mounting_.scale * kMmPerM * kNearRightUp.to_stock({p[0], p[1], p[2]});
        reading.velocity_mm_per_s = mounting_.scale * kMmPerM * kNearRightUp.to_stock({v[0], v[1], v[2]});
        reading.buttons = api_.buttons(id_);
        reading.sequence = ++sequence_;
        return DeviceState::ready;
    }
    DeviceState write(Vec3 force_n) noexcept override {
        const Vec3 f = kNearRightUp.from_stock(force_n);
        const int answer = api_.set_force(f.x, f.y, f.z, id_);
        if (answer == 0 || answer == DHD_TIMEGUARD) return DeviceState::ready;
        if (answer == DHD_MOTOR_SATURATED) return DeviceState::refused;
        return failed();
    }
    std::string trouble() const override {
        std::array<int, DHD_STATUS_COUNT> status{};
        if (api_.status(status.data(), id_) < 0 || status[DHD_STATUS_CONNECTED] == 0)
            return "not connected: " + words(api_.last_error());
        if (status[DHD_STATUS_FORCE] == 0)
            return "the arm has switched its forces off (button, speed, watchdog or safety): press its force "
                   "button";
        return {};
    }

  private:
    // A call that fails now and then is late; one that keeps failing is gone.
    DeviceState failed() noexcept {
        constexpr int kGone = 20;
        if (failures_ < kGone) ++failures_;
        return failures_ < kGone ? DeviceState::silent : DeviceState::gone;
    }

    SharedLibrary library_;
    Api api_;
    char id_;
    Mounting mounting_;
    std::string name_;
    haptics::DeviceLimits limits_;
    std::uint64_t sequence_ = 0;
    int failures_ = 0;
};

}  // namespace

Result<std::unique_ptr<haptics::Device>> open_force_dimension(const ForceDimensionOptions& options) {
    auto library = options.driver.empty()
                       ? SharedLibrary::open({"libdrd.so.3", "libdrd.so", "libdhd.so.3", "libdhd.so"})
                       : SharedLibrary::open({options.driver});
    if (!library) {
        Error error = library.error();
        error.remedy = "install the Force Dimension SDK, or name the folder of libdrd.so in LD_LIBRARY_PATH";
        return std::unexpected(error);
    }
    Api api{};
    if (!bind(*library, api)) {
        return fail(library->name() + " has no " + library->missing() + ": it is another version",
                    "install the Force Dimension SDK 3.9 or later");
    }
    int major = 0, minor = 0, release = 0, revision = 0;
    api.sdk_version(&major, &minor, &release, &revision);
    if (major < kOldestSdk) {
        return fail(library->name() + " is version " + std::to_string(major) + "." + std::to_string(minor),
                    "install the Force Dimension SDK 3.9 or later");
    }
    const int id = api.open();
    if (id < 0) {
        return fail("no Force Dimension arm opens: " + words(api.last_error()),
                    "plug it in and switch it on; where it is, give yourself the right with a udev rule for "
                    "USB vendor "
                    "1451: SUBSYSTEM==\"usb\", ATTR{idVendor}==\"1451\", MODE=\"0666\"");
    }
    return std::make_unique<ForceDimension>(std::move(*library), api, static_cast<char>(id), options);
}

}  // namespace tribo::devices
