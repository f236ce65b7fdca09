// SPDX-License-Identifier: Apache-2.0
// The boards a tool has heard: who is there, and what they say.

#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "deploy/link/deploy_link.h"
#include "tools/command/verb.h"

namespace indurop::tools {

// Null after an error message.
std::unique_ptr<deploy::DeployLink> open_link(Context& context, deploy::LinkSettings& settings);

// What keys may have to do with boards that were not heard: "; boards that have keys ...".
std::string keys_hint(const deploy::LinkSettings& settings);
// The same behind a failure to hear boards.
Failure with_keys_hint(Failure failure, const deploy::LinkSettings& settings);

class BoardRoster {
 public:
  struct Entry {
    deploy::BoardReport report;
    std::int64_t heard_ns = 0;
  };
  struct Gone {
    std::string board;
    std::uint64_t agent = 0;
  };
  // Takes what has come; `gone` (may be null) gets the agents that left.
  void listen(deploy::DeployLink& link, std::int64_t now_ns, std::vector<Gone>* gone = nullptr);
  // Listens until `enough` or the time is over or the user interrupts.
  template <class Enough>
  void gather(deploy::DeployLink& link, std::int64_t time_ns, Enough enough) {
    gather_until(
        link, time_ns, [](void* e) { return (*static_cast<Enough*>(e))(); }, &enough);
  }

  // Somebody was heard, all boards of the plants they belong to were, and nobody new for a while.
  [[nodiscard]] bool complete() const;

  // Newest word of the board; null if it is not there.
  [[nodiscard]] const Entry* find(const std::string& board) const;
  [[nodiscard]] const std::map<std::pair<std::string, std::uint64_t>, Entry>& all() const noexcept { return boards_; }
  // Their sessions.
  [[nodiscard]] std::vector<std::uint64_t> agents() const;
  // Agents that cannot be understood.
  [[nodiscard]] const std::vector<deploy::OtherAgent>& others() const noexcept { return others_; }
  // Who reports in the name of boards it is not; nothing of that is here.
  [[nodiscard]] const std::vector<deploy::Impostor>& impostors() const noexcept { return impostors_; }
  // Hosts of a name that more than one agent has, both of them alive; empty if it is one.
  [[nodiscard]] std::string twins(const std::string& board, std::int64_t now_ns) const;

 private:
  void gather_until(deploy::DeployLink& link, std::int64_t time_ns, bool (*enough)(void*), void* context);
  std::map<std::pair<std::string, std::uint64_t>, Entry> boards_;  // by name and agent
  std::vector<deploy::OtherAgent> others_;
  std::vector<deploy::Impostor> impostors_;
  std::int64_t newest_ns_ = 0;  // when somebody was heard for the first time
};

}  // namespace indurop::tools
