// SPDX-License-Identifier: Apache-2.0
// Values of this board's variables that somebody elsewhere wants held, whoever writes them (vars/store.h).

#pragma once

#include <indurop/result.h>

#include <string>

#include "base/problem.h"

namespace indurop::deploy {

// `target` as Action::Force has it: all of its values are held, or, with a problem that names all that are wrong,
// none. Values must be numbers and within their declared range. Not real-time safe.
Result<void, base::Problem> force_values(const std::string& board, const std::string& target);

// As Action::Unforce has it. What is not forced is let go already; a name that is nothing is a problem.
Result<void, base::Problem> unforce_values(const std::string& board, const std::string& target);

}  // namespace indurop::deploy
