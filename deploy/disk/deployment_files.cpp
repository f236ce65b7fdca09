// SPDX-License-Identifier: Apache-2.0
#include "deploy/disk/deployment_files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/read_file.h"
#include "core/keys/digest.h"
#include "deploy/words/deployment_words.h"

namespace indurop::deploy {
namespace {

namespace fs = std::filesystem;
using base::Problem;

constexpr std::size_t kFolderDigits = 16;

std::optional<Damage> compare(const fs::path& file, const std::string& name, const std::string& expected) {
  const auto found = keys::digest_of_file(file);
  if (found && found->digest == expected) {
    return std::nullopt;
  }
  return Damage{file, name, expected, found ? found->digest : std::string{}};
}

}  // namespace

std::string describe(const Damage& damage) {
  if (damage.expected.empty()) {
    return fmt::format("{} is damaged: {}", damage.file.string(), damage.name);
  }
  return damage.found.empty() ? fmt::format("{}: {} cannot be read, it should have the SHA-256 {}", damage.name,
                                            damage.file.string(), damage.expected)
                              : fmt::format("{}: {} has the SHA-256 {}, it should be {}", damage.name,
                                            damage.file.string(), damage.found, damage.expected);
}

fs::path DeploymentFiles::deployment(const std::string& id) const {
  return folder_ / "deployments" / id.substr(0, kFolderDigits);
}

bool DeploymentFiles::has(const std::string& digest) const {
  std::error_code error;
  return keys::is_digest(digest) && fs::is_regular_file(file(digest), error);
}

Result<Package, Problem> DeploymentFiles::package(const std::string& id) const {
  if (!has(id)) {
    return Problem{fmt::format("deployment {} is not on this board any more", shown_id(id))};
  }
  const auto text = base::read_file(file(id));
  const std::string found = text ? keys::digest_of(*text) : std::string{};
  if (found != id) {
    return Problem{describe({file(id), fmt::format("the package of deployment {}", shown_id(id)), id, found})};
  }
  return read_package(*text);
}

std::optional<Damage> DeploymentFiles::damage_of(const std::string& digest, const std::string& name) const {
  return compare(file(digest), name, digest);
}

std::optional<Damage> DeploymentFiles::damage_in(const std::string& id, const PackageFile& entry) const {
  return compare(deployment(id) / entry.path, entry.path, entry.digest);
}

std::optional<Damage> DeploymentFiles::damage_in(const std::string& id, const Package& package) const {
  for (const PackageFile& entry : package.files) {
    if (auto damage = damage_in(id, entry)) {
      return damage;
    }
  }
  return std::nullopt;
}

}  // namespace indurop::deploy
