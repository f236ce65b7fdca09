// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/client_certificates.h"

#include <fmt/format.h>

#include <cerrno>
#include <utility>

#include "core/base/file_problem.h"
#include "core/base/read_file.h"
#include "core/keys/credentials.h"
#include "core/keys/participant_keys.h"
#include "core/keys/plant_keys.h"
#include "core/keys/revocation.h"

namespace indurop::serve {

Result<ClientCertificates, base::Problem> ClientCertificates::open(const std::filesystem::path& authority,
                                                                   const std::filesystem::path& revoked) {
  const auto text = base::read_file(authority);
  if (!text) {
    return base::Problem{base::cannot_read(authority.string(), text.error())};
  }
  ClientCertificates made;
  made.authority_ = *text;
  const auto facts = keys::read_certificate(made.authority_);
  if (!facts) {
    return base::Problem{fmt::format("{} is not a certificate", authority.string())};
  }
  made.revoked_ = revoked.empty() ? authority.parent_path() / "revoked.pem" : revoked;
  made.needs_list_ = !revoked.empty() || keys::is_plant_authority(*facts);
  if (const auto list = made.read_list(); !list) {
    return base::Problem{list.error().text + "; copy the revoked.pem of the plant's keys into the folder of " +
                         authority.string() + ", or name it with --revoked"};
  }
  return made;
}

Result<std::string, base::Problem> ClientCertificates::read_list() const {
  auto text = base::read_file(revoked_);
  if (!text && text.error().sys_errno == ENOENT && !needs_list_) {
    return std::string();
  }
  needs_list_ = true;
  if (!text) {
    return base::Problem{base::cannot_read(revoked_.string(), text.error())};
  }
  if (!keys::revocation_list_of(*text, authority_)) {
    return base::Problem{fmt::format("{} is not a list of revoked certificates of this authority", revoked_.string())};
  }
  return std::move(*text);
}

ClientCertificates::Holder ClientCertificates::holder_of(const std::string& certificate) {
  const auto facts = keys::read_certificate(certificate);
  if (facts && !keys::is_plant_certificate(*facts)) {
    return Holder::Stranger;
  }
  const auto role = facts ? keys::plant_role(*facts) : std::nullopt;
  const bool person = role == keys::Role::Deployer || role == keys::Role::Viewer || role == keys::Role::User;
  return person ? Holder::Person : Holder::Participant;
}

Client ClientCertificates::identify(const std::string& certificate) const {
  const auto facts = keys::read_certificate(certificate);
  if (authority_.empty() || !facts || facts->common_name.empty()) {
    return {{}, Role::Unknown, "the certificate names no user", {}, {}};
  }
  const auto refused = [&facts](std::string why) {
    return Client{facts->common_name, Role::Unknown, std::move(why), {}, {}};
  };
  // TLS checks this when the connection begins, which may be long ago.
  const keys::Instant now = keys::instant_now();
  if (now < facts->validity.from || now > facts->validity.until) {
    return refused(fmt::format("the certificate of {} is not valid at this time", facts->common_name));
  }
  const auto list = read_list();
  if (!list) {
    return refused("which certificates were revoked cannot be read, so none counts");
  }
  if (!list->empty() && keys::is_revoked(certificate, *list)) {
    return refused(fmt::format("the certificate of {} was revoked", facts->common_name));
  }
  if (!list->empty() && !keys::issued_by(certificate, authority_)) {
    return refused(
        fmt::format("the certificate of {} is below another authority, whose list of revoked certificates is "
                    "not known",
                    facts->common_name));
  }
  // Certificates of other authorities define no role: their clients have the rights of one with a token.
  const auto role = keys::plant_role(*facts);
  const bool writes = !keys::is_plant_certificate(*facts) || role == keys::Role::Deployer;
  return {facts->common_name, writes ? Role::Program : Role::Look, {}, {}, {}};
}

}  // namespace indurop::serve
