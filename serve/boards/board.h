// SPDX-License-Identifier: Apache-2.0
// A node of this host as an observer has it: its store, attached read-only and again when the node comes back with
// another one. Of one thread.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/values/here_source.h"
#include "tools/values/run_view.h"
#include "vars/store.h"

namespace indurop::serve {

class Board {
 public:
  explicit Board(std::string name) : name_(std::move(name)), source_(name_, vars::Mode::ReadOnly) {}

  // Looks whether the store is still the one that is attached. Costs two small files.
  void refresh();

  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  [[nodiscard]] const vars::Store* store() const noexcept { return store_ ? &*store_ : nullptr; }
  [[nodiscard]] bool alive() const noexcept { return store_ && absence_.empty(); }
  // Changes whenever another store was attached: what points into the one before is void.
  [[nodiscard]] std::uint64_t attachment() const noexcept { return attachment_; }
  // Of names and types of the variables, 16 hexadecimal digits; empty: there is no store.
  [[nodiscard]] std::string layout() const;
  // "running", "starting", "not running, last seen 3.2 s ago".
  [[nodiscard]] std::string state() const;
  [[nodiscard]] std::optional<tools::RunView> run() const;

 private:
  std::string name_;
  tools::HereSource source_;
  std::optional<vars::Store> store_;
  std::uint64_t generation_ = 0;
  std::uint64_t attachment_ = 0;
  std::string absence_ = "not running";
};

// All nodes of the host, or the one that is wanted. Of one thread.
class Boards {
 public:
  explicit Boards(std::string only) : only_(std::move(only)) {}

  // Names of all that are there now.
  [[nodiscard]] std::vector<std::string> names() const;
  // Refreshed; null if there is no such node. `name` empty: the only one. A board lives as long as
  // this, so that its attachments are never confused with those of another one.
  Board* find(const std::string& name);
  [[nodiscard]] const std::string& only() const noexcept { return only_; }

 private:
  [[nodiscard]] bool listed(const std::string& name) const;

  std::string only_;
  std::vector<std::unique_ptr<Board>> boards_;  // those that were asked for
};

}  // namespace indurop::serve
