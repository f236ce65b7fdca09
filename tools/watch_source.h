// SPDX-License-Identifier: Apache-2.0
// The values a watch looks at: attached read-only, read in one batch per round, attached again when the node comes
// back with another store. The last values stay while there is no node.

#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/variables.h"

namespace indurop::tools {

struct WatchedValue {
  Item item;
  std::vector<std::uint8_t> bytes;
  bool changed = true;  // in the last round
  bool known = false;   // read at least once from the store that is attached
  bool gone = false;    // the node that came back does not have it
};

class WatchSource {
 public:
  WatchSource(std::string node, std::vector<std::string> names) : node_(std::move(node)), names_(std::move(names)) {}

  // First attach. False after an error message; `code` is then the exit code.
  bool open(Context& context, int& code);

  // One round for values [first, first + count). Attaches again if the store was replaced.
  void sample(Context& context, std::size_t first, std::size_t count);

  [[nodiscard]] std::span<const WatchedValue> values() const noexcept { return values_; }
  [[nodiscard]] const std::string& node() const noexcept { return node_; }
  [[nodiscard]] bool alive() const noexcept { return absence_.empty(); }
  // "not running, last seen 3.2 s ago", empty while the node runs.
  [[nodiscard]] const std::string& absence() const noexcept { return absence_; }
  // How often the store was replaced since open().
  [[nodiscard]] std::uint64_t reconnects() const noexcept { return reconnects_; }

 private:
  [[nodiscard]] bool replaced(const Context& context) const;
  void attach_again(Context& context);
  void note_absence(const Context& context);

  std::string node_;
  std::vector<std::string> names_;
  std::optional<vars::Store> store_;
  ino_t inode_ = 0;
  std::uint64_t generation_ = 0;  // of values from the network
  std::vector<WatchedValue> values_;
  std::string absence_;
  std::int64_t last_beat_ns_ = 0;
  std::uint64_t reconnects_ = 0;
};

// Names of a watch list: one per line, blank lines and # comments left out. False after an error message.
bool read_watch_list(Context& context, const std::string& file, std::vector<std::string>& names);

}  // namespace indurop::tools
