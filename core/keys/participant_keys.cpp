// SPDX-License-Identifier: Apache-2.0
#include "core/keys/participant_keys.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>
#include <vector>

#include "core/base/text.h"
#include "core/keys/plant_parts.h"
#include "core/keys/revocation.h"

namespace indurop::keys {
namespace {

namespace fs = std::filesystem;

std::string missing_file(const ParticipantKeys& keys) {
  for (const fs::path& file :
       {keys.authority, keys.certificate, keys.key, keys.governance, keys.permissions, keys.revoked}) {
    std::error_code error;
    if (!fs::is_regular_file(file, error)) {
      return fmt::format("cannot read {}: {}", file.string(), error ? error.message() : "it is not a file");
    }
    if (::access(file.c_str(), R_OK) != 0) {
      return fmt::format("cannot read {}: {}", file.string(), std::strerror(errno));
    }
  }
  return {};
}

std::string not_readable(const fs::path& path, std::error_code error) {
  return fmt::format("cannot read {}: {}; the keys have to belong to the user who runs this (ls -l)", path.string(),
                     error.message());
}

// Returns true if `text` is the permissions document that this release makes for the holder.
bool is_current(const std::string& text, const Holder& holder, const CertificateFacts& facts) {
  std::string plain = text;
  std::erase(plain, '\r');
  return base::trimmed(plain) == base::trimmed(permissions_document(holder, facts.subject, facts.validity));
}

}  // namespace

ParticipantKeys::ParticipantKeys(const fs::path& in)
    : folder(in),
      authority(in / "ca.pem"),
      certificate(in / "identity.pem"),
      key(in / "identity.key"),
      governance(in / "governance.p7s"),
      permissions(in / "permissions.p7s"),
      revoked(in / "revoked.pem"),
      deploy_key(in / "deploy.pub") {}

Result<ParticipantKeys, base::Problem> resolve_keys(const fs::path& folder, Role role) {
  std::error_code error;
  const fs::path absolute = fs::absolute(folder, error).lexically_normal();
  const char* const inside = role == Role::Deployer ? "deployer" : "viewer";
  std::vector<fs::path> places{absolute, absolute / inside};
  std::vector<fs::path> further;
  const fs::path others = absolute / (std::string(inside) + "s");
  for (const auto& entry : fs::directory_iterator(others, error)) {
    further.push_back(entry.path());
  }
  std::sort(further.begin(), further.end());
  places.insert(places.end(), further.begin(), further.end());
  std::string revoked;
  std::string closed = error && error != std::errc::no_such_file_or_directory ? not_readable(others, error) : "";
  for (const fs::path& place : places) {
    const ParticipantKeys keys(place);
    if (!fs::exists(keys.certificate, error)) {
      closed = error ? not_readable(keys.certificate, error) : closed;
      continue;
    }
    if (std::string missing = missing_file(keys); !missing.empty()) {
      return base::Problem{std::move(missing)};
    }
    if (place != absolute && is_revoked(read_text(keys.certificate), read_text(keys.revoked))) {
      revoked = place.string();
      continue;
    }
    return keys;
  }
  if (!revoked.empty()) {
    return base::Problem{
        fmt::format("the keys in {} were revoked; make others with indurop keys add --{} NAME", revoked, inside)};
  }
  if (!closed.empty()) {
    return base::Problem{std::move(closed)};
  }
  return base::Problem{
      fmt::format("there are no keys in {}: it has neither identity.pem nor the folder {} (indurop keys "
                  "init and indurop keys add make them)",
                  folder.string(), inside)};
}

KeyCheck check_keys(const fs::path& folder, const Holder& holder, Instant now) {
  const ParticipantKeys keys(folder);
  if (std::string missing = missing_file(keys); !missing.empty()) {
    return {KeyFault::Missing, std::move(missing), {}, {}, {}};
  }
  const std::string certificate = read_text(keys.certificate);
  const std::string authority = read_text(keys.authority);
  const auto wrong = [&](std::string text) { return KeyCheck{KeyFault::Wrong, std::move(text), {}, authority, {}}; };
  const auto facts = read_certificate(certificate);
  if (!facts) {
    return wrong(keys.certificate.string() + " is not a certificate");
  }
  if (facts->organisation != holder.plant || facts->common_name != holder.name) {
    return wrong(fmt::format("{} is the certificate of {} of plant {}", keys.certificate.string(), facts->common_name,
                             facts->organisation));
  }
  if (!issued_by(certificate, authority)) {
    return wrong(fmt::format("{} was not issued by {}", keys.certificate.string(), keys.authority.string()));
  }
  if (!belongs_to(certificate, read_text(keys.key))) {
    return wrong(fmt::format("{} is not the key of {}", keys.key.string(), keys.certificate.string()));
  }
  for (const fs::path& document : {keys.governance, keys.permissions}) {
    if (signed_text(read_text(document), authority).empty()) {
      return wrong(fmt::format("{} is not signed by {}", document.string(), keys.authority.string()));
    }
  }
  const std::string permissions = signed_text(read_text(keys.permissions), authority);
  if (permissions.find(">" + facts->subject + "<") == std::string::npos) {
    return wrong(fmt::format("{} is not for {}", keys.permissions.string(), facts->subject));
  }
  KeyCheck check{KeyFault::None, {}, facts->validity, authority, exposed_key(keys.key)};
  if (is_revoked(certificate, read_text(keys.revoked))) {
    check.fault = KeyFault::Wrong;
    check.problem = fmt::format("{} was revoked", keys.certificate.string());
  } else if (now < facts->validity.from || now > facts->validity.until) {
    check.fault = KeyFault::NotNow;
    check.problem = fmt::format("{} is valid from {} to {}, and now is {}", keys.certificate.string(),
                                utc_text(facts->validity.from), utc_text(facts->validity.until), utc_text(now));
  } else if (!is_current(permissions, holder, *facts)) {
    check.fault = KeyFault::Outdated;
    check.problem = fmt::format("{} does not match this release{}", keys.permissions.string(),
                                holder.role == Role::Tool ? " and variables.txt" : "");
  }
  return check;
}

KeyCheck check_board_keys(const fs::path& folder, const std::string& plant, const std::string& board, Instant now) {
  return check_keys(folder, {Role::Board, plant, board}, now);
}

std::string exposed_key(const fs::path& file) {
  std::error_code error;
  const fs::file_status found = fs::status(file, error);
  constexpr fs::perms kOthers = fs::perms::group_read | fs::perms::others_read;
  if (error || !fs::exists(found) || (found.permissions() & kOthers) == fs::perms::none) {
    return {};
  }
  return fmt::format("{} is a private key that users other than its owner can read; chmod 600 '{}'", file.string(),
                     file.string());
}

Instant valid_from() {
  return std::chrono::sys_days(std::chrono::year(1970) / 1 / 1);
}

Instant instant_now() {
  return std::chrono::time_point_cast<std::chrono::seconds>(std::chrono::system_clock::now());
}

}  // namespace indurop::keys
