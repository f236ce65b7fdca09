// SPDX-License-Identifier: Apache-2.0
// Sets up Cyclone DDS for the platform: its configuration is made from the settings, never from the user's environment.

#pragma once

#include <indurop/result.h>

#include <string>

#include "core/base/problem.h"
#include "network/dds/entity.h"
#include "network/dds/network_settings.h"

namespace indurop::dds {

// Returns the domain's configuration for a network interface. Reasons for each line: docs/design/mirror.md.
std::string domain_configuration(const NetworkSettings& settings, const std::string& interface_name);

// A participant in its own DDS domain object, or in that of an earlier participant of this process in the same domain:
// then it ends with that one at the latest, and has its settings.
class Participant {
 public:
  Participant() = default;
  Participant(Entity domain, Entity participant) noexcept
      : domain_(std::move(domain)), participant_(std::move(participant)) {}
  [[nodiscard]] Handle get() const noexcept { return participant_.get(); }
  [[nodiscard]] bool ok() const noexcept { return participant_.ok(); }
  // Waits for running listener calls.
  void reset() noexcept {
    participant_.reset();
    domain_.reset();
  }

 private:
  Entity domain_;
  Entity participant_;  // deleted first
};

struct Joined {
  Participant participant;
  std::string note;  // message for the user, or empty
};
// Joins the network. From now on DDS messages go to the log sink. Errors: the network is not available now; the caller
// retries.
Result<Joined, base::Problem> join_network(const NetworkSettings& settings);

}  // namespace indurop::dds
