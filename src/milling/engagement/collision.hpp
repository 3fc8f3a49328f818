// SPDX-License-Identifier: MIT
// What of the tool touches what it should not.
#pragma once

namespace tribo::milling {

enum class CollisionKind { rapid_through_stock, shank, holder, tool_in_fixture, holder_in_fixture };
const char* name(CollisionKind kind);  // as in summary.json

}  // namespace tribo::milling
