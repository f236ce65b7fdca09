// SPDX-License-Identifier: Apache-2.0
// A place in a text that a user wrote.

#pragma once

namespace indurop::base {

// Counted from 1, columns in characters as editors do; 0: not known.
struct SourcePlace {
  int line = 0;
  int column = 0;

  friend bool operator==(const SourcePlace&, const SourcePlace&) = default;
};

}  // namespace indurop::base
