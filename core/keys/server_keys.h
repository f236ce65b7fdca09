// SPDX-License-Identifier: Apache-2.0
// Certificates for the servers of a plant's boards (TLS of indurop serve, OPC UA of indurop-opcua), issued by the
// plant's authority: in servers/NAME of the folder of its keys.

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "core/keys/credentials.h"

namespace indurop::keys {

// Returns true for an IP address, or a DNS name that may begin with "*.".
bool is_host(const std::string& host);

struct ServerKeys {
  std::filesystem::path folder;
  std::filesystem::path certificate;
  std::filesystem::path key;
};

enum class ServerKind { Tls, OpcUa };

// Makes a private key and a certificate for these hosts; if the key exists already, only a new certificate for it.
// `hosts`: at least one, each is_host(). `keys`: the folder of the plant's keys with its authority. `name`: a file
// name. A participant of DDS Security needs permissions, which a server does not get.
Result<ServerKeys, base::Problem> make_server_keys(const std::filesystem::path& keys, const std::string& name,
                                                   const std::vector<std::string>& hosts, Instant until,
                                                   ServerKind kind = ServerKind::Tls);

}  // namespace indurop::keys
