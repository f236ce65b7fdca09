// SPDX-License-Identifier: Apache-2.0
// The keys by which both sides of a WebSocket know that the other one speaks the protocol (RFC 6455, 4.1 and 4.2.2).

#pragma once

#include <array>
#include <string>
#include <string_view>

namespace indurop::keys {

// Returns a new random key of a client.
std::string web_socket_key();
// Returns the server's answer to a key; empty: `key` is invalid.
std::string web_socket_accept(std::string_view key);
// Returns a new random mask for the frame of a client.
std::array<unsigned char, 4> web_socket_mask();

}  // namespace indurop::keys
