// SPDX-License-Identifier: Apache-2.0
// Says in the node's log what is forced and what no longer is, and takes forces whose time is over out of the way of
// writers. Not for the real-time path.

#pragma once

#include <vector>

#include "node/console.h"
#include "vars/store.h"

namespace indurop::node {

class ForceWatch {
 public:
  void look(vars::Store& store, Console& console);

 private:
  std::vector<vars::Force> known_;
};

}  // namespace indurop::node
