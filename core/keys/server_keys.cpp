// SPDX-License-Identifier: Apache-2.0
#include "core/keys/server_keys.h"

#include <arpa/inet.h>

#include <algorithm>
#include <array>

#include "core/keys/plant_parts.h"

namespace indurop::keys {

namespace fs = std::filesystem;

namespace {

bool is_address(const std::string& host) {
  std::array<unsigned char, sizeof(in6_addr)> binary{};
  return ::inet_pton(AF_INET, host.c_str(), binary.data()) == 1 ||
         ::inet_pton(AF_INET6, host.c_str(), binary.data()) == 1;
}

std::string alternative_names(const std::vector<std::string>& hosts) {
  std::string names;
  for (const std::string& host : hosts) {
    names += (names.empty() ? "" : ",") + std::string(is_address(host) ? "IP:" : "DNS:") + host;
  }
  return names;
}

}  // namespace

bool is_host(const std::string& host) {
  constexpr std::size_t kLongest = 253;
  const std::string name = host.starts_with("*.") ? host.substr(2) : host;
  return is_address(host) || (!name.empty() && name.size() <= kLongest && name.front() != '-' && name.front() != '.' &&
                              std::all_of(name.begin(), name.end(), [](char c) {
                                return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
                                       c == '-' || c == '.';
                              }));
}

Result<ServerKeys, base::Problem> make_server_keys(const fs::path& keys, const std::string& name,
                                                   const std::vector<std::string>& hosts, Instant until,
                                                   ServerKind kind) {
  const Authority authority = read_authority(keys);
  const auto facts = read_certificate(authority.certificate);
  if (!facts || authority.key.empty()) {
    return base::Problem{"there is no authority with its private key in " + keys.string()};
  }
  const bool opcua = kind == ServerKind::OpcUa;
  const std::string whose = "servers/" + name;
  const ServerKeys made{keys / whose, keys / whose / "server.pem", keys / whose / "server.key"};
  std::error_code ignored;
  const bool renewed = fs::exists(made.key, ignored);
  const std::string key = renewed ? read_text(made.key) : make_key(opcua ? KeyKind::Rsa2048 : KeyKind::P256);
  const std::string names = (opcua ? "URI:urn:indurop:opcua:" + hosts.front() + "," : "") + alternative_names(hosts);
  const auto issue = opcua ? &make_opcua_certificate : &make_server_certificate;
  const std::string certificate = issue(authority, key, {facts->organisation, "server", name}, names,
                                        {instant_now() - std::chrono::days(1), until});
  if (certificate.empty()) {
    return crypto_failed();
  }
  const Done done = in_turn([&] { return make_folder(made.folder); },
                            [&] { return renewed ? Done() : write_new(made.key, key, kSecret); },
                            [&] { return replace(made.certificate, certificate); },
                            [&] { return replace(made.folder / kAuthority, authority.certificate); },
                            [&] { return replace(made.folder / kRevoked, read_text(keys / kRevoked)); },
                            [&] { return note_issued(keys, whose, certificate); });
  if (!done) {
    return done.error();
  }
  return made;
}

}  // namespace indurop::keys
