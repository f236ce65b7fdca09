// SPDX-License-Identifier: Apache-2.0
// Why something was not done: a kind that programs branch on, and sentences for people.

#pragma once

#include <string>
#include <vector>

namespace indurop::operate {

enum class Why {
  Wrong,   // no such variable, no such value, or outside its declared range
  Forced,  // what would be set is forced
  Locked,  // the node's write lock forbids it
  Busy,    // a process that holds a lock was stopped; it may work later
  Absent,  // the node has not run yet, or its files cannot be opened
};

struct Refusal {
  Why why = Why::Wrong;
  std::vector<std::string> reasons;  // at least one; each is one line

  [[nodiscard]] std::string text() const;  // all of them in one line
};

}  // namespace indurop::operate
