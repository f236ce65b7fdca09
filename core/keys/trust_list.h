// SPDX-License-Identifier: Apache-2.0
// Which keys of a plant are valid, as one text that the plant's authority has signed (trust.p7s): its boards take it
// from any participant, and pass it on. It is what OPC 10000-12 calls a TrustList. No network.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "core/base/problem.h"
#include "core/keys/credentials.h"
#include "core/keys/participant_keys.h"

namespace indurop::keys {

struct TrustList {
  std::string plant;
  std::uint64_t serial = 0;  // higher in each later list; the time in seconds since 1970, if the clock was right
  std::string revoked;       // text of revoked.pem
  std::string deploy_keys;   // text of deploy.pub
};

// Returns the list as S/MIME; empty if libcrypto failed.
std::string signed_trust_list(const TrustList& list, const Authority& authority);
// Returns nothing if this authority did not sign the document, or if it signed something else.
std::optional<TrustList> read_trust_list(const std::string& document, const std::string& authority);

// Returns the folder for the list of a plant that a board receives, in the board's state folder.
std::filesystem::path received_trust(const std::filesystem::path& state, const std::string& plant);

// What a board trusts: the files in its folder of keys, or a later list that it has received.
struct BoardTrust {
  std::uint64_t serial = 0;       // 0: the files are those of an earlier release, which made no list
  std::string document;           // the list; empty with serial 0
  std::filesystem::path revoked;  // the file of revoked certificates
  std::string deploy_keys;        // text of the deploy.pub that is valid
  std::string problem;            // a received list that cannot be read or is damaged; empty: none
};

// The list that a board has received, in a folder of its own. Not thread-safe with take() on the same folder. A kill
// or loss of power at any moment leaves the list before or the one after.
class ReceivedTrust {
 public:
  ReceivedTrust(ParticipantKeys own, std::filesystem::path folder);

  // Also restores the file of revoked certificates from the list, if it was damaged.
  [[nodiscard]] BoardTrust current() const;
  // Returns the serial of a list that may replace what the board trusts. A problem: it is not signed by the authority
  // in the board's folder of keys, is that of another plant, is not later, is too large, or would make a revoked
  // certificate valid again.
  [[nodiscard]] Result<std::uint64_t, base::Problem> judge(const std::string& document) const;
  // Replaces the list by one that judge() accepts, durably.
  [[nodiscard]] Result<void, base::Problem> take(const std::string& document) const;
  // Returns true if the certificate is revoked by the received list or by the file in the board's folder of keys.
  [[nodiscard]] bool revokes(const std::string& certificate) const;
  // Returns the file that changes with each received list.
  [[nodiscard]] std::filesystem::path file() const;

 private:
  [[nodiscard]] Result<TrustList, base::Problem> later(const std::string& document) const;
  [[nodiscard]] std::filesystem::path revoked() const;

  ParticipantKeys own_;
  std::filesystem::path folder_;
};

}  // namespace indurop::keys
