// SPDX-License-Identifier: Apache-2.0
#include "core/keys/private_key_in.h"

#include <openssl/err.h>
#include <openssl/evp.h>
#include <openssl/pkcs12.h>
#include <openssl/x509.h>

#include <array>
#include <memory>

namespace indurop::keys {
namespace {

// In all of these the key itself follows; a program or a text that only names one of them is rare, and is named.
constexpr std::array<std::string_view, 3> kMarksOfKeys{"PRIVATE KEY-----", "PRIVATE KEY BLOCK-----", "Private-MAC: "};

constexpr unsigned char kSequence = 0x30;  // with which every structure of DER begins that can be a key

template <class Object, class Read, class Free>
bool reads_as(std::string_view content, Read read, Free free) {
  const auto* at = reinterpret_cast<const unsigned char*>(content.data());
  const std::unique_ptr<Object, Free> object(read(nullptr, &at, static_cast<long>(content.size())), free);
  return object != nullptr;
}

bool is_key_in_der(std::string_view content) {
  if (content.empty() || static_cast<unsigned char>(content[0]) != kSequence) {
    return false;
  }
  const bool found = reads_as<EVP_PKEY>(content, &::d2i_AutoPrivateKey, &::EVP_PKEY_free) ||
                     reads_as<PKCS12>(content, &::d2i_PKCS12, &::PKCS12_free) ||
                     reads_as<X509_SIG>(content, &::d2i_X509_SIG, &::X509_SIG_free);
  ::ERR_clear_error();
  return found;
}

}  // namespace

bool holds_private_key(std::string_view content) {
  for (const std::string_view mark : kMarksOfKeys) {
    if (content.find(mark) != std::string_view::npos) {
      return true;
    }
  }
  return is_key_in_der(content);
}

}  // namespace indurop::keys
