// SPDX-License-Identifier: Apache-2.0
// Several modules that are exchanged at one tick, for a deployment, and the schedule with them: all or nothing. They
// are prepared first; then the agent says the tick, and, after it, which of the two deployments is to run. If a new
// version fails meanwhile, all previous ones run again. Called by the thread that supervises the node.

#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "node/exchange/version_exchange.h"
#include "store/operate/exchange_set.h"

namespace indurop::node {

class ExchangeSet {
 public:
  explicit ExchangeSet(ExchangeContext& context) : context_(context) {}

  // Continues.
  void poll(rt::MonoTime now);
  // Accepts a command, and answers it. `single`: the module that is exchanged alone; empty: none.
  void command(const std::string& single);
  // Called when the schedule has ended.
  void end();
  [[nodiscard]] bool is_under_way() const noexcept;
  // Returns true while it is not settled which version of the module runs.
  [[nodiscard]] bool is_open(std::uint32_t module) const noexcept;

 private:
  // Returns why the command is refused; empty: it is accepted.
  std::string accept(const std::string& single);
  std::string begin(const operate::SetRequest& request);
  std::string exchange(std::uint64_t tick);
  std::string decide(const std::string& deployment);
  void fail(const std::string& why);
  void go_on();
  void conclude_preparation();
  void follow_exchange();
  void conclude();
  void forget();
  void run_deployment(const std::string& id);
  void set_state(operate::SetReport::State state);
  void write_report(rt::MonoTime now);

  ExchangeContext& context_;
  std::map<std::uint32_t, std::unique_ptr<VersionExchange>> all_;  // by module
  std::vector<std::uint32_t> order_;                               // of the request
  std::map<std::uint32_t, std::string> files_;                     // new ones
  std::string before_;                                             // ids of the two deployments
  std::string after_;
  bool compares_ = false;   // nothing is exchanged
  bool keeps_new_ = false;  // decided; while Leaving
  operate::SetReport report_;
  std::optional<rt::MonoTime> write_at_;  // the report could not be written, as on a full disk: again at this time
};

}  // namespace indurop::node
