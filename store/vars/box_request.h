// SPDX-License-Identifier: Apache-2.0
// A request to a node to keep its black box, from its agent or a user: a file in the node's folder states the reason,
// until the node has read it. Not real-time safe.

#pragma once

#include <indurop/result.h>

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace indurop::vars {

// Minimum time between two black boxes of a node.
inline constexpr std::chrono::seconds kBetweenBoxes{10};

// Writes a request; one that the node has not read yet is replaced. Errors: Busy (the node has just kept one, no other
// is kept before kBetweenBoxes have passed), System, PermissionDenied.
Status request_box(const std::string& node, const std::string& why);
// The message for Busy.
inline constexpr const char* kBoxesTooClose =
    "it has just written a black box; the next one is possible ten seconds after that";
// Waits until the node has read the request. Returns false, and withdraws the request, if it has not read it in this
// time: it keeps no boxes, or uses another state folder.
bool box_request_is_read(const std::string& node, std::chrono::nanoseconds patience);
// Called by the node: returns the request and removes it.
std::optional<std::string> take_box_request(const std::string& node);
// Called by the node: no request is accepted until this time of CLOCK_MONOTONIC; 0: requests are accepted.
void refuse_boxes_until(const std::string& node, std::int64_t monotonic_ns);

}  // namespace indurop::vars
