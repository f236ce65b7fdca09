// SPDX-License-Identifier: Apache-2.0
// The reason why something was not done: a kind for programs, and sentences for people.

#pragma once

#include <string>
#include <vector>

namespace indurop::operate {

enum class Why {
  Wrong,   // no such variable, no such value, or outside its declared range
  Forced,  // a variable to be set is forced
  Locked,  // the node's write lock forbids it
  Busy,    // a process that holds a lock is stopped; a later attempt may succeed
  Absent,  // the node has not run yet, or its files cannot be opened
};

struct Refusal {
  Why why = Why::Wrong;
  std::vector<std::string> reasons;  // at least one; each is one line

  [[nodiscard]] std::string text() const;  // all reasons in one line
};

}  // namespace indurop::operate
