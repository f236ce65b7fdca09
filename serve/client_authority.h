// SPDX-License-Identifier: Apache-2.0
// What a client may do that shows a certificate of --client-ca. Of a plant's certificates those of deployers may write
// and all others look; which ones were revoked is looked up each time.

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <string>

#include "base/problem.h"
#include "serve/door/request.h"

namespace indurop::serve {

class ClientAuthority {
 public:
  // Nobody's certificate counts.
  ClientAuthority() = default;
  // `revoked`: a list of this authority; empty: the revoked.pem beside `authority`, which a plant's authority must
  // have.
  static Result<ClientAuthority, base::Problem> open(const std::filesystem::path& authority,
                                                     const std::filesystem::path& revoked);

  // `certificate`: PEM, signed by the authority and valid now.
  [[nodiscard]] Client identify(const std::string& certificate) const;

 private:
  // Why no certificate can be judged; empty: `list` is the list, or there is none.
  [[nodiscard]] std::string read_list(std::string& list) const;

  std::filesystem::path revoked_;  // empty: none is kept
  std::string authority_;          // PEM
};

}  // namespace indurop::serve
