// SPDX-License-Identifier: Apache-2.0
// Cyclone DDS as the platform needs it: configuration made from the settings, never the user's.

#pragma once

#include <indurop/result.h>

#include <string>

#include "base/problem.h"
#include "dds/entity.h"
#include "dds/network_settings.h"

namespace indurop::dds {

// The domain's configuration for a network interface. Why each line: docs/design/mirror.md.
std::string domain_configuration(const NetworkSettings& settings, const std::string& interface_name);

// A participant in the domain that was made for it.
class Participant {
 public:
  Participant() = default;
  Participant(Entity domain, Entity participant) noexcept
      : domain_(std::move(domain)), participant_(std::move(participant)) {}
  [[nodiscard]] Handle get() const noexcept { return participant_.get(); }
  [[nodiscard]] bool ok() const noexcept { return participant_.ok(); }
  // Waits for listeners that are running.
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
  std::string note;  // something the user should know, or empty
};
// Messages of DDS go to the log sink from now on.
// Errors: the network cannot be had now; the caller tries again.
Result<Joined, base::Problem> join_network(const NetworkSettings& settings);

}  // namespace indurop::dds
