// SPDX-License-Identifier: Apache-2.0
#include "deploy/link/link_keys.h"

#include <cstdio>

namespace indurop::deploy {

namespace {

// Prints the warnings on the terminal, to the user who gave --keys.
void warn_of(const keys::ParticipantKeys& keys) {
  if (const std::string exposed = keys::exposed_key(keys.key); !exposed.empty()) {
    (void)std::fprintf(stderr, "warning: %s\n", exposed.c_str());
  }
}

}  // namespace

dds::Security security_of(const keys::ParticipantKeys& keys) {
  return {keys.authority.string(),  keys.certificate.string(), keys.key.string(),
          keys.governance.string(), keys.permissions.string(), keys.revoked.string()};
}

Result<void, base::Problem> use_keys(LinkSettings& settings) {
  const auto keys = keys::resolve_keys(settings.keys, keys::Role::Deployer);
  if (!keys) {
    return keys.error();
  }
  warn_of(*keys);
  settings.network.security = security_of(*keys);
  settings.keys = keys->folder;
  return {};
}

base::Option add_keys_option(base::Options& line, dds::Security& security, keys::Role role, const std::string& help,
                             std::filesystem::path* given) {
  const auto take = [&security, role, given](const std::string& text) {
    const auto keys = keys::resolve_keys(text, role);
    if (!keys) {
      return keys.error().text;
    }
    warn_of(*keys);
    security = security_of(*keys);
    if (given != nullptr) {
      *given = text;
    }
    return std::string();
  };
  return line.add("--keys", "DIR", take, help).completes(base::Completion::Folder);
}

}  // namespace indurop::deploy
