// SPDX-License-Identifier: Apache-2.0
#include "tools/client/board/deploy_key.h"

#include <fmt/format.h>

#include <utility>

#include "core/base/read_file.h"
#include "core/keys/credentials.h"
#include "core/keys/participant_keys.h"
#include "core/keys/plant_keys.h"
#include "deploy/words/command_words.h"

namespace indurop::tools {

Result<std::string, base::Problem> read_deploy_key(Messages& messages, const std::filesystem::path& folder) {
  if (folder.empty()) {
    messages.note("open: no keys. Anybody on this network may deploy to these boards");
    return std::string{};
  }
  std::error_code ignored;
  const std::filesystem::path own = folder / "deploy.key";  // in the deployer's folder
  const std::filesystem::path file =
      std::filesystem::exists(own, ignored) ? own : keys::PlantKeys(folder).deployer() / "deploy.key";
  const auto text = base::read_file(file);
  const std::string key = text ? *text : std::string{};
  if (!key.empty() && !keys::signature_of("probe", key).empty()) {
    if (const std::string exposed = keys::exposed_key(file); !exposed.empty()) {
      messages.note("warning: " + exposed);
    }
    return key;
  }
  return base::Problem{
      fmt::format("{} is missing or is not a key, so the deployment cannot be signed; indurop "
                  "keys init makes it; --keys says where it is",
                  file.string())};
}

Result<CommandKey, base::Problem> read_command_key(Messages& messages, const std::filesystem::path& folder) {
  const keys::ParticipantKeys own(folder);
  const auto certificate = base::read_file(own.certificate);
  const auto facts = keys::read_certificate(certificate ? *certificate : std::string());
  if (facts && keys::plant_role(*facts) == keys::Role::User) {
    auto key = base::read_file(own.key);
    return key ? Result<CommandKey, base::Problem>(CommandKey{std::move(*key), *certificate})
               : base::Problem{base::cannot_read(own.key, key.error())};
  }
  auto key = read_deploy_key(messages, folder);
  return key ? Result<CommandKey, base::Problem>(CommandKey{std::move(key).value(), {}}) : key.error();
}

std::string command_signature(const CommandKey& key, const std::string& text) {
  if (key.key.empty()) {
    return {};
  }
  std::string signature = keys::signature_of(text, key.key);
  return key.certificate.empty() ? signature : deploy::user_signature_text({std::move(signature), key.certificate});
}

}  // namespace indurop::tools
