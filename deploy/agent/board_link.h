// SPDX-License-Identifier: Apache-2.0
// The agent's connection to the network: tried until it succeeds, with the keys of its board if it has some, and again
// when the keys have changed.

#pragma once

#include <memory>
#include <string>

#include "core/base/log.h"
#include "core/rt/clock.h"
#include "deploy/agent/deploy_keys.h"
#include "deploy/link/command_link.h"
#include "deploy/link/deploy_link.h"

namespace indurop::deploy {

class BoardLink {
 public:
  BoardLink(LinkSettings settings, const DeployKeys& keys, const base::Log& log)
      : settings_(std::move(settings)), keys_(keys), log_(log) {}

  // Joins the network if it is due; leaves it first if the keys have changed and the agent is `idle`. `plant`: what is
  // committed. Returns true if it has joined just now.
  bool keep(rt::MonoTime now, const std::string& plant, bool idle);
  void leave() noexcept;
  [[nodiscard]] bool has_keys() const noexcept { return !own_.folder.empty(); }
  // The plant whose keys this board has; empty: none.
  [[nodiscard]] const std::string& plant() const noexcept { return own_.plant; }
  // Null while not connected; link(), platform() and commands() are either all null or all valid.
  [[nodiscard]] DeployLink* link() const noexcept { return link_.get(); }
  // The same boards, about the platform.
  [[nodiscard]] DeployLink* platform() const noexcept { return platform_.get(); }
  [[nodiscard]] CommandLink* commands() const noexcept { return commands_.get(); }

 private:
  // Returns a note for people.
  std::string join();
  void warn(const std::string& message);

  LinkSettings settings_;
  const DeployKeys& keys_;
  const base::Log& log_;
  std::unique_ptr<DeployLink> link_;
  std::unique_ptr<DeployLink> platform_;   // in the participant of link_
  std::unique_ptr<CommandLink> commands_;  // destroyed first
  OwnKeys own_;
  rt::MonoTime join_at_;
  rt::MonoTime next_check_;
  std::string last_warning_;
};

}  // namespace indurop::deploy
