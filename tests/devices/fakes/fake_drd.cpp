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
    arm.open = arm.plugged.load();
    return arm.open ? 0 : -1;
}
int dhdClose(char) {
    arm.open = false;
    return 0;
}
int dhdStop(char) {
    arm.forces_on = false;
    return 0;
}
const char* dhdGetSystemName(char) {
    return "omega.3";
}
void dhdGetSDKVersion(int* major, int* minor, int* release, int* revision) {
    *major = arm.version;
    *minor = 17;
    *release = 5;
    *revision = 0;
}
int dhdGetPosition(double* x, double* y, double* z, char) {
    *x = arm.position[0];
    *y = arm.position[1];
    *z = arm.position[2];
    return answer();
}
int dhdGetLinearVelocity(double* x, double* y, double* z, char) {
    *x = arm.velocity[0];
    *y = arm.velocity[1];
    *z = arm.velocity[2];
    return answer();
}
unsigned int dhdGetButtonMask(char) {
    return static_cast<unsigned int>(arm.buttons);
}
int dhdSetForce(double x, double y, double z, char) {
    arm.force[0] = x;
    arm.force[1] = y;
    arm.force[2] = z;
    return arm.error > 0 ? arm.error.load() : answer();
}
int dhdEnableForce(unsigned char on, char) {
    arm.forces_on = on != 0;
    return 0;
}
#ifndef FAKE_OLD
int dhdSetWatchdog(unsigned char units, char) {
    arm.watchdog = units;
    return 0;
}
#endif
int dhdGetStatus(int* status, char) {
    status[1] = arm.open ? 1 : 0;
    status[5] = arm.forces_on ? 1 : 0;
    return 0;
}
const char* dhdErrorGetLastStr() {
    return "no device found";
}
}
