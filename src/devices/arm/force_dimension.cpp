// SPDX-License-Identifier: MIT
#include "devices/arm/force_dimension.hpp"

#include <array>
#include <atomic>

#include "devices/arm/shared_library.hpp"

namespace tribo::devices {
namespace {

using haptics::DeviceState;

// Names and values of dhdc.h.
constexpr int DHD_TIMEGUARD = 1, DHD_MOTOR_SATURATED = 2;  // answers that are not errors
constexpr int DHD_STATUS_RESET = 3, DHD_STATUS_FORCE = 5, DHD_STATUS_WRIST = 8,
              DHD_STATUS_FORCE_OFF_CAUSE = 14, DHD_STATUS_COUNT = 17;
// Reasons why the arm has switched its forces off.
constexpr int kByButton = 1, kBySpeed = 2, kByWatchdog = 3, kBySoftware = 4, kByCable = 5, kByDeadman = 6;
constexpr int kOldestSdk = 3;
// In units of 125 us: after 5 ms without a command the firmware switches the force off.
constexpr unsigned char kWatchdog = 40;
// Commands between two checks whether the forces are on; checks after which an earlier failure is forgotten;
// number of attempts to switch the forces on again before the arm counts as gone.
constexpr int kLookEvery = 64, kQuietLooks = 150, kMostRearmings = 3;
// Failed readings or forces in a row after which the arm counts as gone; fewer are late.
constexpr int kMostFailures = 20;
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
    // Not available in every version.
    int (*enable_expert)();
    int (*disable_expert)();
    int (*orientation)(double (*)[3], char);
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
    if (!all) return false;
    library.find("dhdEnableExpertMode", api.enable_expert);
    library.find("dhdDisableExpertMode", api.disable_expert);
    library.find("dhdGetOrientationFrame", api.orientation);
    return true;
}

std::string words(const char* text) {
    return text != nullptr ? text : "no reason given";
}

const char* words_of(int cause) {
    switch (cause) {
        case kByButton:
            return "by its force button: press it again";
        case kBySpeed:
            return "as it was moved too fast: hold it still and press its force button";
        case kByWatchdog:
            return "by its watchdog, as commands came too late: stop other programs, or lower the rate";
        case kBySoftware:
            return "by a program: close others that use the arm";
        case kByCable:
            return "as its cable was pulled: plug it in";
        case kByDeadman:
            return "as the hand let go: hold it";
        default:
            return "and does not say why: press its force button";
    }
}

class ForceDimension final : public haptics::Device {
  public:
    ForceDimension(SharedLibrary library, const Api& api, char id, const ForceDimensionOptions& options)
        : library_(std::move(library)), api_(api), id_(id), mounting_(options.mounting) {
        name_ = words(api_.system_name(id_));
        limits_ = haptics::scaled(haptics::limits_of(name_), mounting_.scale);
        limits_.name = name_;
        std::array<int, DHD_STATUS_COUNT> status{};
        wrist_ = api_.orientation != nullptr && api_.status(status.data(), id_) >= 0 &&
                 status[DHD_STATUS_WRIST] != 0;
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
        if (place < 0 || speed < 0) {
            lost_ = ++failed_reads_ >= kMostFailures;
            return lost_ ? DeviceState::gone : DeviceState::silent;
        }
        failed_reads_ = 0;
        reading.position_mm =
            mounting_.origin_mm + mounting_.scale * kMmPerM * kNearRightUp.to_stock({p[0], p[1], p[2]});
        reading.velocity_mm_per_s = mounting_.scale * kMmPerM * kNearRightUp.to_stock({v[0], v[1], v[2]});
        if (double frame[3][3] = {}; wrist_ && api_.orientation(frame, id_) >= 0) {
            // At rest the axes of the wrist are those of the base. The hand is on the user's side of the tip,
            // along their x.
            reading.stylus =
                normalized(kNearRightUp.to_stock({frame[0][0], frame[1][0], frame[2][0]}), reading.stylus);
        }
        reading.buttons = api_.buttons(id_);
        reading.sequence = ++sequence_;
        return DeviceState::ready;
    }
    DeviceState write(Vec3 force_n) noexcept override {
        if (!armed_) arm();
        const Vec3 f = kNearRightUp.from_stock(force_n);
        const int answer = api_.set_force(f.x, f.y, f.z, id_);
        if (answer != 0 && answer != DHD_TIMEGUARD && answer != DHD_MOTOR_SATURATED) {
            takes_no_force_ = true;
            return ++failed_writes_ >= kMostFailures ? DeviceState::gone : DeviceState::refused;
        }
        failed_writes_ = 0;
        if (++commands_ % kLookEvery == 0) look();
        if (given_up_) return DeviceState::gone;
        return forces_on_ ? DeviceState::ready : DeviceState::refused;
    }
    std::string trouble() const override {
        if (lost_) return "not connected: " + words(api_.last_error());
        if (cause_ != 0) return std::string("the arm has switched its forces off ") + words_of(cause_);
        if (takes_no_force_)
            return "the arm has not taken its forces, or some of them: " + words(api_.last_error());
        if (no_watchdog_) {
            return "the arm has not taken a watchdog of 5 ms: should this program hang, its last force "
                   "stays; keep a hand on the force button";
        }
        return {};
    }

  private:
    // Called with the first command, so that the watchdog finds a running loop.
    void arm() noexcept {
        armed_ = true;
        if (api_.enable_expert != nullptr) api_.enable_expert();
        no_watchdog_ = api_.set_watchdog(kWatchdog, id_) != 0;
        if (api_.disable_expert != nullptr) api_.disable_expert();
        api_.enable_force(1, id_);
    }
    // Checks whether the forces are on. After a late command they are switched on again, with the ramp of the
    // servo. Forces switched off by a person or by the safety of the arm must be switched on there.
    void look() noexcept {
        std::array<int, DHD_STATUS_COUNT> status{};
        if (api_.status(status.data(), id_) < 0) return;
        forces_on_ = status[DHD_STATUS_FORCE] != 0;
        if (forces_on_) {
            if (++quiet_looks_ == kQuietLooks) rearmings_ = 0;
            cause_ = 0;
            return;
        }
        quiet_looks_ = 0;
        const int cause = status[DHD_STATUS_FORCE_OFF_CAUSE];
        cause_ = cause != 0 ? cause : -1;
        if (cause != kByWatchdog) return;
        if (++rearmings_ > kMostRearmings) {
            given_up_ = true;
        } else {
            api_.enable_force(1, id_);
        }
    }

    SharedLibrary library_;
    Api api_;
    char id_;
    Mounting mounting_;
    std::string name_;
    haptics::DeviceLimits limits_;
    std::uint64_t sequence_ = 0;
    int failed_reads_ = 0, failed_writes_ = 0, commands_ = 0, rearmings_ = 0, quiet_looks_ = 0;
    bool wrist_ = false, armed_ = false, forces_on_ = true, given_up_ = false;
    std::atomic<int> cause_{0};  // 0: the forces are on
    std::atomic<bool> no_watchdog_{false}, lost_{false}, takes_no_force_{false};
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
    std::array<int, DHD_STATUS_COUNT> status{};
    if (api.status(status.data(), static_cast<char>(id)) >= 0 && status[DHD_STATUS_RESET] == 0) {
        api.close(static_cast<char>(id));
        return fail(
            "the arm is not calibrated: its places would be wrong",
            "calibrate it as its manual says (an omega or sigma: put it into its corner and press the "
            "button), or run the vendor's HapticInit");
    }
    return std::make_unique<ForceDimension>(std::move(*library), api, static_cast<char>(id), options);
}

}  // namespace tribo::devices
