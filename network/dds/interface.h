// SPDX-License-Identifier: Apache-2.0
// Chooses the network interface of a board. DDS's own choice is not used: it takes loopback while the network is down
// and stays there, and with several network cards it takes one silently.

#pragma once

#include <indurop/result.h>

#include <string>

#include "core/base/problem.h"
#include "network/dds/network_settings.h"

namespace indurop::dds {

struct Interface {
  std::string name;
  std::string note;  // message for the user if the choice was ambiguous
};
// Errors: no interface can be used now, with what to do about it.
Result<Interface, base::Problem> choose_interface(const NetworkSettings& settings);

}  // namespace indurop::dds
