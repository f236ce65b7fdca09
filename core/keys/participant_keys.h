// SPDX-License-Identifier: Apache-2.0
// The keys folder of one participant: its own credentials, those by which it verifies other participants, and a check
// that all of them fit together.

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <string>

#include "core/base/problem.h"
#include "core/keys/credentials.h"
#include "core/keys/dds_documents.h"

namespace indurop::keys {

struct ParticipantKeys {
  explicit ParticipantKeys(const std::filesystem::path& in);
  std::filesystem::path folder;
  std::filesystem::path authority;
  std::filesystem::path certificate;
  std::filesystem::path key;
  std::filesystem::path governance;
  std::filesystem::path permissions;
  std::filesystem::path revoked;     // certificates that are no longer valid
  std::filesystem::path deploy_key;  // public keys that verify deployments (core/keys/deploy_list.h)
};

// Finds the keys for `--keys FOLDER`: FOLDER's own, if it is the folder of a participant, else those of the first
// viewer or deployer in the folder of a whole plant that was not revoked.
Result<ParticipantKeys, base::Problem> resolve_keys(const std::filesystem::path& folder, Role role);

// The fault of the keys in a folder. Outdated: they are valid, but grant the rights of another release or of another
// list of variables.
enum class KeyFault { None, Missing, Wrong, NotNow, Outdated };
struct KeyCheck {
  KeyFault fault = KeyFault::None;
  std::string problem;
  Validity validity;
  std::string authority;  // its certificate; empty after Missing
  std::string exposed;    // exposed_key() of the private key
};
// Checks the keys as those of this holder at this time.
KeyCheck check_keys(const std::filesystem::path& folder, const Holder& holder, Instant now);
// Checks the keys as those of a board of the plant.
KeyCheck check_board_keys(const std::filesystem::path& folder, const std::string& plant, const std::string& board,
                          Instant now);

// Returns a problem if users other than the owner can read the private key; empty if not, or if there is no key.
std::string exposed_key(const std::filesystem::path& file);

// Returns the start of validity of all certificates. It is far in the past, so that a board that lost its time at
// power-off is not rejected.
Instant valid_from();
Instant instant_now();

}  // namespace indurop::keys
