// SPDX-License-Identifier: Apache-2.0
// When which variable was forced while a recording was made: the variable then did not hold the values a module wrote
// into it.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "history/explain/facts.h"

namespace indurop::node {

class ForcedThen {
 public:
  ForcedThen() = default;
  // Built from the commands in the recording. A force whose end was not recorded because its client ended counts to the
  // end.
  explicit ForcedThen(const std::vector<explain::OrderFact>& orders);

  // Returns whether a part of the variable was forced at any moment between two times of the node.
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
