// SPDX-License-Identifier: Apache-2.0
// A board of another host: what its agent reports, and requests and commands to that agent.

#pragma once

#include <functional>
#include <memory>
#include <string>

#include "tools/client/board/plant_watch.h"
#include "tools/client/board/reported_board.h"
#include "tools/serve/boards/board.h"

namespace indurop::serve {

class RemoteBoard final : public Board {
 public:
  // `reader`: the number of this thread; `watch`: through which its agent is reached, null: this thread only reads what
  // was reported.
  RemoteBoard(std::shared_ptr<tools::ReportedBoard> reported, std::size_t reader, tools::PlantWatch* watch);

  void refresh() override;
  [[nodiscard]] const tools::ReportedBoard* remote() const noexcept override { return reported_.get(); }
  void want() const override;
  [[nodiscard]] std::string state() const override;
  [[nodiscard]] std::string steady_state() const override;
  [[nodiscard]] std::string no_store() const override;
  [[nodiscard]] std::optional<tools::RunView> run() const override { return run_; }
  [[nodiscard]] base::Json forces() const override;
  [[nodiscard]] base::Json lock() const override;
  [[nodiscard]] std::optional<alarms::AlarmCounts> reported_alarms() const override;
  [[nodiscard]] base::Json reported() const override;

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
  using Order = tools::PlantWatch::RemoteOrder;
  // Requests a text of the agent, a JSON object; `what` is what is missing if there is no answer.
  Result<base::Json, Refused> ask(const char* text, const char* what);
  // Completes a command that affects this with its user and notes it; returns why it must not be sent.
  static std::optional<Refused> prepare(Order& order, const Affected& affected, ChangeNote& note);
  // The same and sends it. Returns the agent's message.
  Result<std::string, Refused> send(Order order, const Affected& affected, ChangeNote& note);
  // Returns full names, as far as the reported variables have them.
  [[nodiscard]] std::vector<std::string> full_names(const std::vector<std::string>& names) const;
  Done write(Order::What what, const WriteRequest& request, ChangeNote& note);

  std::shared_ptr<tools::ReportedBoard> reported_;
  std::size_t reader_;
  tools::PlantWatch* watch_;
  std::optional<tools::RunView> run_;  // as received last
  std::int64_t run_until_ns_ = 0;      // when it is requested again
};

}  // namespace indurop::serve
