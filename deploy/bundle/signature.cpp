// SPDX-License-Identifier: Apache-2.0
// Who packed a bundle.
#include <fmt/format.h>

#include <optional>
#include <utility>

#include "core/base/read_file.h"
#include "core/keys/participant_keys.h"
#include "core/keys/plant_keys.h"
#include "core/keys/revocation.h"
#include "deploy/bundle/bundle.h"

namespace indurop::deploy {

using base::Problem;

Result<BundleSignature, Problem> sign_package(const std::string& package_text, const std::filesystem::path& folder) {
  auto keys = keys::resolve_keys(folder, keys::Role::Deployer);
  if (!keys) {
    return std::move(keys).error();
  }
  const auto certificate = base::read_file(keys->certificate);
  const auto key = base::read_file(keys->key);
  BundleSignature made;
  if (certificate && key) {
    made = {*certificate, keys::signature_of(package_text, *key)};
  }
  if (made.signature.empty()) {
    return Problem{fmt::format("the keys in {} cannot sign; indurop keys check says what is wrong with them",
                               keys->folder.string())};
  }
  return made;
}

std::string bundle_refusal(const BundleSignature& signature, const std::string& package_text,
                           const std::string& authority, const std::string& revoked) {
  if (signature.certificate.empty()) {
    return "the bundle is not signed; pack it with --keys";
  }
  const auto facts = keys::read_certificate(signature.certificate);
  if (!facts || !keys::signature_holds(package_text, signature.signature, keys::public_key_in(signature.certificate))) {
    return "the signature of the bundle does not fit its content: it was changed after it was packed";
  }
  if (!keys::issued_by(signature.certificate, authority)) {
    return fmt::format("the bundle was signed by {} of plant {}, with keys of another authority", facts->common_name,
                       facts->organisation);
  }
  if (keys::plant_role(*facts) != keys::Role::Deployer) {
    return fmt::format("the bundle was signed by {}, who is not a deployer", facts->common_name);
  }
  return keys::is_revoked(signature.certificate, revoked)
             ? fmt::format("the bundle was signed by {}, whose keys are revoked", facts->common_name)
             : "";
}

}  // namespace indurop::deploy
