// SPDX-License-Identifier: Apache-2.0
// Reads a new password: at a terminal twice and without showing it, else the first line of standard input.

#pragma once

#include <indurop/result.h>

#include <string>

#include "core/base/problem.h"

namespace indurop::tools {

// `what` as in "password of anna". Error: the two differ, or there is no line.
Result<std::string, base::Problem> read_new_password(const std::string& what);

}  // namespace indurop::tools
