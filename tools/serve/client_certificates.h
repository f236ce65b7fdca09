// SPDX-License-Identifier: Apache-2.0
// The rights of a client with a certificate of --client-ca. Of a plant's certificates, those of deployers have the role
// `program` and all others the role `look`; the revocation list is read again for each request. One thread at a time.

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <string>

#include "core/base/problem.h"
#include "tools/serve/door/request.h"

namespace indurop::serve {

class ClientCertificates {
 public:
  // Accepts no certificate.
  ClientCertificates() = default;
  // `revoked`: a revocation list of this authority; empty: the file revoked.pem in the folder of `authority`, which
  // must exist for a plant's authority, and otherwise from when it was seen first.
  static Result<ClientCertificates, base::Problem> open(const std::filesystem::path& authority,
                                                        const std::filesystem::path& revoked);

  // `certificate`: PEM, signed by the authority or one below it; with a revocation list, by the authority itself.
  [[nodiscard]] Client identify(const std::string& certificate) const;
  // Participants are a plant's boards and tools, strangers have a certificate of an authority that is not of a plant.
  enum class Holder { Participant, Person, Stranger };
  [[nodiscard]] static Holder holder_of(const std::string& certificate);

 private:
  // Returns the revocation list, "" if there is none. Errors: no certificate can be checked.
  [[nodiscard]] Result<std::string, base::Problem> read_list() const;

  std::filesystem::path revoked_;
  mutable bool needs_list_ = true;  // also once one was seen: it must not go again
  std::string authority_;           // PEM
};

}  // namespace indurop::serve
