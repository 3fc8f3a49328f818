// SPDX-License-Identifier: MIT
// The clearance plane of APT and the retraction to it.
#pragma once

#include <optional>

#include "readers/apt/path.hpp"

namespace tribo::readers::apt {

class Clearance {
  public:
    // CLEARP/z, CLEARP/XYPLAN,z, CLEARP/a,b,c,d (a x + b y + c z = d) or CLEARP/OFF
    Result<void> set(const Statement& statement, const Path& path, Report& report);
    // RETRCT: the rapid move along the tool axis up to the plane; no move if the tool is already beyond it.
    // Without a plane the tool leaves to where only the machine knows.
    Result<void> retract(const Statement& statement, Path& path, Report& report) const;

  private:
    // In the frame of the program: normal . p = distance.
    struct Plane {
        Vec3 normal{0, 0, 1};
        double distance_mm = 0;
    };
    std::optional<Plane> plane_;
};

}  // namespace tribo::readers::apt
