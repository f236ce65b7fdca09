// SPDX-License-Identifier: Apache-2.0
// Passwords and tokens as a list of users keeps them: what cannot be turned back into them.

#pragma once

#include <string>
#include <string_view>

namespace indurop::keys {

inline constexpr std::size_t kShortestPassword = 8;  // bytes; NIST SP 800-63B, 5.1.1.2
inline constexpr std::size_t kLongestPassword = 200;

// Returns "scrypt:15:8:1:SALT:HASH" by scrypt (RFC 7914) with a random salt. Takes some 0.1 s and 32 MB. Not real-time
// safe.
std::string hash_of_password(std::string_view password);
// Returns true if the hash is that of this password. As slow as hash_of_password(); false for a text that is no hash.
bool is_password(std::string_view password, std::string_view hash);
// Returns true for a text of the form of hash_of_password() whose cost this release accepts.
bool is_password_hash(std::string_view text);

// Returns "sha256:HASH". Tokens are random, so guessing them needs no slowing down.
std::string hash_of_token(std::string_view token);
bool is_token_hash(std::string_view text);

}  // namespace indurop::keys
