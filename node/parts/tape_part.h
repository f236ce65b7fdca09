// SPDX-License-Identifier: Apache-2.0
// The tape of a node: its content follows from which modules read and write which variables.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <memory>

#include "node/run/checked.h"
#include "node/run/console.h"
#include "store/tape/tape.h"
#include "store/vars/store.h"

namespace indurop::node {

// Returns null if the options request no tape. Reports on the console if it will cover less than two seconds. Errors:
// those of tape::Tape::create().
Result<std::unique_ptr<tape::Tape>> make_tape(const Options& options, const Checked& checked,
                                              std::int64_t basic_period_ns, const vars::Store& store,
                                              const Console& console);

}  // namespace indurop::node
