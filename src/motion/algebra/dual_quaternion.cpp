// SPDX-License-Identifier: MIT
#include "motion/algebra/dual_quaternion.hpp"

namespace tribo::motion {

ToolPose tool_pose(const DualQuaternion& a) {
    return {translation_mm(a), normalized(transform_direction(a, {0, 0, 1}))};
}

DualQuaternion displacement(const ToolPose& pose) {
    return displacement(minimal_rotation({0, 0, 1}, pose.axis), pose.tip_mm);
}

std::vector<DualQuaternion> minimal_twist_displacements(std::span<const ToolPose> poses) {
    std::vector<DualQuaternion> all;
    all.reserve(poses.size());
    Quaternion frame = kIdentityQuaternion;
    for (const ToolPose& pose : poses) {
        // Starts from the actual axis of the frame, so that rounding does not accumulate along the way.
        const Vec3 axis_before = normalized(rotate(frame, {0, 0, 1}));
        frame = normalized(minimal_rotation(axis_before, pose.axis) * frame);
        all.push_back(displacement(frame, pose.tip_mm));
    }
    return all;
}

}  // namespace tribo::motion
