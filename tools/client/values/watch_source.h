// SPDX-License-Identifier: Apache-2.0
// The values that a watch follows: attached read-only, read in one batch per round, attached again when the node
// returns with another store. The last values remain while there is no node.

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/client/values/variables.h"

namespace indurop::tools {

struct WatchedValue {
  Item item;
  std::vector<std::uint8_t> bytes;
  bool changed = true;  // in the last round
  bool known = false;   // read at least once from the attached store
  bool gone = false;    // the node that returned does not have it
};

class WatchSource {
 public:
  WatchSource(std::string node, std::vector<std::string> names) : node_(std::move(node)), names_(std::move(names)) {}

  // Attaches for the first time; `access.values` is then the source of the values.
  Result<void, Failure> open(Access& access);

  // Reads values [first, first + count). Attaches again if the store was replaced.
  void sample(Access& access, std::size_t first, std::size_t count);

  [[nodiscard]] std::span<const WatchedValue> values() const noexcept { return values_; }
  [[nodiscard]] const std::string& node() const noexcept { return node_; }
  [[nodiscard]] bool alive() const noexcept { return absence_.empty(); }
  // Returns "not running, last seen 3.2 s ago", empty while the node runs.
  [[nodiscard]] const std::string& absence() const noexcept { return absence_; }
  // Number of times the store was replaced since open().
  [[nodiscard]] std::uint64_t reconnects() const noexcept { return reconnects_; }

 private:
  void attach_again(Access& access);

  std::string node_;
  std::vector<std::string> names_;
  std::optional<vars::Store> store_;
  std::uint64_t generation_ = 0;
  std::vector<WatchedValue> values_;
  std::string absence_;
  std::uint64_t reconnects_ = 0;
};

// Reads the names of a watch list: one per line, without blank lines and # comments. Returns false after an error
// message.
bool read_watch_list(Messages& messages, const std::string& file, std::vector<std::string>& names);

}  // namespace indurop::tools
