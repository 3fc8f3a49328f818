// SPDX-License-Identifier: MIT
// A libHD of one arm: the symbols, a scheduler thread of 1 kHz, errors on demand.
#include <chrono>
#include <cstring>
#include <mutex>
#include <thread>

#include "fake_arm.hpp"

namespace {

tribo::test::FakeArm arm;
std::thread scheduler;
std::atomic<bool> running{false};
unsigned int (*task)(void*) = nullptr;
void* task_data = nullptr;
bool in_frame = false;

struct ErrorInfo {
    unsigned int code;
    int internal;
    unsigned int device;
};

}  // namespace

extern "C" {

tribo::test::FakeArm* fake_arm() {
    return &arm;
}

unsigned int hdInitDevice(const char* name) {
    arm.called("hdInitDevice");
    arm.open = arm.plugged && name != nullptr && std::strcmp(name, "Default Device") == 0;
    return arm.open ? 7 : 0xFFFFFFFF;
}
void hdDisableDevice(unsigned int) {
    arm.called("hdDisableDevice");
    arm.open = false;
}
void hdMakeCurrentDevice(unsigned int) {
    arm.called("hdMakeCurrentDevice");
}
void hdBeginFrame(unsigned int) {
    in_frame = true;
}
void hdEndFrame(unsigned int) {
    in_frame = false;
}
ErrorInfo hdGetError() {
    return {arm.open ? static_cast<unsigned int>(arm.error) : 0x302U, 0, 7};
}
const char* hdGetErrorString(unsigned int code) {
    arm.called("hdGetErrorString");
    return code == 0x302 ? "communication error" : code == 0x200 ? "warm motors" : "fault";
}
void hdEnable(unsigned int what) {
    arm.called("hdEnable");
    if (what == 0x4000) arm.forces_on = true;
}
void hdGetIntegerv(unsigned int what, int* out) {
    if (what == 0x2000) *out = arm.buttons;
    if (what == 0x2555) *out = arm.styles;
}
void hdGetDoublev(unsigned int what, double* out) {
    if (what == 0x2603) *out = 3.3;
    if (!in_frame) return;
    for (int n = 0; n < 3; ++n) {
        if (what == 0x2050) out[n] = arm.position[n];
        if (what == 0x2051) out[n] = arm.velocity[n];
    }
    if (what == 0x2052) {  // the stylus' z axis up
        out[8] = 0;
        out[9] = 1;
        out[10] = 0;
    }
}
const char* hdGetString(unsigned int) {
    arm.called("hdGetString");
    return "Geomagic Touch";
}
void hdSetDoublev(unsigned int what, const double* in) {
    if (what != 0x2700 || !in_frame) return;
    for (int n = 0; n < 3; ++n) arm.force[n] = in[n];
}
unsigned int hdCheckCalibration() {
    arm.called("hdCheckCalibration");
    return 0x5000U + static_cast<unsigned int>(arm.calibration);
}
void hdUpdateCalibration(unsigned int style) {
    arm.called("hdUpdateCalibration");
    // As the vendor's: nothing before the scheduler runs, nor in a style that the arm does not know.
    if (!running || (static_cast<int>(style) & arm.styles) == 0) return;
    arm.style = static_cast<int>(style);
    arm.calibrated = true;
    arm.calibration = 0;
}
void hdStartScheduler() {
    arm.called("hdStartScheduler");
    running = true;
    scheduler = std::thread([] {
        while (running) {
            std::this_thread::sleep_for(
                std::chrono::milliseconds(arm.stall_ms > 0 ? arm.stall_ms.load() : 1));
            if (task != nullptr && task(task_data) == 0) task = nullptr;
        }
    });
}
void hdStopScheduler() {
    arm.called("hdStopScheduler");
    running = false;
    if (scheduler.joinable()) scheduler.join();
}
#ifndef FAKE_OLD
unsigned long hdScheduleAsynchronous(unsigned int (*call)(void*), void* data, unsigned short) {
    arm.called("hdScheduleAsynchronous");
    task = call;
    task_data = data;
    return 1;
}
#endif
void hdUnschedule(unsigned long) {
    arm.called("hdUnschedule");
    task = nullptr;
}
}
