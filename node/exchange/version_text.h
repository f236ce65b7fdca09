// SPDX-License-Identifier: Apache-2.0
// What the exchanges of threads and of processes say in the same words.

#pragma once

#include <string>

#include "scheduler/exchange.h"
#include "scheduler/run_block.h"
#include "store/operate/reload.h"

namespace indurop::node {

// The first digits of a SHA-256.
std::string short_digest(const std::string& digest);
// Why the previous version of the module runs again.
std::string text_of(scheduler::Exchange::Reason reason, const scheduler::ModuleRecord& module);
// That the new version is refused.
std::string count_errors(const operate::ReloadReport& report);

}  // namespace indurop::node
