// SPDX-License-Identifier: Apache-2.0
// A board as the server observes and commands it: a node of this host (LocalBoard), or a board of another host through
// its agent (ReportedBoard). Each is used by one thread.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/json.h"
#include "history/alarms/alarm_book.h"
#include "history/alarms/alarm_orders.h"
#include "scheduler/module_command.h"
#include "store/operate/who.h"
#include "store/vars/custody.h"
#include "store/vars/store.h"
#include "tools/client/node/run_view.h"
#include "tools/serve/boards/write_request.h"

namespace indurop::tools {
class ReportedBoard;
}  // namespace indurop::tools

namespace indurop::serve {

class LeaseDesk;

// Why something was not done.
struct Refused {
  int code = 0;                      // a status of HTTP
  std::vector<std::string> reasons;  // at least one
};

// What a change affects: a client may be limited to some variables.
struct Affected {
  std::vector<std::string> variables;  // full names of variables or parts of them
  bool board = false;                  // more than variables: modules, the write lock, all forces
  bool stop = false;                   // only stops what runs; done even if it cannot be noted
};

// Decides whether a client may make a change, and notes it in the audit log.
class ChangeNote {
 public:
  ChangeNote() = default;
  ChangeNote(const ChangeNote&) = delete;
  ChangeNote& operator=(const ChangeNote&) = delete;
  virtual ~ChangeNote() = default;
  [[nodiscard]] virtual operate::Who who() const = 0;
  // To be called before anything is changed: returns why it is not allowed or cannot be noted, and then nothing may be
  // changed.
  virtual std::optional<Refused> begin(const Affected& affected) = 0;
};

class Board {
 public:
  explicit Board(std::string name) : name_(std::move(name)) {}
  Board(const Board&) = delete;
  Board& operator=(const Board&) = delete;
  virtual ~Board() = default;

  // Checks whether the attached store is still the current one. Costs reading two small files.
  virtual void refresh() = 0;

  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  [[nodiscard]] const vars::Store* store() const noexcept { return store_ ? &*store_ : nullptr; }
  [[nodiscard]] bool alive() const noexcept { return store_ && absence_.empty(); }
  // Changes each time another store is attached: pointers into the previous one are invalid then.
  [[nodiscard]] std::uint64_t attachment() const noexcept { return attachment_; }
  // Hash of names and types of the variables, 16 hexadecimal digits; empty: there is no store.
  [[nodiscard]] std::string layout() const;

  // The reports about a board of another host; null: it is on this host.
  [[nodiscard]] virtual const tools::ReportedBoard* remote() const noexcept { return nullptr; }
  // Requests its values: those of a board of another host are fetched while they are requested.
  virtual void want() const {}
  // "running", "starting", "not running, last seen 3.2 s ago".
  [[nodiscard]] virtual std::string state() const = 0;
  // The same without the time since when: it changes only when the board does.
  [[nodiscard]] virtual std::string steady_state() const = 0;
  // Why store() is null.
  [[nodiscard]] virtual std::string no_store() const = 0;
  // The run block; of a board of another host the one that was received last.
  [[nodiscard]] virtual std::optional<tools::RunView> run() const = 0;
  // Its forces and its write lock, as the API reports them.
  [[nodiscard]] virtual base::Json forces() const = 0;
  [[nodiscard]] virtual base::Json lock() const = 0;
  // The number of its alarms; nothing: this server evaluates them.
  [[nodiscard]] virtual std::optional<alarms::AlarmCounts> reported_alarms() const { return std::nullopt; }
  // What its agent reports of it, as fields of the answer; an empty object for a board of this host.
  [[nodiscard]] virtual base::Json reported() const { return base::Json::object(); }

  // What follows may wait for the board. Each returns the fields of the answer, or why it was not done.
  using Done = Result<base::Json, Refused>;
  // Returns the current run block.
  virtual Result<tools::RunView, Refused> current_run() = 0;
  // What its modules printed, the newest `count`.
  virtual Done messages(std::uint64_t count) = 0;
  // Its alarms, `all` of them or those that are not normal; their newest events.
  virtual Done alarm_status(bool all) = 0;
  virtual Done alarm_history(std::uint64_t count) = 0;

  // Changes: all of it or nothing.
  virtual Done set(const WriteRequest& request, ChangeNote& note) = 0;
  virtual Done force(const WriteRequest& request, ChangeNote& note, LeaseDesk& leases) = 0;
  virtual Done release(const WriteRequest& request, ChangeNote& note) = 0;
  virtual Done set_lock(vars::WriteLock lock, ChangeNote& note) = 0;
  virtual Done command(scheduler::ModuleCommand what, const std::string& module, ChangeNote& note) = 0;
  // Returns the names of the alarms that were changed.
  virtual Done carry_out(const alarms::AlarmOrder& order, ChangeNote& note) = 0;

 protected:
  void attach(vars::Store store, std::uint64_t generation);
  void detach();
  [[nodiscard]] std::uint64_t generation() const noexcept { return generation_; }
  void set_absence(std::string absence) { absence_ = std::move(absence); }
  [[nodiscard]] const std::string& absence() const noexcept { return absence_; }

 private:
  std::string name_;
  std::optional<vars::Store> store_;
  std::uint64_t generation_ = 0;
  std::uint64_t attachment_ = 0;
  std::string absence_ = "not running";
};

}  // namespace indurop::serve
