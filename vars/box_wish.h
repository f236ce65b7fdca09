// SPDX-License-Identifier: Apache-2.0
// Somebody beside a node, its agent or a user, wants its black box kept: a file in the node's folder says why, until
// the node has seen it. Not real-time safe.

#pragma once

#include <indurop/result.h>

#include <optional>
#include <string>

namespace indurop::vars {

// A wish that the node has not seen yet is replaced. Errors: System, PermissionDenied.
Status wish_box(const std::string& node, const std::string& why);
// The wish, which is gone then.
std::optional<std::string> take_box_wish(const std::string& node);

}  // namespace indurop::vars
