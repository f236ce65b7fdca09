// SPDX-License-Identifier: Apache-2.0
// Derives the gate's settings from the options: whether the address is loopback, which names and tokens are valid.

#pragma once

#include <indurop/result.h>

#include <string_view>
#include <vector>

#include "core/base/problem.h"
#include "tools/client/failure.h"
#include "tools/console/serve_options.h"
#include "tools/serve/client_certificates.h"
#include "tools/serve/door/access_gate.h"

namespace indurop::serve {

struct Admission {
  AccessGateSettings gate;
  ClientCertificates authority;
};
// Evaluates these options. Creates the token file if one is named but does not exist.
Result<Admission, tools::Failure> admission_of(const tools::ServeOptions& options);

bool is_loopback(std::string_view address) noexcept;
// Returns the tokens in the text of a token file, or what is wrong with it.
Result<std::vector<Token>, base::Problem> parse_tokens(std::string_view text);

}  // namespace indurop::serve
