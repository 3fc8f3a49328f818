// SPDX-License-Identifier: MIT
// A libdrd of one arm: the symbols, errors on demand.
#include "fake_arm.hpp"

namespace {

tribo::test::FakeArm arm;

int answer() {
    return arm.open && arm.error == 0 ? 0 : -1;
}

}  // namespace

extern "C" {

tribo::test::FakeArm* fake_arm() {
    return &arm;
}

int dhdOpen() {
    arm.called("dhdOpen");
    arm.open = arm.plugged.load();
    return arm.open ? 0 : -1;
}
int dhdClose(char) {
    arm.called("dhdClose");
    arm.open = false;
    return 0;
}
int dhdStop(char) {
    arm.called("dhdStop");
    arm.forces_on = false;
    return 0;
}
const char* dhdGetSystemName(char) {
    arm.called("dhdGetSystemName");
    return "omega.3";
}
void dhdGetSDKVersion(int* major, int* minor, int* release, int* revision) {
    arm.called("dhdGetSDKVersion");
    *major = arm.version;
    *minor = 17;
    *release = 5;
    *revision = 0;
}
int dhdGetPosition(double* x, double* y, double* z, char) {
    arm.called("dhdGetPosition");
    *x = arm.position[0];
    *y = arm.position[1];
    *z = arm.position[2];
    return answer();
}
int dhdGetLinearVelocity(double* x, double* y, double* z, char) {
    arm.called("dhdGetLinearVelocity");
    *x = arm.velocity[0];
    *y = arm.velocity[1];
    *z = arm.velocity[2];
    return answer();
}
unsigned int dhdGetButtonMask(char) {
    arm.called("dhdGetButtonMask");
    return static_cast<unsigned int>(arm.buttons);
}
int dhdSetForce(double x, double y, double z, char) {
    arm.called("dhdSetForce");
    if (arm.force_fails > 0) {
        --arm.force_fails;
        return -1;
    }
    if (arm.forces_on && arm.watchdog > 0 && arm.watchdog_fires > 0) {
        --arm.watchdog_fires;
        arm.forces_on = false;
        arm.force_off_cause = 3;
    }
    arm.force[0] = x;
    arm.force[1] = y;
    arm.force[2] = z;
    return arm.error > 0 ? arm.error.load() : answer();
}
int dhdEnableForce(unsigned char on, char) {
    arm.called("dhdEnableForce");
    arm.forces_on = on != 0;
    if (on != 0) arm.force_off_cause = 0;
    return 0;
}
#ifndef FAKE_OLD
int dhdSetWatchdog(unsigned char units, char) {
    arm.called("dhdSetWatchdog");
    if (!arm.expert) return -1;
    arm.watchdog = units;
    return 0;
}
#endif
int dhdGetStatus(int* status, char) {
    arm.called("dhdGetStatus");
    status[1] = arm.open ? 1 : 0;
    status[3] = arm.calibration == 0 ? 1 : 0;
    status[5] = arm.forces_on ? 1 : 0;
    status[8] = 1;
    status[14] = arm.force_off_cause;
    return 0;
}
int dhdEnableExpertMode() {
    arm.called("dhdEnableExpertMode");
    arm.expert = true;
    return 0;
}
int dhdDisableExpertMode() {
    arm.called("dhdDisableExpertMode");
    arm.expert = false;
    return 0;
}
// A wrist turned by 30 degrees about the arm's y.
int dhdGetOrientationFrame(double (*m)[3], char) {
    arm.called("dhdGetOrientationFrame");
    constexpr double kCos = 0.8660254037844387, kSin = 0.5;
    const double turned[3][3] = {{kCos, 0, kSin}, {0, 1, 0}, {-kSin, 0, kCos}};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) m[i][j] = turned[i][j];
    return 0;
}
const char* dhdErrorGetLastStr() {
    arm.called("dhdErrorGetLastStr");
    return "no device found";
}
}
