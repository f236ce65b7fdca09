// SPDX-License-Identifier: Apache-2.0
// TLS of the server: its certificate, and which authority signs certificates of clients.

#pragma once

#include <indurop/result.h>
#include <openssl/ssl.h>

#include <filesystem>
#include <memory>

#include "core/base/problem.h"

namespace indurop::serve {

struct FreeTls {
  void operator()(SSL_CTX* context) const noexcept { SSL_CTX_free(context); }
  void operator()(SSL* connection) const noexcept { SSL_free(connection); }
};
using TlsContext = std::unique_ptr<SSL_CTX, FreeTls>;
using TlsConnection = std::unique_ptr<SSL, FreeTls>;

// `client_ca` may be empty: no client is asked for a certificate. A client need not present one, but a certificate that
// is not signed by this authority, or not valid now, ends the connection.
Result<TlsContext, base::Problem> open_tls(const std::filesystem::path& certificate, const std::filesystem::path& key,
                                           const std::filesystem::path& client_ca);

}  // namespace indurop::serve
