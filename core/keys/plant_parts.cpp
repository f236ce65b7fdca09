// SPDX-License-Identifier: Apache-2.0
#include "core/keys/plant_parts.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <sstream>

#include "core/base/read_file.h"
#include "core/base/replace_file.h"
#include "core/keys/deploy_list.h"
#include "core/keys/revocation.h"

namespace indurop::keys {

namespace fs = std::filesystem;

namespace {

// Words that name a role or a folder of the keys.
constexpr std::array kRoleWords{"board", "boards", "viewer", "viewers", "deployer", "deployers",
                                "tool",  "tools",  "user",   "users",   "authority"};

// The participant with the smaller GUID starts the handshake, and Cyclone DDS, so a board, does not understand how Fast
// DDS 2.9 starts it. So tools get a unit that makes their GUID greater than that of nearly every board, always the
// same.
Identity identity_of(const Holder& holder) {
  constexpr int kMaxTries = 1'000'000;
  constexpr const char* kHigh = "fff";  // one in 4096
  Identity identity{holder.plant, unit_of(holder.role), holder.name};
  for (int i = 0; holder.role == Role::Tool && i < kMaxTries; ++i) {
    identity.unit = fmt::format("{} {}", unit_of(holder.role), i);
    if (subject_digest(identity).starts_with(kHigh)) {
      break;
    }
  }
  return identity;
}

}  // namespace

std::string read_text(const fs::path& file) {
  auto text = base::read_file(file);
  return text ? std::move(*text) : std::string{};
}

base::Problem crypto_failed() {
  return {crypto_problem()};
}

Done write_new(const fs::path& file, const std::string& text, mode_t mode) {
  if (text.empty()) {
    return crypto_failed();
  }
  const auto written = base::create_file(file, text, mode);
  return written ? Done{} : base::Problem{base::cannot_write(file, written.error())};
}

Done replace(const fs::path& file, const std::string& text) {
  if (text.empty()) {
    return crypto_failed();
  }
  const auto written = base::replace_file(file, text, base::Durable::Yes, kPublic);
  return written ? Done{} : base::Problem{base::cannot_write(file, written.error())};
}

Done move(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::rename(from, to, error);
  return error ? base::Problem{fmt::format("cannot move {} to {}: {}", from.string(), to.string(), error.message())}
               : Done{};
}

Done make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error) {
    fs::permissions(folder, fs::perms::owner_all, error);
  }
  return error ? base::Problem{fmt::format("cannot make the folder {}: {}", folder.string(), error.message())} : Done{};
}

const char* unit_of(Role role) {
  switch (role) {
    case Role::Board:
      return "";  // so that no board can have the name of another role
    case Role::Viewer:
      return "viewer";
    case Role::Deployer:
      return "deployer";
    case Role::Tool:
      return "tool";
    case Role::User:
      return "user";
  }
  return "";
}

base::Problem not_for(Role role, const std::string& name) {
  const char* const what = role == Role::Board ? "board" : unit_of(role);
  std::string text = fmt::format("'{}' is the name of a role and cannot name a {}", name, what);
  for (const Role one_role : {Role::Viewer, Role::Deployer}) {
    if (name == unit_of(one_role)) {
      text += fmt::format("; keys of a further {}: {}", name, how_to_add(one_role, "NAME"));
    }
  }
  return {text};
}

std::string authority_name(const std::string& plant) {
  return plant + " authority";
}

Authority read_authority(const fs::path& folder) {
  return {read_text(folder / kAuthority), read_text(folder / kAuthorityKey)};
}

Done can_issue(const fs::path& folder) {
  const auto key = base::read_file(folder / kAuthorityKey);
  return key ? Done{}
             : base::Problem{base::cannot_read(folder / kAuthorityKey, key.error()) +
                             "; this key of the authority signs certificates and the list of revoked ones"};
}

Credentials issue_credentials(const Authority& authority, const Holder& holder, const std::string& key, Instant until) {
  const Validity validity{valid_from(), until};
  Credentials credentials;
  credentials.certificate = make_certificate(authority, key, identity_of(holder), validity);
  if (const auto facts = read_certificate(credentials.certificate)) {
    credentials.permissions = sign_document(authority, permissions_document(holder, facts->subject, validity));
  }
  return credentials;
}

Done note_issued(const fs::path& keys, const std::string& whose, const std::string& certificate) {
  const auto facts = read_certificate(certificate);
  return facts ? replace(keys / kIssued, read_text(keys / kIssued) + facts->serial + " " + whose + "\n")
               : crypto_failed();
}

std::vector<std::string> issued_to(const fs::path& keys, const std::string& whose) {
  std::istringstream in(read_text(keys / kIssued));
  std::vector<std::string> serials;
  for (std::string serial, name; in >> serial >> name;) {
    if (name == whose) {
      serials.push_back(serial);
    }
  }
  return serials;
}

// The first viewer and deployer have folders of their own.
std::string folder_of(Role role, const std::string& name) {
  const std::string unit = unit_of(role);
  return role == Role::Board ? "boards/" + name : name == unit ? unit : unit + "s/" + name;
}

std::string with_deploy_key(const fs::path& keys, const std::string& deployer, const std::string& key) {
  std::vector<DeployKey> list = read_deploy_list(read_text(keys / kDeployPublic));
  for (DeployKey& each : list) {
    each.former = each.former || each.deployer == deployer;
  }
  const std::string half = public_half(key);
  list.push_back({deployer, false, half});
  return half.empty() ? std::string{} : deploy_list_text(list);
}

Done make_participant(const fs::path& keys, const fs::path& folder, const Holder& holder, Instant until) {
  const Authority authority = read_authority(keys);
  const std::string key = make_key(KeyKind::P256);
  const Credentials credentials = issue_credentials(authority, holder, key, until);
  Done done =
      in_turn([&] { return make_folder(folder); }, [&] { return write_new(folder / kIdentityKey, key, kSecret); },
              [&] { return write_new(folder / kIdentity, credentials.certificate, kPublic); },
              [&] { return write_new(folder / kPermissions, credentials.permissions, kPublic); },
              [&] { return note_issued(keys, folder_of(holder.role, holder.name), credentials.certificate); });
  if (done && holder.role == Role::Tool) {
    done = write_new(folder / kVariables, rights_text(holder.variables), kPublic);
  }
  std::string deploy_list = read_text(keys / kDeployPublic);
  if (done && holder.role == Role::Deployer) {
    const std::string signing = make_key(KeyKind::Ed25519);
    deploy_list = with_deploy_key(keys, holder.name, signing);
    done = write_new(folder / kDeployKey, signing, kSecret);
  }
  for (const char* common : {kAuthority, kGovernance, kRevoked}) {
    if (done) {
      done = write_new(folder / common, read_text(keys / common), kPublic);
    }
  }
  if (const std::string trust = read_text(keys / kTrust); done && !trust.empty()) {
    done = write_new(folder / kTrust, trust, kPublic);
  }
  return done ? write_new(folder / kDeployPublic, deploy_list, kPublic) : done;
}

Done make_top(const fs::path& folder, const std::string& plant, Instant until) {
  // The authority is valid longer than the certificates it issues.
  const Validity validity{valid_from(), until + std::chrono::days(3650)};
  Authority authority;
  authority.key = make_key(KeyKind::P256);
  authority.certificate = make_authority(authority.key, {plant, "", authority_name(plant)}, validity);
  return in_turn(
      [&] { return make_folder(folder / "boards"); }, [&] { return make_folder(folder); },
      // Keys do not belong into version control.
      [&] { return write_new(folder / ".gitignore", "*\n", kPublic); },
      [&] { return write_new(folder / kAuthorityKey, authority.key, kSecret); },
      [&] { return write_new(folder / kAuthority, authority.certificate, kPublic); },
      [&] { return write_new(folder / kGovernance, sign_document(authority, governance_document()), kPublic); },
      [&] { return write_new(folder / kRevoked, make_revocation_list(authority, "", {}, validity), kPublic); },
      [&] { return write_new(folder / kDeployPublic, deploy_list_text({}), kPublic); });
}

// Moves the finished folder into place, or deletes it after a failure.
Done put_in_place(Done made, const fs::path& fresh, const fs::path& folder) {
  std::error_code error;
  if (made) {
    fs::rename(fresh, folder, error);  // fails if the target is not empty
    if (error) {
      made = base::Problem{fmt::format("cannot make {}: {}", folder.string(), error.message())};
    }
  }
  if (!made) {
    fs::remove_all(fresh, error);
  }
  return made;
}

fs::path aside(const fs::path& folder) {
  return folder.parent_path() / fmt::format(".{}.{}.new", folder.filename().string(), ::getpid());
}

KeyListing listing_of(Role role, const fs::path& folder, const std::string& authority, const std::string& revoked,
                      Instant now) {
  KeyListing listing{role, folder.filename().string(), folder, {}, false, {}, {}, {}};
  const ParticipantKeys keys(folder);
  for (const fs::path& key : {keys.key, folder / kDeployKey, folder / kDeployKeyBefore, folder / kDeployKeyNext}) {
    listing.exposed = listing.exposed.empty() ? exposed_key(key) : listing.exposed;
  }
  if (const auto read = base::read_file(keys.certificate); !read) {
    listing.problem = base::cannot_read(keys.certificate, read.error());
    return listing;
  }
  const std::string certificate = read_text(keys.certificate);
  const auto facts = read_certificate(certificate);
  if (!facts) {
    listing.problem = fmt::format("{} is not a certificate", keys.certificate.string());
    return listing;
  }
  if (role == Role::Tool) {
    auto rights = read_rights(folder / kVariables);
    if (!rights) {
      listing.problem = std::move(rights).error().text;
      return listing;
    }
    listing.variables = std::move(rights).value();
  }
  listing.validity = facts->validity;
  listing.revoked = is_revoked(certificate, revoked);
  const KeyCheck check = check_keys(folder, {role, facts->organisation, facts->common_name, listing.variables}, now);
  if (listing.revoked) {
    listing.problem = "revoked";
  } else if (!issued_by(certificate, authority)) {
    listing.problem = "issued by another authority";
  } else if (facts->common_name != listing.name) {
    listing.problem = "the certificate is that of " + facts->common_name;
  } else {
    listing.problem = check.problem;
    if (check.fault == KeyFault::Outdated) {
      listing.problem += "; indurop keys renew " + listing.name;
    }
  }
  return listing;
}

std::vector<KeyListing> listings_in(Role role, const fs::path& folder, const fs::path& keys, Instant now) {
  const std::string authority = read_text(keys / kAuthority);
  const std::string revoked = read_text(keys / kRevoked);
  std::vector<KeyListing> all;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (!entry.path().filename().string().starts_with(".")) {
      all.push_back(listing_of(role, entry.path(), authority, revoked, now));
    }
  }
  std::sort(all.begin(), all.end(), [](const KeyListing& a, const KeyListing& b) { return a.name < b.name; });
  return all;
}

bool reserved_name(const std::string& name) {
  return std::any_of(kRoleWords.begin(), kRoleWords.end(), [&](const char* word) { return name == word; });
}

std::string how_to_add(Role role, const std::string& name) {
  const std::string option = role == Role::Board ? "" : std::string("--") + unit_of(role) + " ";
  return "indurop keys add " + option + name + (role == Role::Tool ? " --read PATTERNS" : "");
}

bool is_plant_authority(const CertificateFacts& facts) {
  return facts.common_name == authority_name(facts.organisation);
}

bool is_plant_certificate(const CertificateFacts& facts) {
  return facts.issuer.organisation == facts.organisation &&
         facts.issuer.common_name == authority_name(facts.organisation);
}

std::optional<Role> plant_role(const CertificateFacts& facts) {
  const std::string kind = facts.unit.substr(0, facts.unit.find(' '));  // for tools a number follows
  for (const Role role : {Role::Board, Role::Viewer, Role::Deployer, Role::Tool, Role::User}) {
    if (is_plant_certificate(facts) && kind == unit_of(role)) {
      return role;
    }
  }
  return std::nullopt;
}

}  // namespace indurop::keys
