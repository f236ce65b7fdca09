// SPDX-License-Identifier: Apache-2.0
// For verbs that look again and again: makes this process one that a control loop does not notice.

#pragma once

#include <string>

namespace indurop::tools {

// Normal scheduling, nice +5, and off the core the node's tick thread is pinned to if there is another one. Whatever
// the system refuses stays as it was.
void be_gentle(const std::string& node);

}  // namespace indurop::tools
