// SPDX-License-Identifier: Apache-2.0
// Parts of the folder of a plant's keys: its files, the folder of one participant, and reading such a folder. Used in
// core/keys/ only.

#pragma once

#include <indurop/result.h>
#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "core/keys/plant_keys.h"

namespace indurop::keys {

inline constexpr const char* kAuthorityKey = "ca.key";
inline constexpr const char* kAuthority = "ca.pem";
inline constexpr const char* kGovernance = "governance.p7s";
inline constexpr const char* kRevoked = "revoked.pem";
inline constexpr const char* kTrust = "trust.p7s";
inline constexpr const char* kIssued = "issued.txt";
inline constexpr const char* kDeployKey = "deploy.key";
inline constexpr const char* kDeployKeyBefore = "deploy.key.before";  // until the change to a new one is finished
inline constexpr const char* kDeployKeyNext = "deploy.key.next";      // until it is in deploy.pub
inline constexpr const char* kDeployPublic = "deploy.pub";
inline constexpr const char* kIdentityKey = "identity.key";
inline constexpr const char* kIdentity = "identity.pem";
inline constexpr const char* kPermissions = "permissions.p7s";
inline constexpr const char* kVariables = "variables.txt";  // of a tool
inline constexpr mode_t kSecret = 0600;
inline constexpr mode_t kPublic = 0644;

using Done = Result<void, base::Problem>;

// Runs the steps until one returns a problem, and returns that problem.
template <class... Steps>
Done in_turn(const Steps&... steps) {
  Done done;
  (void)((done = steps(), done.ok()) && ...);
  return done;
}

std::string read_text(const std::filesystem::path& file);
base::Problem crypto_failed();
// Writes a new file; fails if it already exists.
Done write_new(const std::filesystem::path& file, const std::string& text, mode_t mode);
// Writes a file or replaces an existing one atomically. Never used for private keys.
Done replace(const std::filesystem::path& file, const std::string& text);
// Renames a file, and replaces an existing one.
Done move(const std::filesystem::path& from, const std::filesystem::path& to);
Done make_folder(const std::filesystem::path& folder);
// Returns a path next to `folder`, where a folder is made before it is moved into place, or moved to before it is
// deleted.
std::filesystem::path aside(const std::filesystem::path& folder);
Done put_in_place(Done made, const std::filesystem::path& fresh, const std::filesystem::path& folder);

const char* unit_of(Role role);
std::string folder_of(Role role, const std::string& name);
std::string authority_name(const std::string& plant);
base::Problem not_for(Role role, const std::string& name);
Authority read_authority(const std::filesystem::path& folder);
// A problem: the private key of the authority cannot be read.
Done can_issue(const std::filesystem::path& folder);

// The documents for `key`: its certificate, and permissions for exactly that name.
struct Credentials {
  std::string certificate;
  std::string permissions;
};
Credentials issue_credentials(const Authority& authority, const Holder& holder, const std::string& key, Instant until);
// Keeps a list of all certificates ever issued: "SERIAL FOLDER". Without it, old certificates of a renewed board could
// not be revoked.
Done note_issued(const std::filesystem::path& keys, const std::string& whose, const std::string& certificate);
std::vector<std::string> issued_to(const std::filesystem::path& keys, const std::string& whose);
// Returns the list of deploy keys with a new key of this deployer added; its existing key is marked as former.
std::string with_deploy_key(const std::filesystem::path& keys, const std::string& deployer, const std::string& key);

Done make_top(const std::filesystem::path& folder, const std::string& plant, Instant until);
// Makes one participant's folder, with copies of the shared files and, for a deployer, the signing key.
Done make_participant(const std::filesystem::path& keys, const std::filesystem::path& folder, const Holder& holder,
                      Instant until);
KeyListing listing_of(Role role, const std::filesystem::path& folder, const std::string& authority,
                      const std::string& revoked, Instant now);
std::vector<KeyListing> listings_in(Role role, const std::filesystem::path& folder, const std::filesystem::path& keys,
                                    Instant now);

}  // namespace indurop::keys
