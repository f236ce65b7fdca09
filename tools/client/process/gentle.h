// SPDX-License-Identifier: Apache-2.0
// For verbs that poll: keeps this process from disturbing a control loop.

#pragma once

#include <string>

namespace indurop::tools {

// Sets normal scheduling and nice +5, and leaves the core that the node's tick thread is pinned to if there is another
// one. Settings that the system refuses remain unchanged.
void be_gentle(const std::string& node);

}  // namespace indurop::tools
