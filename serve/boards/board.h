// SPDX-License-Identifier: Apache-2.0
// A node of this host as an observer has it: its store, attached read-only and again when the node comes back with
// another one; or a board of another host, by what its agent says. Of one thread.

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "alarms/alarm_book.h"
#include "serve/boards/remote_boards.h"
#include "tools/values/here_source.h"
#include "tools/values/run_view.h"
#include "vars/store.h"

namespace indurop::serve {

class Board {
 public:
  explicit Board(std::string name) : name_(std::move(name)), source_(name_, vars::Mode::ReadOnly) {}

  // Of another host; `reader` is the number of this thread.
  Board(std::shared_ptr<tools::RemoteBoard> remote, std::size_t reader)
      : name_(remote->name()), source_(name_, vars::Mode::ReadOnly), remote_(std::move(remote)), reader_(reader) {}

  // Looks whether the store is still the one that is attached. Costs two small files.
  void refresh();

  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  [[nodiscard]] const vars::Store* store() const noexcept { return store_ ? &*store_ : nullptr; }
  [[nodiscard]] bool alive() const noexcept { return store_ && absence_.empty(); }
  // Null: it is on this host.
  [[nodiscard]] const tools::RemoteBoard* remote() const noexcept { return remote_.get(); }
  // Of another host, by its agent: how many alarms there are.
  [[nodiscard]] alarms::AlarmCounts remote_alarms() const;
  // Somebody wants to see its values: those of another host come as long as that is so.
  void want() const;
  // Changes whenever another store was attached: what points into the one before is void.
  [[nodiscard]] std::uint64_t attachment() const noexcept { return attachment_; }
  // Of names and types of the variables, 16 hexadecimal digits; empty: there is no store.
  [[nodiscard]] std::string layout() const;
  // "running", "starting", "not running, last seen 3.2 s ago".
  [[nodiscard]] std::string state() const;
  // Of another host: what was shown last.
  [[nodiscard]] std::optional<tools::RunView> run() const;
  // How its node does elsewhere, as its agent says now.
  void show(tools::RunView run, std::int64_t now_ns);
  // That was not so long ago that it has to be asked for again.
  [[nodiscard]] bool shown(std::int64_t now_ns) const noexcept { return shown_ && now_ns < shown_until_ns_; }

 private:
  void refresh_remote();

  std::string name_;
  tools::HereSource source_;
  std::optional<vars::Store> store_;
  std::uint64_t generation_ = 0;
  std::uint64_t attachment_ = 0;
  std::string absence_ = "not running";
  std::shared_ptr<tools::RemoteBoard> remote_;
  std::size_t reader_ = 0;
  std::optional<tools::RunView> shown_;
  std::int64_t shown_until_ns_ = 0;
};

// All nodes of the host, or the one that is wanted, and boards of other hosts. Of one thread.
class Boards {
 public:
  // `remote`: boards of other hosts, which `reader` tells this thread from others by.
  explicit Boards(std::string only, const RemoteBoards* remote = nullptr, std::size_t reader = 0)
      : only_(std::move(only)), remote_(remote), reader_(reader) {}

  // Those of this host.
  [[nodiscard]] std::vector<std::string> here() const;
  // Names of all that are there now.
  [[nodiscard]] std::vector<std::string> names() const;
  // Refreshed; null if there is no such node. `name` empty: the only one. A board lives as long as
  // this, so that its attachments are never confused with those of another one.
  Board* find(const std::string& name);
  [[nodiscard]] const std::string& only() const noexcept { return only_; }

 private:
  [[nodiscard]] bool is_here(const std::string& name) const;

  std::string only_;
  const RemoteBoards* remote_;
  std::size_t reader_;
  std::unordered_multimap<std::string, std::unique_ptr<Board>> boards_;  // those that were asked for, by name
};

}  // namespace indurop::serve
