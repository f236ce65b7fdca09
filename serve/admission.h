// SPDX-License-Identifier: Apache-2.0
// From the options to what the gate goes by: is the address this machine's own, which names and tokens count.

#pragma once

#include <indurop/result.h>

#include <string_view>
#include <vector>

#include "base/problem.h"
#include "serve/client_authority.h"
#include "serve/door/gate.h"
#include "tools/command/failure.h"
#include "tools/command/serve_options.h"

namespace indurop::serve {

struct Admission {
  GateSettings gate;
  ClientAuthority authority;
};
// What these options want. Makes the token file if it is named and not there.
Result<Admission, tools::Failure> admission_of(const tools::ServeOptions& options);

bool is_loopback(std::string_view address) noexcept;
// Tokens of a file's text, or what is wrong with it.
Result<std::vector<Token>, base::Problem> parse_tokens(std::string_view text);

}  // namespace indurop::serve
