// SPDX-License-Identifier: Apache-2.0
#include "node/modules/kept_versions.h"

#include <fmt/format.h>

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

// Returns false if it is there already, and is now one that was kept last.
bool is_missing(const fs::path& file, const std::string& digest) {
  std::error_code error;
  if (!fs::exists(file, error) || !has_digest(file, digest)) {
    return true;
  }
  fs::last_write_time(file, fs::file_time_type::clock::now(), error);
  return false;
}

}  // namespace

Result<void, base::Problem> keep_version(const std::string& node, const ModuleLibrary& version) {
  const fs::path folder = kept_folder(node);
  const fs::path file = folder / (version.digest() + ".so");
  if (!is_missing(file, version.digest())) {
    return {};
  }
  const auto content = version.content();
  if (!content) {
    return content.error();
  }
  std::error_code error;
  fs::create_directories(folder, error);
  if (const auto written = base::replace_file(file, *content, base::Durable::No); !written) {
    return base::Problem{base::cannot_write(file, written.error())};
  }
  remove_oldest_versions(folder);
  return {};
}

Result<void, base::Problem> keep_program(const std::string& node, const fs::path& program) {
  const auto digest = keys::digest_of_file(program);
  if (!digest) {
    return base::Problem{fmt::format("{} cannot be read", program.string())};
  }
  const fs::path folder = kept_folder(node);
  const fs::path file = folder / (digest->digest + ".exe");
  if (!is_missing(file, digest->digest)) {
    return {};
  }
  std::error_code error;
  fs::create_directories(folder, error);
  const fs::path copied = folder / (digest->digest + ".new");
  fs::copy_file(program, copied, fs::copy_options::overwrite_existing, error);
  if (!error) {
    fs::permissions(copied, fs::perms::owner_all, error);
  }
  if (!error) {
    fs::rename(copied, file, error);
  }
  if (error) {
    return base::Problem{fmt::format("{} cannot be written: {}", file.string(), error.message())};
  }
  remove_oldest_versions(folder);
  return {};
}

std::optional<fs::path> find_version_file(const std::string& node, const std::string& digest,
                                          const std::vector<fs::path>& likely, const fs::path& near) {
  std::vector<fs::path> candidates = likely;
  candidates.push_back(kept_folder(node) / (digest + ".so"));
  candidates.push_back(kept_folder(node) / (digest + ".exe"));
  candidates.push_back(vars::state_directory(node) / "files" / digest);  // deploy/disk/deployment_files.h
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(near.empty() ? "." : near, ignored)) {
    if (entry.path().extension() == ".so" || entry.path().extension() == ".exe") {
      candidates.push_back(entry.path());
    }
  }
  const auto found = std::find_if(candidates.begin(), candidates.end(),
                                  [&digest](const fs::path& file) { return has_digest(file, digest); });
  return found == candidates.end() ? std::nullopt : std::optional(fs::absolute(*found));
}

}  // namespace indurop::node
