// SPDX-License-Identifier: Apache-2.0
// How a board takes lists of valid keys (core/keys/trust_list.h), and passes them on. Not real-time safe.

#pragma once

#include <indurop/result.h>

#include <string>

#include "core/base/problem.h"
#include "deploy/agent/deploy_keys.h"

namespace indurop::deploy {

// Takes a list for the keys that the board has, logs it in the audit log, and stores it. `plant`: what it runs; `from`:
// the host or board that brought the list. It is also taken if it cannot be logged, as a stop is carried out: a full
// disk must not keep keys valid. Nobody needs a right for this, since only the plant's authority can sign
// lists. Returns what was done, for people; empty: the board has this list already. A problem: nothing was changed.
Result<std::string, base::Problem> take_trust_list(const std::string& board, const DeployKeys& keys,
                                                   const std::string& plant, const std::string& from,
                                                   const std::string& document);

// Returns the serial of the list that the board has; empty: none.
std::string trust_id(const DeployKeys& keys, const std::string& plant);
// Returns the list that the board has, if it is later than the one with this id; else an empty text.
std::string trust_list_after(const DeployKeys& keys, const std::string& plant, const std::string& id);

}  // namespace indurop::deploy
