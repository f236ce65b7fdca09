// SPDX-License-Identifier: Apache-2.0
// Objects of libcrypto with owners, and their texts. Used in core/keys/ only.

#pragma once

#include <openssl/bio.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/pkcs7.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>

#include <chrono>
#include <memory>
#include <string>

#include "core/keys/credentials.h"

namespace indurop::keys {

template <auto Free>
struct Freer {
  template <class T>
  void operator()(T* object) const {
    Free(object);
  }
};
using Bio = std::unique_ptr<BIO, Freer<&::BIO_free_all>>;
using Key = std::unique_ptr<EVP_PKEY, Freer<&::EVP_PKEY_free>>;
using Cert = std::unique_ptr<X509, Freer<&::X509_free>>;
using Crl = std::unique_ptr<X509_CRL, Freer<&::X509_CRL_free>>;
using Pkcs7 = std::unique_ptr<PKCS7, Freer<&::PKCS7_free>>;
using Extension = std::unique_ptr<X509_EXTENSION, Freer<&::X509_EXTENSION_free>>;
using Serial = std::unique_ptr<ASN1_INTEGER, Freer<&::ASN1_INTEGER_free>>;
using Number = std::unique_ptr<BIGNUM, Freer<&::BN_free>>;
using Time = std::unique_ptr<ASN1_TIME, Freer<&::ASN1_TIME_free>>;
using Revoked = std::unique_ptr<X509_REVOKED, Freer<&::X509_REVOKED_free>>;
using Context = std::unique_ptr<EVP_MD_CTX, Freer<&::EVP_MD_CTX_free>>;

inline Bio reading(const std::string& text) {
  return Bio(::BIO_new_mem_buf(text.data(), static_cast<int>(text.size())));
}

inline Bio writing() {
  return Bio(::BIO_new(::BIO_s_mem()));
}

inline std::string content(const Bio& bio) {
  const char* data = nullptr;
  const long size = ::BIO_ctrl(bio.get(), BIO_CTRL_INFO, 0, static_cast<void*>(&data));
  return size > 0 ? std::string(data, static_cast<std::size_t>(size)) : std::string{};
}

// Prevents a password prompt at the terminal for a key with a password.
inline int no_password(char* /*into*/, int /*size*/, int /*writing*/, void* /*context*/) {
  return -1;
}

inline Key read_key(const std::string& pem) {
  return Key(::PEM_read_bio_PrivateKey(reading(pem).get(), nullptr, &no_password, nullptr));
}
inline Cert read_cert(const std::string& pem) {
  return Cert(::PEM_read_bio_X509(reading(pem).get(), nullptr, &no_password, nullptr));
}
inline Crl read_crl(const std::string& pem) {
  return Crl(::PEM_read_bio_X509_CRL(reading(pem).get(), nullptr, &no_password, nullptr));
}

inline Time to_time(Instant instant) {
  return Time(::ASN1_TIME_set(nullptr, std::chrono::system_clock::to_time_t(instant)));
}

}  // namespace indurop::keys
