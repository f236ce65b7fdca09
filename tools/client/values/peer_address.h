// SPDX-License-Identifier: Apache-2.0
// Resolves the addresses of machines given by name. Name servers may take many seconds to answer, or not answer at all:
// no caller waits longer than its deadline.

#pragma once

#include <indurop/result.h>

#include <string>
#include <vector>

#include "core/rt/clock.h"
#include "tools/client/failure.h"

namespace indurop::tools {

// `peers` are NAME or NAME:PORT; returns the same with addresses instead of names. Resolves all at once. Errors: no
// machine has such a name; no answer until `deadline`.
Result<std::vector<std::string>, Failure> peer_addresses(const std::vector<std::string>& peers, rt::MonoTime deadline);

}  // namespace indurop::tools
