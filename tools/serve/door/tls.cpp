// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/door/tls.h"

#include <fmt/format.h>
#include <openssl/err.h>

#include <array>
#include <cstring>

namespace indurop::serve {
namespace {

// A key with a password is refused, because there is no user to enter it.
int no_password(char* /*into*/, int /*size*/, int /*writing*/, void* /*context*/) {
  return -1;
}

// Only HTTP/1.1 is supported; a client that does not offer it is served with it all the same.
int choose_protocol(SSL* /*connection*/, const unsigned char** chosen, unsigned char* length,
                    const unsigned char* offered, unsigned offered_length, void* /*context*/) {
  static constexpr std::array<unsigned char, 9> kOurs{8, 'h', 't', 't', 'p', '/', '1', '.', '1'};
  unsigned char* found = nullptr;
  const int result = SSL_select_next_proto(&found, length, kOurs.data(), kOurs.size(), offered, offered_length);
  *chosen = found;
  return result == OPENSSL_NPN_NEGOTIATED ? SSL_TLSEXT_ERR_OK : SSL_TLSEXT_ERR_NOACK;
}

}  // namespace

Result<TlsContext, base::Problem> open_tls(const std::filesystem::path& certificate, const std::filesystem::path& key,
                                           const std::filesystem::path& client_ca) {
  TlsContext context(SSL_CTX_new(TLS_server_method()));
  if (context == nullptr) {
    return base::Problem{"libssl cannot start"};
  }
  SSL_CTX_set_min_proto_version(context.get(), TLS1_2_VERSION);
  // Sessions are not resumed: a client that returns presents its certificate again, which may have been revoked.
  SSL_CTX_set_options(context.get(), SSL_OP_NO_RENEGOTIATION | SSL_OP_NO_COMPRESSION | SSL_OP_NO_TICKET |
                                         SSL_OP_CIPHER_SERVER_PREFERENCE);
  SSL_CTX_set_session_cache_mode(context.get(), SSL_SESS_CACHE_OFF);
  SSL_CTX_set_mode(context.get(), SSL_MODE_ENABLE_PARTIAL_WRITE | SSL_MODE_ACCEPT_MOVING_WRITE_BUFFER);
  SSL_CTX_set_default_passwd_cb(context.get(), &no_password);
  SSL_CTX_set_alpn_select_cb(context.get(), &choose_protocol, nullptr);
  const bool own = SSL_CTX_use_certificate_chain_file(context.get(), certificate.c_str()) == 1 &&
                   SSL_CTX_use_PrivateKey_file(context.get(), key.c_str(), SSL_FILETYPE_PEM) == 1 &&
                   SSL_CTX_check_private_key(context.get()) == 1;
  ERR_clear_error();
  if (!own) {
    return base::Problem{fmt::format("{} and {} cannot be used for TLS: they do not belong together, or cannot be read",
                                     certificate.string(), key.string())};
  }
  if (client_ca.empty()) {
    return context;
  }
  if (SSL_CTX_load_verify_locations(context.get(), client_ca.c_str(), nullptr) != 1) {
    ERR_clear_error();
    return base::Problem{fmt::format("{} cannot be read, or holds no certificate", client_ca.string())};
  }
  SSL_CTX_set_client_CA_list(context.get(), SSL_load_client_CA_file(client_ca.c_str()));
  SSL_CTX_set_verify(context.get(), SSL_VERIFY_PEER, nullptr);
  return context;
}

}  // namespace indurop::serve
