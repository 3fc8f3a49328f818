// SPDX-License-Identifier: MIT
// Speed and force of a finger from the positions that a touch screen reports 60 to 240 times a second, at any
// time between and after them. Speed is led on by part of its change, so that it lags by 12 ms at most behind
// a finger seen at 60 Hz, without jumps; a finger that is no longer reported stands still.
//
// A report at time t may be used for times from t on. Real-time safe; one thread at a time.
#pragma once

namespace tribo::noise {

class FingerMotion {
  public:
    struct State {
        double speed_mm_per_s = 0, force_n = 0;
    };

    // A position while the finger touches; times rise. `force_n` > 0.
    void touch(double t_s, double x_mm, double y_mm, double force_n);
    // The finger left the surface.
    void lift();

    // At a time that is not before the last report.
    State at(double t_s) const;

  private:
    double led_on(double t_s) const;

    int reports_ = 0;  // since the finger touched: 0, 1, 2 ...
    double last_s_ = 0, x_mm_ = 0, y_mm_ = 0, force_n_ = 0;
    double interval_s_ = 1.0 / 60;     // between reports, a slow mean
    double middle_s_ = 0, speed_ = 0;  // of the last way, at its middle
    double rise_ = 0;                  // of the speed, per second
    double ease_ = 0;                  // what is left of the last correction at last_s_
};

}  // namespace tribo::noise
