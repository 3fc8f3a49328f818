// SPDX-License-Identifier: MIT
// Kinds of collision: which part of the tool touches which obstacle.
#pragma once

namespace tribo::milling {

enum class CollisionKind { rapid_through_stock, shank, holder, tool_in_fixture, holder_in_fixture };
const char* name(CollisionKind kind);  // as in summary.json

}  // namespace tribo::milling
