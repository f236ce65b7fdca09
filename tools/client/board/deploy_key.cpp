// SPDX-License-Identifier: Apache-2.0
#include "tools/client/board/deploy_key.h"

#include <fmt/format.h>

#include "core/base/read_file.h"
#include "core/keys/credentials.h"
#include "core/keys/plant_keys.h"

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

}  // namespace indurop::tools
