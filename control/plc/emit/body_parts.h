// SPDX-License-Identifier: Apache-2.0
// Splits a long body into parts that become separate functions: the cost of a function in g++ grows faster than its
// length.

#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "control/plc/check/program.h"

namespace indurop::plc {

class BodyParts {
 public:
  BodyParts(const Pou& pou, bool divide);

  struct Part {
    std::size_t begin = 0;  // statements of the outermost list
    std::size_t end = 0;
    bool alone = false;                   // can be a function: no jump leaves it, nor does it leave the body
    std::vector<const Variable*> locals;  // temporaries used in this part only
  };
  [[nodiscard]] const std::vector<Part>& parts() const noexcept { return parts_; }
  [[nodiscard]] bool is_local(const Variable& variable) const { return homes_.contains(&variable); }

 private:
  void split(const ast::Body& body);
  void find_locals(const Pou& pou);

  std::vector<Part> parts_;
  std::map<const Variable*, std::size_t> homes_;  // temporaries used in one part only, with that part
};

}  // namespace indurop::plc
