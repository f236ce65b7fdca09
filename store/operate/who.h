// SPDX-License-Identifier: Apache-2.0
// Who changes something of a node, and why: it is noted with what was done.

#pragma once

#include <string>

namespace indurop::operate {

struct Who {
  std::string name;  // empty: the user of this process
  std::string from;  // host or address
  std::string reason;
};

}  // namespace indurop::operate
