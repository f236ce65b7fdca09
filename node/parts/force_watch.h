// SPDX-License-Identifier: Apache-2.0
// Reports in the node's log which variables are forced and which no longer are, and releases forces that have expired.
// Not for the real-time path.

#pragma once

#include <vector>

#include "node/run/console.h"
#include "store/vars/store.h"

namespace indurop::node {

class ForceWatch {
 public:
  void report_changes(vars::Store& store, Console& console);

 private:
  std::vector<vars::Force> known_;
};

}  // namespace indurop::node
