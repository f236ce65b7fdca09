// SPDX-License-Identifier: Apache-2.0
// Errors in .glb texts. Adds to base::Diagnostics only what is special here: places are spans in one of several texts;
// they are converted to lines and columns, with a picture of the line.

#pragma once

#include <string>
#include <vector>

#include "core/base/diagnostics.h"
#include "glb2idl/source.h"

namespace indurop::glb2idl {

class Diagnostics {
 public:
  static constexpr std::size_t kLimit = 100;

  // Borrows both arguments. Errors are appended to `out`.
  Diagnostics(const Sources& sources, std::vector<base::Diagnostic>& out)
      : sources_(sources), all_({}, out, kLimit), out_(out) {}

  void error(Span at, std::string text);
  // An error about the command line or a whole file, without a place.
  void error(std::string text) { all_.error({}, std::move(text)); }

  [[nodiscard]] bool failed() const noexcept { return all_.failed(); }
  [[nodiscard]] std::size_t errors() const noexcept { return all_.errors(); }
  // Returns true if further errors are only counted: their texts need no search for a similar name.
  [[nodiscard]] bool full() const noexcept { return all_.full(); }
  // Call it once, after the last error: sorts the errors, those about no file first, then by file and place.
  void finish();
  // Returns "knuRobot.glb:3", for texts that refer to another place.
  [[nodiscard]] std::string place(Span at) const;

 private:
  const Sources& sources_;
  base::Diagnostics all_;
  std::vector<base::Diagnostic>& out_;
};

}  // namespace indurop::glb2idl
