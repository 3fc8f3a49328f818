// SPDX-License-Identifier: MIT
#include "formats/vrml_nodes.hpp"

#include <algorithm>
#include <array>

namespace tribo::formats {
namespace {

using namespace std::string_view_literals;

constexpr std::array kChildren{"children"sv};
constexpr std::array kGroupPassed{"bboxCenter"sv,  "bboxSize"sv,      "description"sv,    "parameter"sv,
                                  "url"sv,         "collide"sv,       "axisOfRotation"sv, "proxy"sv,
                                  "addChildren"sv, "removeChildren"sv};
constexpr std::array kTransformUsed{"children"sv, "translation"sv,      "rotation"sv,
                                    "scale"sv,    "scaleOrientation"sv, "center"sv};
constexpr std::array kChoiceUsed{"choice"sv, "whichChoice"sv};
constexpr std::array kLevelUsed{"level"sv};
constexpr std::array kLevelPassed{"center"sv, "range"sv};
constexpr std::array kShapeUsed{"geometry"sv};
constexpr std::array kShapePassed{"appearance"sv};
constexpr std::array kFaceSetUsed{"coord"sv, "coordIndex"sv, "ccw"sv, "solid"sv, "creaseAngle"sv};
constexpr std::array kFaceSetPassed{"color"sv,          "normal"sv,          "texCoord"sv,
                                    "colorIndex"sv,     "normalIndex"sv,     "texCoordIndex"sv,
                                    "colorPerVertex"sv, "normalPerVertex"sv, "convex"sv};
constexpr std::array kCoordinateUsed{"point"sv};

constexpr std::array kNodes{
    VrmlNodeType{"Anchor", VrmlRole::group, kChildren, kGroupPassed},
    VrmlNodeType{"Appearance"},
    VrmlNodeType{"AudioClip"},
    VrmlNodeType{"Background"},
    VrmlNodeType{"Billboard", VrmlRole::group, kChildren, kGroupPassed},
    VrmlNodeType{"Box", VrmlRole::other_surface},
    VrmlNodeType{"Collision", VrmlRole::group, kChildren, kGroupPassed},
    VrmlNodeType{"Color"},
    VrmlNodeType{"ColorInterpolator"},
    VrmlNodeType{"Cone", VrmlRole::other_surface},
    VrmlNodeType{"Coordinate", VrmlRole::coordinate, kCoordinateUsed},
    VrmlNodeType{"CoordinateInterpolator"},
    VrmlNodeType{"Cylinder", VrmlRole::other_surface},
    VrmlNodeType{"CylinderSensor"},
    VrmlNodeType{"DirectionalLight"},
    VrmlNodeType{"ElevationGrid", VrmlRole::other_surface},
    VrmlNodeType{"Extrusion", VrmlRole::other_surface},
    VrmlNodeType{"Fog"},
    VrmlNodeType{"FontStyle"},
    VrmlNodeType{"Group", VrmlRole::group, kChildren, kGroupPassed},
    VrmlNodeType{"ImageTexture"},
    VrmlNodeType{"IndexedFaceSet", VrmlRole::face_set, kFaceSetUsed, kFaceSetPassed},
    VrmlNodeType{"IndexedLineSet", VrmlRole::no_surface},
    VrmlNodeType{"Inline", VrmlRole::other_surface},
    VrmlNodeType{"LOD", VrmlRole::level, kLevelUsed, kLevelPassed},
    VrmlNodeType{"Material"},
    VrmlNodeType{"MovieTexture"},
    VrmlNodeType{"NavigationInfo"},
    VrmlNodeType{"Normal"},
    VrmlNodeType{"NormalInterpolator"},
    VrmlNodeType{"OrientationInterpolator"},
    VrmlNodeType{"PixelTexture"},
    VrmlNodeType{"PlaneSensor"},
    VrmlNodeType{"PointLight"},
    VrmlNodeType{"PointSet", VrmlRole::no_surface},
    VrmlNodeType{"PositionInterpolator"},
    VrmlNodeType{"ProximitySensor"},
    VrmlNodeType{"ScalarInterpolator"},
    VrmlNodeType{"Script", VrmlRole::script},
    VrmlNodeType{"Shape", VrmlRole::shape, kShapeUsed, kShapePassed},
    VrmlNodeType{"Sound"},
    VrmlNodeType{"Sphere", VrmlRole::other_surface},
    VrmlNodeType{"SphereSensor"},
    VrmlNodeType{"SpotLight"},
    VrmlNodeType{"Switch", VrmlRole::choice, kChoiceUsed},
    VrmlNodeType{"Text", VrmlRole::no_surface},
    VrmlNodeType{"TextureCoordinate"},
    VrmlNodeType{"TextureTransform"},
    VrmlNodeType{"TimeSensor"},
    VrmlNodeType{"TouchSensor"},
    VrmlNodeType{"Transform", VrmlRole::transform, kTransformUsed, kGroupPassed},
    VrmlNodeType{"Viewpoint"},
    VrmlNodeType{"VisibilitySensor"},
    VrmlNodeType{"WorldInfo"},
};
static_assert(kNodes.size() == 54);
static_assert(std::is_sorted(kNodes.begin(), kNodes.end(),
                             [](const VrmlNodeType& a, const VrmlNodeType& b) { return a.name < b.name; }));

}  // namespace

const VrmlNodeType* find_vrml_node(std::string_view name) {
    const auto found = std::lower_bound(kNodes.begin(), kNodes.end(), name,
                                        [](const VrmlNodeType& n, std::string_view s) { return n.name < s; });
    return found != kNodes.end() && found->name == name ? &*found : nullptr;
}

}  // namespace tribo::formats
