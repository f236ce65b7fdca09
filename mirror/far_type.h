// SPDX-License-Identifier: Apache-2.0
// Types as DDS tells them over the network (XTypes type information) as types of variables: so that a tool can show a
// topic of which it knows nothing beforehand.

#pragma once

#include <dds/dds.h>

#include <cstdint>
#include <optional>
#include <string>

#include "schema/schema.h"

namespace indurop::mirror {

// Asks the network for what it does not know yet, `timeout_ns` per type at most. Nothing, and `problem` says why, if
// the type cannot be had or has parts that no variable can have (sequences, unions, text without a limit).
std::optional<schema::Type> type_from_network(dds_entity_t participant, const dds_typeinfo_t* information,
                                              std::int64_t timeout_ns, std::string& problem);

// Of a struct with the one member `value`, which is what stands for a variable that is no single struct, the member.
schema::Type unwrapped(const schema::Type& type, const std::string& variable);

}  // namespace indurop::mirror
