// SPDX-License-Identifier: Apache-2.0
// A long body in parts that become functions of their own: what g++ needs for a function grows faster than its length.

#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "plc/check/program.h"

namespace indurop::plc {

class BodyParts {
 public:
  BodyParts(const Pou& pou, bool divide);

  struct Part {
    std::size_t begin = 0;  // statements of the outermost list
    std::size_t end = 0;
    bool alone = false;                   // a function of its own: nothing jumps out of it or leaves the body
    std::vector<const Variable*> locals;  // temporaries that nothing else uses
  };
  [[nodiscard]] const std::vector<Part>& parts() const noexcept { return parts_; }
  [[nodiscard]] bool is_local(const Variable& variable) const { return homes_.contains(&variable); }

 private:
  void split(const ast::Body& body);
  void find_locals(const Pou& pou);

  std::vector<Part> parts_;
  std::map<const Variable*, std::size_t> homes_;  // of temporaries: the one part that uses them
};

}  // namespace indurop::plc
