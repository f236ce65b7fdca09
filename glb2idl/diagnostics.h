// SPDX-License-Identifier: Apache-2.0
// Errors about .glb texts. Only what this language has of its own: places are stretches of one of several texts and
// become lines and columns here, with a picture of the line.

#pragma once

#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "glb2idl/source.h"

namespace indurop::glb2idl {

class Diagnostics {
 public:
  static constexpr std::size_t kLimit = 100;

  // Both are borrowed. Errors are appended to `out`.
  Diagnostics(const Sources& sources, std::vector<base::Diagnostic>& out)
      : sources_(sources), all_({}, out, kLimit), out_(out) {}

  void error(Span at, std::string text);
  // About the command line or a whole file, without a place.
  void error(std::string text) { all_.error({}, std::move(text)); }

  [[nodiscard]] bool failed() const noexcept { return all_.failed(); }
  [[nodiscard]] std::size_t errors() const noexcept { return all_.errors(); }
  // To be called once, behind the last: orders them, those about no file first, then by file and place.
  void finish();
  // "knuRobot.glb:3", for texts that refer to another place.
  [[nodiscard]] std::string place(Span at) const;

 private:
  const Sources& sources_;
  base::Diagnostics all_;
  std::vector<base::Diagnostic>& out_;
};

}  // namespace indurop::glb2idl
