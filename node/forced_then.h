// SPDX-License-Identifier: Apache-2.0
// When which variable was forced while a recording was made: what a module writes into it then is not what it holds.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "explain/facts.h"

namespace indurop::node {

class ForcedThen {
 public:
  ForcedThen() = default;
  // From the orders that the recording tells of. A force that ended unnoted, with its client, counts to the end.
  explicit ForcedThen(const std::vector<explain::OrderFact>& orders);

  // Whether a part of the variable was, somewhere between two times of the node.
  [[nodiscard]] bool any(const std::string& variable, std::int64_t from_ns, std::int64_t to_ns) const;
  [[nodiscard]] bool empty() const noexcept { return all_.empty(); }

 private:
  struct Force {
    std::string part;
    std::int64_t from_ns = 0;
    std::int64_t to_ns = 0;
  };
  std::vector<Force> all_;
};

}  // namespace indurop::node
