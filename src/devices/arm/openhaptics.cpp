// SPDX-License-Identifier: MIT
#include "devices/arm/openhaptics.hpp"

#include <array>
#include <atomic>
#include <chrono>
#include <thread>

#include "devices/arm/arm_exchange.hpp"
#include "devices/arm/shared_library.hpp"

namespace tribo::devices {
namespace {

using haptics::DeviceState;

// Names and values of the HD headers.
using HHD = unsigned int;
using HDenum = unsigned int;
struct HDErrorInfo {
    unsigned int errorCode;
    int internalErrorCode;
    HHD hHD;
};
constexpr HHD HD_INVALID_HANDLE = 0xFFFFFFFF;
constexpr HDenum HD_CURRENT_BUTTONS = 0x2000, HD_CURRENT_POSITION = 0x2050, HD_CURRENT_VELOCITY = 0x2051,
                 HD_CURRENT_TRANSFORM = 0x2052, HD_DEVICE_MODEL_TYPE = 0x2501, HD_CALIBRATION_STYLE = 0x2555,
                 HD_NOMINAL_MAX_FORCE = 0x2603, HD_CURRENT_FORCE = 0x2700, HD_FORCE_OUTPUT = 0x4000,
                 HD_MAX_FORCE_CLAMPING = 0x4001, HD_FORCE_RAMPING = 0x4002;
constexpr HDenum HD_CALIBRATION_OK = 0x5000, HD_CALIBRATION_NEEDS_UPDATE = 0x5001,
                 HD_CALIBRATION_NEEDS_MANUAL_INPUT = 0x5002;
constexpr int HD_CALIBRATION_ENCODER_RESET = 1, HD_CALIBRATION_AUTO = 2, HD_CALIBRATION_INKWELL = 4;
// Time for the automatic calibration of an arm.
constexpr std::chrono::milliseconds kCalibrationTime{2000}, kCalibrationLook{10};
constexpr unsigned int HD_WARM_MOTORS = 0x200, HD_FORCE_ERROR = 0x204, HD_DEVICE_FAULT = 0x300,
                       HD_COMM_ERROR = 0x302;
constexpr unsigned int HD_CALLBACK_DONE = 0, HD_CALLBACK_CONTINUE = 1;
constexpr unsigned short kPriority = 65535;

struct Api {
    HHD (*init)(const char*);
    void (*disable_device)(HHD);
    void (*make_current)(HHD);
    void (*begin_frame)(HHD);
    void (*end_frame)(HHD);
    HDErrorInfo (*get_error)();
    const char* (*error_string)(unsigned int);
    void (*enable)(HDenum);
    void (*get_integerv)(HDenum, int*);
    void (*get_doublev)(HDenum, double*);
    const char* (*get_string)(HDenum);
    void (*set_doublev)(HDenum, const double*);
    HDenum (*check_calibration)();
    void (*update_calibration)(HDenum);
    void (*start_scheduler)();
    void (*stop_scheduler)();
    unsigned long (*schedule)(unsigned int (*)(void*), void*, unsigned short);
    void (*unschedule)(unsigned long);
};

bool bind(SharedLibrary& library, Api& api) {
    bool all = library.find("hdInitDevice", api.init);
    all &= library.find("hdDisableDevice", api.disable_device);
    all &= library.find("hdMakeCurrentDevice", api.make_current);
    all &= library.find("hdBeginFrame", api.begin_frame);
    all &= library.find("hdEndFrame", api.end_frame);
    all &= library.find("hdGetError", api.get_error);
    all &= library.find("hdGetErrorString", api.error_string);
    all &= library.find("hdEnable", api.enable);
    all &= library.find("hdGetIntegerv", api.get_integerv);
    all &= library.find("hdGetDoublev", api.get_doublev);
    all &= library.find("hdGetString", api.get_string);
    all &= library.find("hdSetDoublev", api.set_doublev);
    all &= library.find("hdCheckCalibration", api.check_calibration);
    all &= library.find("hdUpdateCalibration", api.update_calibration);
    all &= library.find("hdStartScheduler", api.start_scheduler);
    all &= library.find("hdStopScheduler", api.stop_scheduler);
    all &= library.find("hdScheduleAsynchronous", api.schedule);
    all &= library.find("hdUnschedule", api.unschedule);
    return all;
}

class OpenHaptics final : public haptics::Device {
  public:
    OpenHaptics(SharedLibrary library, const Api& api, HHD handle, const OpenHapticsOptions& options)
        : library_(std::move(library)), api_(api), handle_(handle), mounting_(options.mounting) {
        const char* model = api_.get_string(HD_DEVICE_MODEL_TYPE);
        model_ = model != nullptr ? model : "";
        limits_ = haptics::scaled(haptics::limits_of(model_), mounting_.scale);
        limits_.name = model_;
        // The value reported by the arm, if it is lower.
        double value = 0;
        api_.get_doublev(HD_NOMINAL_MAX_FORCE, &value);
        if (value > 0 && value < limits_.max_force_n) limits_.max_force_n = value;
        api_.enable(HD_FORCE_OUTPUT);
        api_.enable(HD_MAX_FORCE_CLAMPING);
        api_.enable(HD_FORCE_RAMPING);
        task_ = api_.schedule(&OpenHaptics::callback, this, kPriority);
        api_.start_scheduler();
    }
    ~OpenHaptics() override {
        closing_.store(true, std::memory_order_relaxed);
        api_.stop_scheduler();
        api_.unschedule(task_);
        api_.disable_device(handle_);
    }

    // Calibrates in the way of this arm while its scheduler runs. Returns true if its positions are then
    // valid.
    bool calibrate() const {
        int styles = 0;
        api_.get_integerv(HD_CALIBRATION_STYLE, &styles);
        HDenum style = HD_CALIBRATION_ENCODER_RESET;
        if ((styles & HD_CALIBRATION_INKWELL) != 0) style = HD_CALIBRATION_INKWELL;
        if ((styles & HD_CALIBRATION_AUTO) != 0) style = HD_CALIBRATION_AUTO;
        const auto end = std::chrono::steady_clock::now() + kCalibrationTime;
        for (HDenum state = api_.check_calibration(); state != HD_CALIBRATION_OK;
             state = api_.check_calibration()) {
            if (state == HD_CALIBRATION_NEEDS_MANUAL_INPUT || std::chrono::steady_clock::now() > end)
                return false;
            if (state == HD_CALIBRATION_NEEDS_UPDATE) api_.update_calibration(style);
            std::this_thread::sleep_for(kCalibrationLook);
        }
        return true;
    }

    const haptics::DeviceLimits& limits() const override { return limits_; }
    DeviceState read(haptics::HandReading& reading) noexcept override {
        const State& s = state_.read();
        if (s.error == HD_DEVICE_FAULT || s.error == HD_COMM_ERROR) return DeviceState::gone;
        if (s.reading.sequence == reading.sequence) return DeviceState::silent;
        reading = s.reading;
        return s.error >= HD_WARM_MOTORS && s.error <= HD_FORCE_ERROR ? DeviceState::refused
                                                                      : DeviceState::ready;
    }
    DeviceState write(Vec3 force_n) noexcept override {
        command_.send(kRightUpNear.from_stock(force_n));
        return DeviceState::ready;
    }
    std::string trouble() const override {
        const unsigned int error = last_error_.load(std::memory_order_relaxed);
        if (error == 0) return {};
        const char* words = api_.error_string(error);
        return words != nullptr ? words : "error " + std::to_string(error);
    }

  private:
    struct State {
        haptics::HandReading reading;
        unsigned int error = 0;
    };

    static unsigned int callback(void* self) { return static_cast<OpenHaptics*>(self)->exchange(); }

    // Runs on the HD thread, once per tick of its scheduler.
    unsigned int exchange() noexcept {
        if (closing_.load(std::memory_order_relaxed)) return HD_CALLBACK_DONE;
        std::array<double, 3> position{}, velocity{};
        std::array<double, 16> transform{};
        int buttons = 0;
        api_.begin_frame(handle_);
        api_.get_doublev(HD_CURRENT_POSITION, position.data());
        api_.get_doublev(HD_CURRENT_VELOCITY, velocity.data());
        api_.get_doublev(HD_CURRENT_TRANSFORM, transform.data());
        api_.get_integerv(HD_CURRENT_BUTTONS, &buttons);
        const Vec3 asked_n = command_.force_n();
        const std::array<double, 3> force{asked_n.x, asked_n.y, asked_n.z};
        api_.set_doublev(HD_CURRENT_FORCE, force.data());
        api_.end_frame(handle_);
        const HDErrorInfo error = api_.get_error();
        State& s = state_.back();
        s.error = error.errorCode;
        if (error.errorCode != 0) last_error_.store(error.errorCode, std::memory_order_relaxed);
        if (error.errorCode != HD_COMM_ERROR && error.errorCode != HD_DEVICE_FAULT) ++sequence_;
        s.reading.position_mm =
            mounting_.origin_mm +
            mounting_.scale * kRightUpNear.to_stock({position[0], position[1], position[2]});
        s.reading.velocity_mm_per_s =
            mounting_.scale * kRightUpNear.to_stock({velocity[0], velocity[1], velocity[2]});
        // The stylus points along -z of its own frame; column-major.
        s.reading.stylus = normalized(kRightUpNear.to_stock({transform[8], transform[9], transform[10]}));
        s.reading.buttons = static_cast<unsigned>(buttons);
        s.reading.sequence = sequence_;
        state_.publish();
        return HD_CALLBACK_CONTINUE;
    }

    SharedLibrary library_;
    Api api_;
    HHD handle_;
    Mounting mounting_;
    std::string model_;
    haptics::DeviceLimits limits_;
    unsigned long task_ = 0;
    std::uint64_t sequence_ = 0;
    Snapshot<State> state_;
    ForceCommand command_;
    std::atomic<bool> closing_{false};
    std::atomic<unsigned int> last_error_{0};
};

}  // namespace

Result<std::unique_ptr<haptics::Device>> open_openhaptics(const OpenHapticsOptions& options) {
    auto library = options.driver.empty() ? SharedLibrary::open({"libHD.so", "libHD.so.3"})
                                          : SharedLibrary::open({options.driver});
    if (!library) {
        Error error = library.error();
        error.remedy =
            "install OpenHaptics and the Touch device driver, or name the folder of libHD.so in "
            "LD_LIBRARY_PATH";
        return std::unexpected(error);
    }
    Api api{};
    if (!bind(*library, api)) {
        return fail(library->name() + " has no " + library->missing() + ": it is another version",
                    "install OpenHaptics 3.4 or later");
    }
    const std::string device = options.device.empty() ? "Default Device" : options.device;
    const HHD handle = api.init(device.c_str());
    const HDErrorInfo opened = api.get_error();
    if (handle == HD_INVALID_HANDLE || opened.errorCode != 0) {
        const char* words = api.error_string(opened.errorCode);
        return fail(
            "the arm '" + device + "' does not open: " + (words != nullptr ? words : "no reason given"),
            "plug it in, run the vendor's set-up and use the name given there (often 'Default PHANToM'); a "
            "Touch by FireWire or serial needs read and write on /dev/ttyACM*, a Touch HID on /dev/hidraw*: "
            "add a udev rule");
    }
    api.make_current(handle);
    auto arm = std::make_unique<OpenHaptics>(std::move(*library), api, handle, options);
    if (!arm->calibrate()) {
        return fail("the arm is not calibrated",
                    "put the stylus into its inkwell, or run the vendor's diagnostic");
    }
    return arm;
}

}  // namespace tribo::devices
