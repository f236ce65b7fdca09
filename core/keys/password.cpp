// SPDX-License-Identifier: Apache-2.0
#include "core/keys/password.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <openssl/crypto.h>
#include <openssl/evp.h>
#include <openssl/rand.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <vector>

#include "core/keys/digest.h"

namespace indurop::keys {
namespace {

constexpr std::string_view kScrypt = "scrypt:";
constexpr std::string_view kSha256 = "sha256:";
constexpr std::size_t kSaltBytes = 16;
constexpr std::size_t kHashBytes = 32;

struct ScryptHash {
  unsigned log_cost = 15;  // N = 2^15
  unsigned block = 8;      // r
  unsigned parallel = 1;   // p
  std::vector<std::uint8_t> salt;
  std::vector<std::uint8_t> hash;
};

std::optional<std::vector<std::uint8_t>> bytes_of_hex(std::string_view text, std::size_t count) {
  std::vector<std::uint8_t> bytes(count);
  if (text.size() != 2 * count) {
    return std::nullopt;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const char* const begin = text.data() + 2 * i;
    const auto read = std::from_chars(begin, begin + 2, bytes[i], 16);
    if (read.ec != std::errc() || read.ptr != begin + 2) {
      return std::nullopt;
    }
  }
  return bytes;
}

// Removes the text before the next ':' from `rest` and returns it as a number of low..high.
std::optional<unsigned> next_number(std::string_view& rest, unsigned low, unsigned high) {
  const auto colon = rest.find(':');
  unsigned number = 0;
  const auto read = std::from_chars(rest.data(), rest.data() + std::min(colon, rest.size()), number);
  if (colon == std::string_view::npos || read.ec != std::errc() || read.ptr != rest.data() + colon || number < low ||
      number > high) {
    return std::nullopt;
  }
  rest.remove_prefix(colon + 1);
  return number;
}

// A list may come from another release, or from another person: its costs are limited, so that verifying a password
// takes at most 128 MB.
std::optional<ScryptHash> read_hash(std::string_view text) {
  constexpr unsigned kLargestLogCost = 17;
  constexpr unsigned kBlockSize = 8;
  constexpr unsigned kMostParallel = 4;
  if (!text.starts_with(kScrypt)) {
    return std::nullopt;
  }
  text.remove_prefix(kScrypt.size());
  const auto log_cost = next_number(text, 10, kLargestLogCost);
  const auto block = log_cost ? next_number(text, kBlockSize, kBlockSize) : std::nullopt;
  const auto parallel = block ? next_number(text, 1, kMostParallel) : std::nullopt;
  const auto colon = text.find(':');
  if (!parallel || colon == std::string_view::npos) {
    return std::nullopt;
  }
  auto salt = bytes_of_hex(text.substr(0, colon), kSaltBytes);
  auto hash = bytes_of_hex(text.substr(colon + 1), kHashBytes);
  if (!salt || !hash) {
    return std::nullopt;
  }
  return ScryptHash{*log_cost, *block, *parallel, std::move(*salt), std::move(*hash)};
}

std::vector<std::uint8_t> scrypt(std::string_view password, const ScryptHash& with) {
  constexpr std::uint64_t kMostMemory = std::uint64_t{160} << 20U;
  std::vector<std::uint8_t> hash(kHashBytes);
  if (::EVP_PBE_scrypt(password.data(), password.size(), with.salt.data(), with.salt.size(),
                       std::uint64_t{1} << with.log_cost, with.block, with.parallel, kMostMemory, hash.data(),
                       hash.size()) != 1) {
    std::abort();  // out of memory, or a libcrypto without scrypt
  }
  return hash;
}

}  // namespace

std::string hash_of_password(std::string_view password) {
  ScryptHash hash;
  hash.salt.resize(kSaltBytes);
  if (::RAND_bytes(hash.salt.data(), static_cast<int>(hash.salt.size())) != 1) {
    std::abort();  // the system gives no random numbers
  }
  return fmt::format("{}{}:{}:{}:{:02x}:{:02x}", kScrypt, hash.log_cost, hash.block, hash.parallel,
                     fmt::join(hash.salt, ""), fmt::join(scrypt(password, hash), ""));
}

bool is_password(std::string_view password, std::string_view hash) {
  const auto read = read_hash(hash);
  if (!read || password.size() > kLongestPassword) {
    return false;
  }
  const std::vector<std::uint8_t> own = scrypt(password, *read);
  return ::CRYPTO_memcmp(own.data(), read->hash.data(), own.size()) == 0;
}

bool is_password_hash(std::string_view text) {
  return read_hash(text).has_value();
}

std::string hash_of_token(std::string_view token) {
  return std::string(kSha256) + digest_of(token);
}

bool is_token_hash(std::string_view text) {
  return text.starts_with(kSha256) && is_digest(text.substr(kSha256.size()));
}

}  // namespace indurop::keys
