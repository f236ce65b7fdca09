// SPDX-License-Identifier: Apache-2.0
// Converts types that DDS announces over the network (XTypes type information) to types of variables, so that a tool
// can show a topic of which it has no prior knowledge.

#pragma once

#include <indurop/result.h>

#include <cstdint>

#include "core/base/problem.h"
#include "core/schema/schema.h"
#include "network/dds/entity.h"

namespace indurop::dds {

// Requests unknown types from the network, with at most `timeout_ns` for each. Errors: the type is not available or has
// parts that no variable can have (sequences, unions, text without a limit).
Result<schema::Type, base::Problem> type_from_network(Handle participant, const dds_typeinfo_t& information,
                                                      std::int64_t timeout_ns);

}  // namespace indurop::dds
