// SPDX-License-Identifier: Apache-2.0
// Recognizes private keys in files that are to be sent to others.

#pragma once

#include <string_view>

namespace indurop::keys {

// Returns true if the content of a file is or contains a private key: PEM (also of OpenSSH and PGP), PuTTY, DER, or
// PKCS #12, encrypted or not.
[[nodiscard]] bool holds_private_key(std::string_view content);

}  // namespace indurop::keys
