// SPDX-License-Identifier: Apache-2.0
// Types as DDS tells them over the network (XTypes type information) as types of variables: so that a tool can show a
// topic of which it knows nothing beforehand.

#pragma once

#include <indurop/result.h>

#include <cstdint>

#include "base/problem.h"
#include "dds/entity.h"
#include "schema/schema.h"

namespace indurop::dds {

// Asks the network for what it does not know yet, `timeout_ns` per type at most.
// Errors: the type cannot be had or has parts that no variable can have (sequences, unions, text without a limit).
Result<schema::Type, base::Problem> type_from_network(Handle participant, const dds_typeinfo_t& information,
                                                      std::int64_t timeout_ns);

}  // namespace indurop::dds
