// SPDX-License-Identifier: Apache-2.0
// Where on an EtherCAT bus the bytes are that devices copy from each other.

#pragma once

#include <indurop/result.h>

#include <span>
#include <string>
#include <vector>

#include "control/io/ethercat/master/copies.h"
#include "control/io/ethercat_members.h"

namespace indurop::io {

// `found`: the slaves as they are mapped; `places`: of the members. Errors: both ends of a copy differ in size.
// Not real-time safe.
Result<std::vector<ethercat::Copy>, std::string> find_copies(std::span<const EthercatMember> members,
                                                             std::span<const ethercat::FoundSlave> found,
                                                             const EthercatPlaces& places);

}  // namespace indurop::io
