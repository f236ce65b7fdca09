// SPDX-License-Identifier: Apache-2.0
// Limits the depth of expressions, so that none overflows the stack.

#pragma once

namespace indurop::plc::st {

// A bracket uses as much of the stack as this number of operators.
inline constexpr int kBracket = 8;

// Saves the depth of the surrounding expression; inner expressions count from there.
class Nesting {
 public:
  explicit Nesting(int& depth) noexcept : depth_(depth), before_(depth) {}
  Nesting(const Nesting&) = delete;
  Nesting& operator=(const Nesting&) = delete;
  ~Nesting() { depth_ = before_; }

 private:
  int& depth_;
  int before_;
};

}  // namespace indurop::plc::st
