// SPDX-License-Identifier: Apache-2.0
#include "core/keys/plant_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <iterator>

#include "core/base/read_file.h"
#include "core/keys/deploy_list.h"
#include "core/keys/plant_parts.h"
#include "core/keys/revocation.h"
#include "core/keys/trust_list.h"

namespace indurop::keys {

namespace fs = std::filesystem;

Done PlantKeys::make(const std::string& plant, const std::vector<std::string>& boards, Instant until) const {
  std::error_code error;
  const auto reserved = std::find_if(boards.begin(), boards.end(), &reserved_name);
  if (reserved != boards.end()) {
    return not_for(Role::Board, *reserved);
  }
  if (fs::exists(folder_, error) && !fs::is_empty(folder_, error)) {
    return base::Problem{fmt::format("{} is not empty; nothing was written", folder_.string())};
  }
  const fs::path target = fs::absolute(folder_, error).lexically_normal();
  const fs::path fresh = aside(target.has_filename() ? target : target.parent_path());
  const PlantKeys made(fresh);
  // The deployer first: it adds its key to the shared files.
  Done done = in_turn([&] { return make_top(fresh, plant, until); },
                      [&] {
                        return make_participant(fresh, made.deployer(), {Role::Deployer, plant, "deployer"}, until);
                      },
                      [&] { return replace(fresh / kDeployPublic, read_text(made.deployer() / kDeployPublic)); },
                      [&] {
                        return make_participant(fresh, made.viewer(), {Role::Viewer, plant, "viewer"}, until);
                      });
  for (const std::string& board : boards) {
    if (done) {
      done = make_participant(fresh, made.board(board), {Role::Board, plant, board}, until);
    }
  }
  done = done ? made.share_trust() : done;
  return put_in_place(std::move(done), fresh, target);
}

Done PlantKeys::add(const Holder& holder, Instant until) const {
  const bool first = (holder.role == Role::Viewer || holder.role == Role::Deployer) &&
                     holder.name == unit_of(holder.role);  // of those that init makes
  if (reserved_name(holder.name) && !first) {
    return not_for(holder.role, holder.name);
  }
  const auto all = list(instant_now());
  const auto same =
      std::find_if(all.begin(), all.end(), [&](const KeyListing& each) { return each.name == holder.name; });
  if (same != all.end()) {
    if (same->revoked) {
      return base::Problem{
          fmt::format("{} was revoked, and its keys are still in {}; choose another name, or move them away",
                      holder.name, same->folder.string())};
    }
    return base::Problem{fmt::format("{} has keys already, in {}; a new certificate for them: indurop keys renew {}",
                                     holder.name, same->folder.string(), holder.name)};
  }
  const Done able = in_turn([&] { return can_issue(folder_); }, [&] { return restore_revoked(); });
  if (!able) {
    return able;
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

Done PlantKeys::add_viewer(const std::string& name, Instant until) const {
  return add({Role::Viewer, plant(), name}, until);
}

Done PlantKeys::add_deployer(const std::string& name, Instant until) const {
  Done done = add({Role::Deployer, plant(), name}, until);
  return done ? share_deploy_keys(read_text(deployer(name) / kDeployPublic)) : done;
}

Done PlantKeys::add_user(const std::string& name, Instant until) const {
  return add({Role::User, plant(), name}, until);
}

Done PlantKeys::rotate(const KeyListing& deployer) const {
  if (Done able = can_issue(folder_); !able) {
    return able;
  }
  const fs::path key = deployer.folder / kDeployKey;
  const fs::path before = deployer.folder / kDeployKeyBefore;
  const fs::path next = deployer.folder / kDeployKeyNext;
  const bool begun = !read_text(next).empty();
  if (is_valid(before) && !begun) {
    return base::Problem{
        fmt::format("{} already has a new key, and the old one is still valid: when all boards know the new one "
                    "(indurop keys send), "
                    "indurop keys rotate --finish",
                    deployer.name)};
  }
  // A kill between two steps leaves valid keys, and the command can be repeated.
  return in_turn(
      [&] { return begun ? Done{} : write_new(next, make_key(KeyKind::Ed25519), kSecret); },
      [&] {
        return is_valid(next) ? Done{} : share(kDeployPublic, with_deploy_key(folder_, deployer.name, read_text(next)));
      },
      [&] { return read_text(key).empty() ? Done{} : move(key, before); }, [&] { return move(next, key); },
      [&] { return share_trust(); });
}

bool PlantKeys::is_valid(const fs::path& deploy_key) const {
  const std::string half = public_half(read_text(deploy_key));
  const std::vector<DeployKey> list = read_deploy_list(read_text(folder_ / kDeployPublic));
  return !half.empty() &&
         std::any_of(list.begin(), list.end(), [&](const DeployKey& each) { return each.pem == half; });
}

Result<std::size_t, base::Problem> PlantKeys::finish_rotation() const {
  std::vector<DeployKey> list = read_deploy_list(read_text(folder_ / kDeployPublic));
  const std::size_t ended = std::erase_if(list, [](const DeployKey& key) { return key.former; });
  const Done done = ended == 0 ? Done{}
                               : in_turn([&] { return can_issue(folder_); },
                                         [&] { return share_deploy_keys(deploy_list_text(list)); });
  if (!done) {
    return done.error();
  }
  std::error_code error;
  for (const KeyListing& each : this->list(instant_now())) {
    if (const fs::path before = each.folder / kDeployKeyBefore; !is_valid(before)) {
      fs::remove(before, error);
    }
  }
  return ended;
}

Done PlantKeys::share_deploy_keys(const std::string& list) const {
  return in_turn([&] { return share(kDeployPublic, list); }, [&] { return share_trust(); });
}

Done PlantKeys::restore_revoked() const {
  const std::string authority = read_text(folder_ / kAuthority);
  const std::string revoked = read_text(folder_ / kRevoked);
  const bool valid = revocation_list_of(revoked, authority);
  const auto list = read_trust_list(read_text(folder_ / kTrust), authority);
  if (valid && (!list || revokes_all_of(revoked, list->revoked))) {
    return {};
  }
  if (list && (!valid || revokes_all_of(list->revoked, revoked))) {
    return share(kRevoked, list->revoked);
  }
  return base::Problem{fmt::format("{} is {}; take it from the folder of a participant, or from a backup",
                                   (folder_ / kRevoked).string(),
                                   valid ? "another list of revoked certificates than that in trust.p7s"
                                         : "no list of revoked certificates of this authority")};
}

// Keys of revoked deployers come back with a deploy.pub from a backup.
Done PlantKeys::check_deploy_keys() const {
  std::vector<DeployKey> keys = read_deploy_list(read_text(folder_ / kDeployPublic));
  std::size_t ended = 0;
  for (const KeyListing& each : list(instant_now())) {
    const bool deploys = each.role == Role::Deployer;
    if (deploys && each.revoked) {
      ended += std::erase_if(keys, [&](const DeployKey& key) { return key.deployer == each.name; });
    } else if (deploys && !read_text(each.folder / kDeployKey).empty() && !is_valid(each.folder / kDeployKey)) {
      return base::Problem{
          fmt::format("{} lacks the key of {}; take it from the folder of a participant, or from a "
                      "backup",
                      (folder_ / kDeployPublic).string(), each.name)};
    }
  }
  return ended == 0 ? Done{} : share(kDeployPublic, deploy_list_text(keys));
}

Done PlantKeys::share_trust() const {
  const Done usable = in_turn([&] { return restore_revoked(); }, [&] { return check_deploy_keys(); });
  if (!usable) {
    return usable;
  }
  const Authority authority = read_authority(folder_);
  const auto before = read_trust_list(read_text(folder_ / kTrust), authority.certificate);
  const auto now = static_cast<std::uint64_t>(std::max<std::int64_t>(instant_now().time_since_epoch().count(), 1));
  return share(kTrust, signed_trust_list({plant(), std::max(now, before ? before->serial + 1 : 0),
                                          read_text(folder_ / kRevoked), read_text(folder_ / kDeployPublic)},
                                         authority));
}

Result<std::string, base::Problem> PlantKeys::trust_list() const {
  const std::string authority = read_text(folder_ / kAuthority);
  const auto list = read_trust_list(read_text(folder_ / kTrust), authority);
  // The files may be those of an earlier release, or of a change that was interrupted.
  if (!list || list->revoked != read_text(folder_ / kRevoked) ||
      list->deploy_keys != read_text(folder_ / kDeployPublic)) {
    const Done done = in_turn([&] { return can_issue(folder_); }, [&] { return share_trust(); });
    if (!done) {
      return done.error();
    }
  }
  return read_text(folder_ / kTrust);
}

Done PlantKeys::share(const char* file, const std::string& text) const {
  Done done = replace(folder_ / file, text);
  for (const KeyListing& each : list(instant_now())) {
    if (done) {
      done = replace(each.folder / file, text);
    }
  }
  return done;
}

Done PlantKeys::add_tool(const std::string& name, const VariableRights& rights, Instant until) const {
  return add({Role::Tool, plant(), name, rights}, until);
}

Done PlantKeys::renew(const KeyListing& whose, Instant until) const {
  const fs::path own = ParticipantKeys(whose.folder).key;
  const auto key = base::read_file(own);
  if (!key) {
    return base::Problem{base::cannot_read(own, key.error())};
  }
  if (Done able = can_issue(folder_); !able) {
    return able;
  }
  Holder holder{whose.role, plant(), whose.name};
  if (whose.role == Role::Tool) {
    auto rights = read_rights(whose.folder / kVariables);
    if (!rights) {
      return std::move(rights).error();
    }
    holder.variables = std::move(rights).value();
  }
  const Credentials credentials = issue_credentials(read_authority(folder_), holder, *key, until);
  if (credentials.certificate.empty() || credentials.permissions.empty()) {
    return crypto_failed();
  }
  return in_turn([&] { return note_issued(folder_, folder_of(whose.role, whose.name), credentials.certificate); },
                 [&] { return replace(whose.folder / kIdentity, credentials.certificate); },
                 [&] { return replace(whose.folder / kPermissions, credentials.permissions); });
}

Done PlantKeys::revoke(const KeyListing& whose) const {
  const Done able = in_turn([&] { return can_issue(folder_); }, [&] { return restore_revoked(); });
  if (!able) {
    return able;
  }
  const Authority authority = read_authority(folder_);
  const auto issuer = read_certificate(authority.certificate);
  if (!issuer) {
    return base::Problem{fmt::format("{} is not a certificate", (folder_ / kAuthority).string())};
  }
  const std::string list = make_revocation_list(authority, read_text(folder_ / kRevoked),
                                                issued_to(folder_, folder_of(whose.role, whose.name)),
                                                {valid_from(), issuer->validity.until});
  Done done = share(kRevoked, list);
  std::vector<DeployKey> keys = read_deploy_list(read_text(folder_ / kDeployPublic));
  const bool signs = whose.role == Role::Deployer;
  if (done && signs && std::erase_if(keys, [&](const DeployKey& key) { return key.deployer == whose.name; }) > 0) {
    done = share(kDeployPublic, deploy_list_text(keys));
  }
  return done ? share_trust() : done;
}

fs::path PlantKeys::viewer(const std::string& name) const {
  return folder_ / folder_of(Role::Viewer, name);
}

fs::path PlantKeys::deployer(const std::string& name) const {
  return folder_ / folder_of(Role::Deployer, name);
}

fs::path PlantKeys::authority_key() const {
  return folder_ / kAuthorityKey;
}

bool PlantKeys::exist() const {
  std::error_code error;
  return fs::exists(folder_ / kAuthority, error);
}

std::string PlantKeys::unreadable() const {
  for (const char* name : {kAuthority, kGovernance, kRevoked, kTrust, kIssued, kDeployPublic}) {
    const auto text = base::read_file(folder_ / name);
    if (!text && text.error().sys_errno != ENOENT) {
      return base::cannot_read(folder_ / name, text.error());
    }
  }
  return {};
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
    std::vector<KeyListing> further = listings_in(role, folder.string() + "s", folder_, now);
    std::move(further.begin(), further.end(), std::back_inserter(all));
  }
  for (const auto& [role, folder] :
       {std::pair(Role::Tool, folder_ / "tools"), std::pair(Role::User, folder_ / "users")}) {
    std::vector<KeyListing> further = listings_in(role, folder, folder_, now);
    std::move(further.begin(), further.end(), std::back_inserter(all));
  }
  return all;
}

}  // namespace indurop::keys
