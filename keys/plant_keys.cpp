// SPDX-License-Identifier: Apache-2.0
#include "keys/plant_keys.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <iterator>
#include <sstream>

#include "base/read_file.h"
#include "base/replace_file.h"

namespace indurop::keys {
namespace {

namespace fs = std::filesystem;

constexpr const char* kAuthorityKey = "ca.key";
constexpr const char* kAuthority = "ca.pem";
constexpr const char* kGovernance = "governance.p7s";
constexpr const char* kRevoked = "revoked.pem";
constexpr const char* kIssued = "issued.txt";
constexpr const char* kDeployKey = "deploy.key";
constexpr const char* kDeployPublic = "deploy.pub";
constexpr const char* kIdentityKey = "identity.key";
constexpr const char* kIdentity = "identity.pem";
constexpr const char* kPermissions = "permissions.p7s";
constexpr const char* kVariables = "variables.txt";  // of a tool
constexpr mode_t kSecret = 0600;
constexpr mode_t kPublic = 0644;

std::string read_text(const fs::path& file) {
  auto text = base::read_file(file);
  return text ? std::move(*text) : std::string{};
}

using Done = Result<void, base::Problem>;

base::Problem crypto_failed() {
  return {crypto_problem()};
}

// A file that is not there yet.
Done write_new(const fs::path& file, const std::string& text, mode_t mode) {
  if (text.empty()) {
    return crypto_failed();
  }
  const auto written = base::create_file(file, text, mode);
  return written ? Done{} : base::Problem{base::cannot_write(file, written.error())};
}

// A file that may be there already is replaced at once or not at all. Never for private keys.
Done replace(const fs::path& file, const std::string& text) {
  if (text.empty()) {
    return crypto_failed();
  }
  const auto written = base::replace_file(file, text, base::Durable::Yes, kPublic);
  return written ? Done{} : base::Problem{base::cannot_write(file, written.error())};
}

Done make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error) {
    fs::permissions(folder, fs::perms::owner_all, error);
  }
  return error ? base::Problem{fmt::format("cannot make the folder {}: {}", folder.string(), error.message())} : Done{};
}

// Does the steps until one has a problem, which is returned.
template <class... Steps>
Done in_turn(const Steps&... steps) {
  Done done;
  (void)((done = steps(), done.ok()) && ...);
  return done;
}

const char* unit_of(Role role) {
  switch (role) {
    case Role::Board:
      return "";  // so that no board can be named like one of the others
    case Role::Viewer:
      return "viewer";
    case Role::Deployer:
      return "deployer";
    case Role::Tool:
      return "tool";
  }
  return "";
}

Authority read_authority(const fs::path& folder) {
  return {read_text(folder / kAuthority), read_text(folder / kAuthorityKey)};
}

// Who has the smaller number begins to shake hands, and Cyclone DDS, so a board, does not understand what Fast DDS 2.9
// begins with. So tools get a unit that makes their number greater than nearly every board's, always the same.
Identity identity_of(const Holder& holder) {
  constexpr int kMostTries = 1'000'000;
  constexpr const char* kHigh = "fff";  // one in 4096
  Identity identity{holder.plant, unit_of(holder.role), holder.name};
  for (int i = 0; holder.role == Role::Tool && i < kMostTries; ++i) {
    identity.unit = fmt::format("{} {}", unit_of(holder.role), i);
    if (subject_digest(identity).starts_with(kHigh)) {
      break;
    }
  }
  return identity;
}

// What `key` shows: its certificate, and permissions for exactly that name.
struct Papers {
  std::string certificate;
  std::string permissions;
};
Papers make_papers(const Authority& authority, const Holder& holder, const std::string& key, Instant until) {
  const Validity validity{valid_from(), until};
  Papers papers;
  papers.certificate = make_certificate(authority, key, identity_of(holder), validity);
  if (const auto facts = read_certificate(papers.certificate)) {
    papers.permissions = sign_document(authority, permissions_document(holder, facts->subject, validity));
  }
  return papers;
}

// All certificates ever issued: "SERIAL FOLDER". Without it a renewed board's old ones could not be revoked.
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

std::string folder_of(Role role, const std::string& name) {
  return role == Role::Board ? "boards/" + name : role == Role::Tool ? "tools/" + name : unit_of(role);
}

// One participant's folder, with copies of what all have.
Done make_participant(const fs::path& keys, const fs::path& folder, const Holder& holder, Instant until) {
  const Authority authority = read_authority(keys);
  const std::string key = make_key(KeyKind::P256);
  const Papers papers = make_papers(authority, holder, key, until);
  Done done =
      in_turn([&] { return make_folder(folder); }, [&] { return write_new(folder / kIdentityKey, key, kSecret); },
              [&] { return write_new(folder / kIdentity, papers.certificate, kPublic); },
              [&] { return write_new(folder / kPermissions, papers.permissions, kPublic); },
              [&] { return note_issued(keys, folder_of(holder.role, holder.name), papers.certificate); });
  if (done && holder.role == Role::Tool) {
    done = write_new(folder / kVariables, rights_text(holder.variables), kPublic);
  }
  for (const char* common : {kAuthority, kGovernance, kRevoked, kDeployPublic}) {
    if (done) {
      done = write_new(folder / common, read_text(keys / common), kPublic);
    }
  }
  return done;
}

Done make_top(const fs::path& folder, const std::string& plant, Instant until) {
  // The authority outlives what it issues.
  const Validity validity{valid_from(), until + std::chrono::days(3650)};
  Authority authority;
  authority.key = make_key(KeyKind::P256);
  authority.certificate = make_authority(authority.key, {plant, "", plant + " authority"}, validity);
  const std::string deploy = make_key(KeyKind::Ed25519);
  return in_turn(
      [&] { return make_folder(folder / "boards"); }, [&] { return make_folder(folder); },
      // Keys do not belong into version control.
      [&] { return write_new(folder / ".gitignore", "*\n", kPublic); },
      [&] { return write_new(folder / kAuthorityKey, authority.key, kSecret); },
      [&] { return write_new(folder / kAuthority, authority.certificate, kPublic); },
      [&] { return write_new(folder / kGovernance, sign_document(authority, governance_document()), kPublic); },
      [&] { return write_new(folder / kRevoked, make_revocation_list(authority, "", {}, validity), kPublic); },
      [&] { return write_new(folder / kDeployPublic, public_half(deploy), kPublic); },
      [&] { return make_folder(folder / "deployer"); },
      [&] { return write_new(folder / "deployer" / kDeployKey, deploy, kSecret); });
}

// Moves what was made aside to its place, or takes it away.
Done put_in_place(Done made, const fs::path& fresh, const fs::path& folder) {
  std::error_code error;
  if (made) {
    fs::rename(fresh, folder, error);  // fails if there is anything
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
  KeyListing listing{role, folder.filename().string(), folder, {}, false, {}, {}};
  const ParticipantKeys keys(folder);
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
  listing.problem = listing.revoked                      ? "revoked"
                    : !issued_by(certificate, authority) ? "issued by another authority"
                    : facts->common_name != listing.name ? "the certificate is that of " + facts->common_name
                    : check.fault == KeyFault::Outdated  ? check.problem + "; indurop keys renew " + listing.name
                                                         : check.problem;
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

}  // namespace

Done PlantKeys::make(const std::string& plant, const std::vector<std::string>& boards, Instant until) const {
  std::error_code error;
  if (fs::exists(folder_, error) && !fs::is_empty(folder_, error)) {
    return base::Problem{fmt::format("there is already something in {}; nothing was written", folder_.string())};
  }
  const fs::path target = fs::absolute(folder_, error).lexically_normal();
  const fs::path fresh = aside(target.has_filename() ? target : target.parent_path());
  const PlantKeys made(fresh);
  Done done = in_turn([&] { return make_top(fresh, plant, until); },
                      [&] {
                        return make_participant(fresh, made.viewer(), {Role::Viewer, plant, "viewer"}, until);
                      },
                      [&] {
                        return make_participant(fresh, made.deployer(), {Role::Deployer, plant, "deployer"}, until);
                      });
  for (const std::string& board : boards) {
    if (done) {
      done = make_participant(fresh, made.board(board), {Role::Board, plant, board}, until);
    }
  }
  return put_in_place(std::move(done), fresh, target);
}

Done PlantKeys::add(const Holder& holder, Instant until) const {
  const auto all = list(instant_now());
  const auto same =
      std::find_if(all.begin(), all.end(), [&](const KeyListing& each) { return each.name == holder.name; });
  if (same != all.end()) {
    return base::Problem{fmt::format("{} has keys already, in {}; a new certificate for them: indurop keys renew {}",
                                     holder.name, same->folder.string(), holder.name)};
  }
  const fs::path folder = folder_ / folder_of(holder.role, holder.name);
  const fs::path fresh = aside(folder);
  return put_in_place(in_turn([&] { return make_folder(folder.parent_path()); },
                              [&] { return make_participant(folder_, fresh, holder, until); }),
                      fresh, folder);
}

Done PlantKeys::add(const std::string& board, Instant until) const {
  return add({Role::Board, plant(), board}, until);
}

Done PlantKeys::add_tool(const std::string& name, const VariableRights& rights, Instant until) const {
  return add({Role::Tool, plant(), name, rights}, until);
}

Done PlantKeys::renew(const KeyListing& whose, Instant until) const {
  Holder holder{whose.role, plant(), whose.name};
  if (whose.role == Role::Tool) {
    auto rights = read_rights(whose.folder / kVariables);
    if (!rights) {
      return std::move(rights).error();
    }
    holder.variables = std::move(rights).value();
  }
  const Papers papers =
      make_papers(read_authority(folder_), holder, read_text(ParticipantKeys(whose.folder).key), until);
  if (papers.certificate.empty() || papers.permissions.empty()) {
    return crypto_failed();
  }
  return in_turn([&] { return note_issued(folder_, folder_of(whose.role, whose.name), papers.certificate); },
                 [&] { return replace(whose.folder / kIdentity, papers.certificate); },
                 [&] { return replace(whose.folder / kPermissions, papers.permissions); });
}

Done PlantKeys::revoke(const KeyListing& whose) const {
  const Authority authority = read_authority(folder_);
  const auto issuer = read_certificate(authority.certificate);
  if (!issuer) {
    return base::Problem{fmt::format("{} is not a certificate", (folder_ / kAuthority).string())};
  }
  const std::string list = make_revocation_list(authority, read_text(folder_ / kRevoked),
                                                issued_to(folder_, folder_of(whose.role, whose.name)),
                                                {valid_from(), issuer->validity.until});
  Done done = replace(folder_ / kRevoked, list);
  for (const KeyListing& each : this->list(instant_now())) {
    if (done) {
      done = replace(each.folder / kRevoked, list);
    }
  }
  return done;
}

bool PlantKeys::exist() const {
  std::error_code error;
  return fs::exists(folder_ / kAuthority, error);
}

std::string PlantKeys::plant() const {
  const auto facts = read_certificate(read_text(folder_ / kAuthority));
  return facts ? facts->organisation : std::string{};
}

std::vector<KeyListing> PlantKeys::list(Instant now) const {
  const std::string authority = read_text(folder_ / kAuthority);
  const std::string revoked = read_text(folder_ / kRevoked);
  std::vector<KeyListing> all = listings_in(Role::Board, folder_ / "boards", folder_, now);
  std::error_code error;
  for (const auto& [role, folder] : {std::pair(Role::Viewer, viewer()), std::pair(Role::Deployer, deployer())}) {
    if (fs::exists(folder, error)) {
      all.push_back(listing_of(role, folder, authority, revoked, now));
    }
  }
  std::vector<KeyListing> tools = listings_in(Role::Tool, folder_ / "tools", folder_, now);
  std::move(tools.begin(), tools.end(), std::back_inserter(all));
  return all;
}

}  // namespace indurop::keys
