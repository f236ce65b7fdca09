// SPDX-License-Identifier: Apache-2.0
// The rights of a client with a certificate of --client-ca. Of a plant's certificates, those of deployers have the role
// `program` and all others the role `look`; the revocation list is read again for each request.

#pragma once

#include <indurop/result.h>

#include <atomic>
#include <filesystem>
#include <memory>
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
  // Returns false for certificates of a plant's boards and tools.
  [[nodiscard]] static bool is_person(const std::string& certificate);
  // Returns false for certificates of authorities other than those of plants.
  [[nodiscard]] static bool is_of_plant(const std::string& certificate);

 private:
  // Returns the revocation list, "" if there is none. Errors: no certificate can be checked.
  [[nodiscard]] Result<std::string, base::Problem> read_list() const;

  std::filesystem::path revoked_;
  std::shared_ptr<std::atomic<bool>> needs_list_ = std::make_shared<std::atomic<bool>>(true);
  std::string authority_;  // PEM
};

}  // namespace indurop::serve
