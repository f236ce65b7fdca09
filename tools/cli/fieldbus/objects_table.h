// SPDX-License-Identifier: Apache-2.0
// The objects of an EtherCAT slave as tables.

#pragma once

#include <string>
#include <vector>

#include "control/io/ethercat/master/dictionary_reader.h"
#include "tools/cli/verbs/verbs.h"

namespace indurop::tools {

// A type that CoE has numbered: "uint16"; "12 bits" if it is none of ours.
std::string coe_type_name(std::uint16_t type, unsigned bits);

void print_objects(Context& context, const std::vector<io::ethercat::DescribedObject>& objects);

}  // namespace indurop::tools
