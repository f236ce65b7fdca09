// SPDX-License-Identifier: Apache-2.0
#include "deploy/disk/state_check.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <map>

#include "core/base/read_file.h"
#include "deploy/disk/committed_file.h"
#include "deploy/words/deployment_words.h"

namespace indurop::deploy {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kStep = std::size_t{4} << 20U;

}  // namespace

base::Json json_of(const StateReport& report) {
  base::Json damaged = base::Json::array();
  for (const Damage& one : report.damaged) {
    damaged.push_back(
        {{"file", one.file.string()}, {"name", one.name}, {"sha256", one.expected}, {"found", one.found}});
  }
  return {{"files", report.files},
          {"bytes", report.bytes},
          {"deployments", report.deployments},
          {"releases", report.releases},
          {"damaged", std::move(damaged)}};
}

// What one of the two parts of the folder keeps.
struct StateCheck::Kept {
  DeploymentFiles files;
  std::size_t most = 0;
  const char* kind = "";
  std::vector<std::string>& ids;
};

StateCheck::StateCheck(const fs::path& folder) {
  plan({DeploymentFiles(folder), kDeploymentsKept, "deployment", report_.deployments});
  std::error_code error;
  if (const fs::path platform = platform_folder(folder); fs::is_directory(platform, error)) {
    plan({DeploymentFiles(platform), kReleasesKept, "release", report_.releases});
  }
}

void StateCheck::plan(const Kept& kept) {
  const DeploymentFiles& files = kept.files;
  const fs::path committed_file = files.folder() / kCommittedFile;
  Committed committed;
  if (const auto text = base::read_file(committed_file); text || text.error().sys_errno != ENOENT) {
    ++report_.files;
    report_.bytes += text ? text->size() : 0;
    auto read = text ? read_committed(*text) : base::Problem{text.error().text};
    if (read) {
      committed = std::move(*read);
    } else {
      report_.damaged.push_back({committed_file, read.error().text, {}, {}});
    }
  }
  std::map<std::string, std::string> names;  // names of files in files/, by digest
  for (const std::string& id : kept_deployments(committed, kept.most)) {
    if (id == kInstalledRelease) {
      continue;  // its files belong to the installation of the machine
    }
    const bool needed = id == committed.current || id == committed.previous;
    if (!needed && !files.has(id)) {
      continue;  // this board was absent then
    }
    kept.ids.push_back(id);
    names.emplace(id, fmt::format("the package of {} {}", kept.kind, shown_id(id)));
    plan_folder(files, id);
    if (const auto package = files.package(id)) {
      for (const PackageFile& entry : package->files) {
        names.emplace(entry.digest, entry.path);
      }
    }
  }
  std::error_code error;
  for (fs::directory_iterator at(files.folder() / "files", error), end; at != end; at.increment(error)) {
    if (const std::string digest = at->path().filename(); keys::is_digest(digest)) {
      names.emplace(digest, fmt::format("a file of a {} before", kept.kind));
    }
  }
  for (const auto& [digest, name] : names) {
    wanted_.push_back({files.file(digest), name, digest, {}});
  }
}

void StateCheck::plan_folder(const DeploymentFiles& files, const std::string& id) {
  const auto package = files.package(id);
  std::error_code error;
  if (!package || !fs::is_directory(files.deployment(id), error)) {
    return;  // a damaged package is reported for files/; a missing folder is created before it is run
  }
  for (const PackageFile& entry : package->files) {
    wanted_.push_back({files.deployment(id) / entry.path, entry.path, entry.digest, {}});
  }
}

void StateCheck::begin_next() {
  auto opened = base::open_file(wanted_.front().file);
  if (!opened) {
    note({});
    return;
  }
  open_ = std::move(opened->file);
  digest_.emplace();
  ++report_.files;
}

void StateCheck::note(std::string found) {
  Damage& one = wanted_.front();
  one.found = std::move(found);
  if (one.found != one.expected) {
    report_.damaged.push_back(std::move(one));
  }
  wanted_.pop_front();
  open_ = {};
  digest_.reset();
}

bool StateCheck::step() {
  std::vector<std::uint8_t> block(std::size_t{256} << 10U);
  for (std::size_t done = 0; done < kStep && !wanted_.empty();) {
    if (!digest_) {
      begin_next();
      continue;
    }
    const ssize_t got = ::read(open_.get(), block.data(), block.size());
    if (got > 0) {
      digest_->add({block.data(), static_cast<std::size_t>(got)});
      done += static_cast<std::size_t>(got);
      report_.bytes += static_cast<std::uint64_t>(got);
    } else if (got == 0 || errno != EINTR) {
      note(got == 0 ? digest_->finish() : std::string{});
    }
  }
  return wanted_.empty();
}

}  // namespace indurop::deploy
