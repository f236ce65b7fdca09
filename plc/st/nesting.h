// SPDX-License-Identifier: Apache-2.0
// How deep the expression around a place is, so that none becomes deeper than the stack bears.

#pragma once

namespace indurop::plc::st {

// A bracket costs as much of the stack as so many operators.
inline constexpr int kBracket = 8;

// Keeps the depth of the expression around it; what is inside counts from there.
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
