// SPDX-License-Identifier: Apache-2.0
#include "core/keys/web_socket_key.h"

#include <openssl/evp.h>
#include <openssl/rand.h>

#include <algorithm>

namespace indurop::keys {
namespace {

std::string base64_of(const unsigned char* bytes, std::size_t size) {
  std::string text(4 * ((size + 2) / 3) + 1, '\0');  // with the terminator that OpenSSL writes
  const int length = EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()), bytes, static_cast<int>(size));
  text.resize(static_cast<std::size_t>(std::max(length, 0)));
  return text;
}

}  // namespace

std::string web_socket_key() {
  std::array<unsigned char, 16> random{};
  RAND_bytes(random.data(), static_cast<int>(random.size()));
  return base64_of(random.data(), random.size());
}

std::string web_socket_accept(std::string_view key) {
  constexpr std::string_view kGuid = "258EAFA5-E914-47DA-95CA-C5AB0DC85B11";
  constexpr std::size_t kKeyLength = 24;  // 16 bytes
  if (key.size() != kKeyLength || !key.ends_with("==")) {
    return {};
  }
  const std::string text = std::string(key) + std::string(kGuid);
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned size = 0;
  if (EVP_Digest(text.data(), text.size(), digest.data(), &size, EVP_sha1(), nullptr) != 1) {
    return {};
  }
  return base64_of(digest.data(), size);
}

std::array<unsigned char, 4> web_socket_mask() {
  std::array<unsigned char, 4> mask{};
  RAND_bytes(mask.data(), static_cast<int>(mask.size()));
  return mask;
}

}  // namespace indurop::keys
