// SPDX-License-Identifier: Apache-2.0
// How a simulated slave describes its objects.

#pragma once

#include <cstdint>
#include <vector>

#include "control/io/ethercat/sii.h"
#include "control/io/ethercat/simulator/object_dictionary.h"

namespace indurop::io::ethercat {

// The fragments of the answer to a request for SDO information. Messages are what is behind the mailbox header; `room`
// is the size of an answer with its header.
std::vector<std::vector<std::uint8_t>> answer_information(Bytes message, const ObjectDictionary& objects,
                                                          const Sii& sii, std::size_t room);

}  // namespace indurop::io::ethercat
