// SPDX-License-Identifier: Apache-2.0
// A node of this host: its store is attached read-only, and again when the node returns with another one. For a change
// it is opened for writing, and only during that change.

#pragma once

#include <string>
#include <utility>
#include <vector>

#include "store/operate/item.h"
#include "store/operate/refusal.h"
#include "tools/client/values/here_source.h"
#include "tools/serve/boards/board.h"

namespace indurop::serve {

class LocalBoard final : public Board {
 public:
  explicit LocalBoard(std::string name) : Board(std::move(name)), source_(this->name(), vars::Mode::ReadOnly) {}

  void refresh() override;
  [[nodiscard]] std::string state() const override;
  [[nodiscard]] std::string steady_state() const override;
  [[nodiscard]] std::string no_store() const override;
  [[nodiscard]] std::optional<tools::RunView> run() const override;
  [[nodiscard]] base::Json forces() const override;
  [[nodiscard]] base::Json lock() const override;

  Result<tools::RunView, Refused> current_run() override;
  Done messages(std::uint64_t count) override;
  Done alarm_status(bool all) override;
  Done alarm_history(std::uint64_t count) override;

  Done set(const WriteRequest& request, ChangeNote& note) override;
  Done force(const WriteRequest& request, ChangeNote& note, LeaseDesk& leases) override;
  Done release(const WriteRequest& request, ChangeNote& note) override;
  Done set_lock(vars::WriteLock lock, ChangeNote& note) override;
  Done command(scheduler::ModuleCommand what, const std::string& module, ChangeNote& note) override;
  Done carry_out(const alarms::AlarmOrder& order, ChangeNote& note) override;

 private:
  [[nodiscard]] Refused refused(const operate::Refusal& refusal) const;
  [[nodiscard]] std::vector<alarms::DeclaredAlarm> declared_alarms() const;

  tools::HereSource source_;
};

// Opens a node's store for a change; with `running` the node must be running.
Result<vars::Store, Refused> open_to_write(const std::string& node, bool running);
// The refusal of store/operate/ as a status of HTTP.
Refused refused_by(const std::string& node, const operate::Refusal& refusal);

}  // namespace indurop::serve
