// SPDX-License-Identifier: Apache-2.0
// Somebody beside a node, its agent or a user, wants its black box kept: a file in the node's folder says why, until
// the node has seen it. Not real-time safe.

#pragma once

#include <indurop/result.h>

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace indurop::vars {

// A node keeps no more of them than one in this time.
inline constexpr std::chrono::seconds kBetweenBoxes{10};

// A wish that the node has not seen yet is replaced. Errors: Busy (it has kept one a moment ago, no other is kept
// before kBetweenBoxes are over), System, PermissionDenied.
Status wish_box(const std::string& node, const std::string& why);
// What to say of Busy.
inline constexpr const char* kBoxesTooClose =
    "it has just kept a black box, and keeps another ten seconds after that at the earliest";
// By the node: the wish, which is gone then.
std::optional<std::string> take_box_wish(const std::string& node);
// By the node: until this time of CLOCK_MONOTONIC no wish is taken; 0: they are.
void refuse_boxes_until(const std::string& node, std::int64_t monotonic_ns);

}  // namespace indurop::vars
