// SPDX-License-Identifier: Apache-2.0
// The folder of one participant: what it shows to the others, what it judges them by, and whether all of it fits
// together.

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <string>

#include "base/problem.h"
#include "keys/credentials.h"
#include "keys/dds_documents.h"

namespace indurop::keys {

struct ParticipantKeys {
  explicit ParticipantKeys(const std::filesystem::path& in);
  std::filesystem::path folder;
  std::filesystem::path authority;
  std::filesystem::path certificate;
  std::filesystem::path key;
  std::filesystem::path governance;
  std::filesystem::path permissions;
  std::filesystem::path revoked;     // certificates that are not valid any more
  std::filesystem::path deploy_key;  // public keys of what signs deployments (keys/deploy_list.h)
};

// Whose keys `--keys FOLDER` means: FOLDER's own, if it is that of a participant, else those of the first viewer or
// deployer in the folder of a whole plant that was not revoked.
Result<ParticipantKeys, base::Problem> keys_meant(const std::filesystem::path& folder, Role role);

// What is wrong with the keys in a folder. Outdated: they hold, but permit what another release, or another list of
// variables, wanted.
enum class KeyFault { None, Missing, Wrong, NotNow, Outdated };
struct KeyCheck {
  KeyFault fault = KeyFault::None;
  std::string problem;
  Validity validity;
  std::string authority;  // its certificate; empty after Missing
  std::string exposed;    // exposed_key() of the private key
};
// As those of this holder at this time.
KeyCheck check_keys(const std::filesystem::path& folder, const Holder& holder, Instant now);
// As those of a board of the plant.
KeyCheck check_board_keys(const std::filesystem::path& folder, const std::string& plant, const std::string& board,
                          Instant now);

// What is wrong if others than its owner can read a private key; empty: nothing, or there is none.
std::string exposed_key(const std::filesystem::path& file);

// From when all certificates count. Long ago, so that a board that lost its time at power-off is not kept out.
Instant valid_from();
Instant instant_now();

}  // namespace indurop::keys
