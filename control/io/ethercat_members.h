// SPDX-License-Identifier: Apache-2.0
// The devices of a configuration on one EtherCAT bus, and which of the slaves that were found each of them is.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "config/model/io_config.h"
#include "control/io/ethercat/master/scan.h"

namespace indurop::io {

// PDOs that cannot be assigned with one, by its index.
using Excludes = std::map<std::uint16_t, std::vector<std::uint16_t>>;

// What a device wants of its slave.
struct EthercatMember {
  std::string device;
  config::IoSlave slave;
  std::vector<config::IoPoint> outputs;
  std::vector<config::IoPoint> inputs;
  Excludes excludes;  // as the maker's description says
};

// Of each member, in their order, its position on the cable, from 0.
using EthercatPlaces = std::vector<std::size_t>;

// Errors: a slave is missing, is another device than the configuration says, or is meant twice. `interface` is for the
// text.
Result<EthercatPlaces, std::string> find_members(std::span<const EthercatMember> members,
                                                 std::span<const ethercat::FoundSlave> found,
                                                 const std::string& interface);

}  // namespace indurop::io
