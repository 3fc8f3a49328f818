// SPDX-License-Identifier: MIT
// What many texts of VRML begin with.
#pragma once

#include <string>

namespace tribo::readers::test {

inline const std::string kHeader = "#VRML V2.0 utf8\n";
// A triangle with legs of 1 along x and y, corner at the origin.
inline const std::string kTriangle =
    "Shape { geometry IndexedFaceSet { coord Coordinate { point [ 0 0 0, 1 0 0, 0 1 0 ] } coordIndex [ 0 1 2 "
    "-1 ] } }\n";

}  // namespace tribo::readers::test
