// SPDX-License-Identifier: Apache-2.0
#include "node/modules/kept_versions.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "core/base/replace_file.h"
#include "core/keys/digest.h"
#include "store/vars/retain.h"

namespace indurop::node {
namespace {

namespace fs = std::filesystem;

fs::path kept_folder(const std::string& node) {
  return vars::state_directory(node) / "versions";
}

bool has_digest(const fs::path& file, const std::string& digest) {
  const auto found = keys::digest_of_file(file);
  return found && found->digest == digest;
}

void remove_oldest_versions(const fs::path& folder) {
  std::error_code ignored;
  std::vector<std::pair<fs::file_time_type, fs::path>> kept;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    kept.emplace_back(entry.last_write_time(ignored), entry.path());
  }
  std::sort(kept.begin(), kept.end());
  for (std::size_t i = 0; i + kMostKeptVersions < kept.size(); ++i) {
    fs::remove(kept[i].second, ignored);
  }
}

}  // namespace

Result<void, base::Problem> keep_version(const std::string& node, const ModuleLibrary& version) {
  const fs::path folder = kept_folder(node);
  const fs::path file = folder / (version.digest() + ".so");
  std::error_code error;
  if (fs::exists(file, error) && has_digest(file, version.digest())) {
    fs::last_write_time(file, fs::file_time_type::clock::now(), error);
    return {};
  }
  const auto content = version.content();
  if (!content) {
    return content.error();
  }
  fs::create_directories(folder, error);
  if (const auto written = base::replace_file(file, *content, base::Durable::No); !written) {
    return base::Problem{base::cannot_write(file, written.error())};
  }
  remove_oldest_versions(folder);
  return {};
}

std::optional<fs::path> find_version_file(const std::string& node, const std::string& digest,
                                          const std::vector<fs::path>& likely, const fs::path& near) {
  std::vector<fs::path> candidates = likely;
  candidates.push_back(kept_folder(node) / (digest + ".so"));
  candidates.push_back(vars::state_directory(node) / "files" / digest);  // deploy/disk/deployment_files.h
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(near.empty() ? "." : near, ignored)) {
    if (entry.path().extension() == ".so") {
      candidates.push_back(entry.path());
    }
  }
  const auto found = std::find_if(candidates.begin(), candidates.end(),
                                  [&digest](const fs::path& file) { return has_digest(file, digest); });
  return found == candidates.end() ? std::nullopt : std::optional(fs::absolute(*found));
}

}  // namespace indurop::node
