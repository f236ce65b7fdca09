// SPDX-License-Identifier: Apache-2.0
#include "node/replay/forced_then.h"

#include <algorithm>
#include <limits>

namespace indurop::node {
namespace {

constexpr std::int64_t kNotedLaterNs = 100'000'000;  // a command is recorded after it was executed

bool is_part_of(const std::string& part, const std::string& whole) {
  return part == whole || (part.starts_with(whole) && (part[whole.size()] == '.' || part[whole.size()] == '['));
}

}  // namespace

ForcedThen::ForcedThen(const std::vector<explain::OrderFact>& orders) {
  constexpr std::int64_t kForever = std::numeric_limits<std::int64_t>::max();
  for (const explain::OrderFact& order : orders) {
    if (order.action == "force") {
      all_.push_back({order.what, order.node_ns - kNotedLaterNs, order.until_ns > 0 ? order.until_ns : kForever});
    } else if (order.action == "unforce") {
      for (Force& force : all_) {
        if (order.what == "*" || is_part_of(force.part, order.what)) {
          force.to_ns = std::min(force.to_ns, order.node_ns);
        }
      }
    }
  }
}

bool ForcedThen::any(const std::string& variable, std::int64_t from_ns, std::int64_t to_ns) const {
  return std::any_of(all_.begin(), all_.end(), [&](const Force& force) {
    return is_part_of(force.part, variable) && force.from_ns <= to_ns && from_ns <= force.to_ns;
  });
}

}  // namespace indurop::node
