// SPDX-License-Identifier: Apache-2.0
// A board as the server observes it: a node of this host with its store, which is attached read-only, and again when
// the node returns with another one; or a board of another host, from the reports of its agent. Used by one thread.

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "history/alarms/alarm_book.h"
#include "store/vars/store.h"
#include "tools/cli/values/here_source.h"
#include "tools/cli/values/run_view.h"
#include "tools/serve/boards/remote_boards.h"

namespace indurop::serve {

class Board {
 public:
  explicit Board(std::string name) : name_(std::move(name)), source_(name_, vars::Mode::ReadOnly) {}

  // A board of another host; `reader` is the number of this thread.
  Board(std::shared_ptr<tools::RemoteBoard> remote, std::size_t reader)
      : name_(remote->name()), source_(name_, vars::Mode::ReadOnly), remote_(std::move(remote)), reader_(reader) {}

  // Checks whether the attached store is still the current one. Costs reading two small files.
  void refresh();

  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  [[nodiscard]] const vars::Store* store() const noexcept { return store_ ? &*store_ : nullptr; }
  [[nodiscard]] bool alive() const noexcept { return store_ && absence_.empty(); }
  // Null if the board is on this host.
  [[nodiscard]] const tools::RemoteBoard* remote() const noexcept { return remote_.get(); }
  // The number of alarms of a board of another host, as its agent reports it.
  [[nodiscard]] alarms::AlarmCounts remote_alarms() const;
  // Requests its values: those of a board of another host are fetched while they are requested.
  void want() const;
  // Changes each time another store is attached: pointers into the previous one are invalid then.
  [[nodiscard]] std::uint64_t attachment() const noexcept { return attachment_; }
  // Hash of names and types of the variables, 16 hexadecimal digits; empty: there is no store.
  [[nodiscard]] std::string layout() const;
  // "running", "starting", "not running, last seen 3.2 s ago".
  [[nodiscard]] std::string state() const;
  // The run block; of a board of another host the one that was received last.
  [[nodiscard]] std::optional<tools::RunView> run() const;
  // Sets the run block of a board of another host, as its agent has just reported it.
  void show(tools::RunView run, std::int64_t now_ns);
  // Returns true if that was recent enough that it need not be requested again.
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

// All nodes of the host, or the selected one, and boards of other hosts. Used by one thread.
class Boards {
 public:
  // `remote`: boards of other hosts; `reader` identifies this thread among their readers.
  explicit Boards(std::string only, const RemoteBoards* remote = nullptr, std::size_t reader = 0)
      : only_(std::move(only)), remote_(remote), reader_(reader) {}

  // Names of the nodes of this host.
  [[nodiscard]] std::vector<std::string> here() const;
  // Names of all boards that are present now.
  [[nodiscard]] std::vector<std::string> names() const;
  // Returns the board, refreshed; null if there is none of that name. `name` empty: the only one. A board lives as long
  // as this object, so that its attachments are never confused with those of another one.
  Board* find(const std::string& name);
  [[nodiscard]] const std::string& only() const noexcept { return only_; }

 private:
  [[nodiscard]] bool is_here(const std::string& name) const;

  std::string only_;
  const RemoteBoards* remote_;
  std::size_t reader_;
  std::unordered_multimap<std::string, std::unique_ptr<Board>> boards_;  // those requested so far, by name
};

}  // namespace indurop::serve
