// SPDX-License-Identifier: Apache-2.0
// The boards that a tool has discovered, and their reports.

#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "deploy/link/deploy_link.h"
#include "tools/client/failure.h"
#include "tools/client/messages.h"

namespace indurop::tools {

// Returns null after an error message.
std::unique_ptr<deploy::DeployLink> open_link(Messages& messages, deploy::LinkSettings& settings);

// Returns a hint that keys may be why boards were not discovered: "; boards that have keys ...".
std::string keys_hint(const deploy::LinkSettings& settings);
// Appends the same hint to a failure to discover boards.
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
  // Processes received messages; `gone` (may be null) gets the agents that left.
  void listen(deploy::DeployLink& link, std::int64_t now_ns, std::vector<Gone>* gone = nullptr);
  // Processes messages until `enough` returns true, the time is over or the user interrupts.
  template <class Enough>
  void gather(deploy::DeployLink& link, std::int64_t time_ns, Enough enough) {
    gather_until(
        link, time_ns, [](void* e) { return (*static_cast<Enough*>(e))(); }, &enough);
  }

  // Returns true if at least one board was discovered, all boards of their plants were, and there was no new one for a
  // while.
  [[nodiscard]] bool complete() const;

  // Newest report of the board; null if it is not present.
  [[nodiscard]] const Entry* find(const std::string& board) const;
  [[nodiscard]] const std::map<std::pair<std::string, std::uint64_t>, Entry>& all() const noexcept { return boards_; }
  // Sessions of the agents.
  [[nodiscard]] std::vector<std::uint64_t> agents() const;
  // Agents with an incompatible protocol.
  [[nodiscard]] const std::vector<deploy::OtherAgent>& others() const noexcept { return others_; }
  // Participants that report in the name of boards they are not; their reports are ignored.
  [[nodiscard]] const std::vector<deploy::Impostor>& impostors() const noexcept { return impostors_; }
  // Returns the hosts of a board name that several live agents use; empty if there is only one.
  [[nodiscard]] std::string twins(const std::string& board, std::int64_t now_ns) const;

 private:
  void gather_until(deploy::DeployLink& link, std::int64_t time_ns, bool (*enough)(void*), void* context);
  std::map<std::pair<std::string, std::uint64_t>, Entry> boards_;  // by name and agent
  std::vector<deploy::OtherAgent> others_;
  std::vector<deploy::Impostor> impostors_;
  std::int64_t newest_ns_ = 0;  // when a board was first discovered most recently
};

// Returns the plant that a verb is about: `wanted`, or the only one of which a board runs a deployment. Errors: no
// board of it was heard (kUnreachable); several plants and none wanted (kUsage).
Result<std::string, Failure> choose_plant(const BoardRoster& roster, const std::string& wanted);

}  // namespace indurop::tools
