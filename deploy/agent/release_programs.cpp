// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/release_programs.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string_view>
#include <utility>

#include "core/base/descriptor.h"
#include "core/base/spawn.h"
#include "core/rt/clock.h"
#include "deploy/agent/platform_launcher.h"
#include "deploy/transaction/release_package.h"
#include "deploy/words/deployment_words.h"

namespace indurop::deploy {
namespace {

namespace fs = std::filesystem;
using base::Problem;

constexpr const char* kLibraryPath = "LD_LIBRARY_PATH";
constexpr std::chrono::seconds kVersionPatience{10};
constexpr std::chrono::milliseconds kVersionPoll{10};

// Returns the folders of LD_LIBRARY_PATH that are not of a release in `platform`.
std::vector<std::string> without_releases(std::string_view folders, const std::string& platform) {
  std::vector<std::string> kept;
  while (!folders.empty()) {
    const std::size_t end = std::min(folders.find(':'), folders.size());
    const std::string_view folder = folders.substr(0, end);
    if (!folder.empty() && !folder.starts_with(platform)) {
      kept.emplace_back(folder);
    }
    folders.remove_prefix(std::min(end + 1, folders.size()));
  }
  return kept;
}

std::string first_line_of(int file) {
  std::array<char, 400> text{};
  const ssize_t got = ::pread(file, text.data(), text.size(), 0);
  const std::string_view all(text.data(), got > 0 ? static_cast<std::size_t>(got) : 0);
  return std::string(all.substr(0, all.find('\n')));
}

// Returns the status of the process, or nothing if it does not end in time; it is killed then.
std::optional<int> status_of(pid_t pid) {
  const rt::MonoTime deadline = rt::MonoClock::now() + kVersionPatience;
  int status = 0;
  while (::waitpid(pid, &status, WNOHANG) == 0) {
    if (rt::MonoClock::now() > deadline) {
      ::kill(pid, SIGKILL);
      (void)::waitpid(pid, &status, 0);
      return std::nullopt;
    }
    rt::sleep_until(rt::MonoClock::now() + kVersionPoll);
  }
  return status;
}

// Runs a program for its version. Returns why that failed; empty if it did not.
std::string what_prevents(const fs::path& program, const std::vector<std::string>& environment) {
  const base::Descriptor output(::memfd_create("indurop-release", MFD_CLOEXEC));
  const auto pid = base::spawn({.words = {program.string(), "--version"},
                                .program = program,
                                .environment = environment,
                                .output = output.get(),
                                .fresh_signals = true});
  if (!pid) {
    return fmt::format("{}: {}", program.string(), std::strerror(pid.error().sys_errno));
  }
  const auto status = status_of(*pid);
  if (!status) {
    return fmt::format("{} --version does not end", program.filename().string());
  }
  return base::exit_code_of(*status) == 0 ? std::string() : first_line_of(output.get());
}

}  // namespace

Result<ReleasePrograms, Problem> sound_release(const DeploymentFiles& files, const std::string& id) {
  const auto package = files.package(id);
  if (!package) {
    return package.error();
  }
  const std::string architecture = own_architecture();
  const std::vector<std::string> offered = architectures_of(*package);
  if (package->release.empty() || std::find(offered.begin(), offered.end(), architecture) == offered.end()) {
    return Problem{package->release.empty() ? std::string("it is a plant, not a release of the platform")
                                            : fmt::format("release {} has programs for {}, and this board is {}",
                                                          package->release, fmt::join(offered, " and "), architecture)};
  }
  ReleasePrograms out{package->release, files.deployment(id) / architecture / "bin/indurop-agent", {}};
  for (const PackageFile& entry : package->files) {
    if (!entry.path.starts_with(architecture + "/")) {
      continue;
    }
    if (const auto damage = files.damage_in(id, entry)) {
      return Problem{describe(*damage)};
    }
    if (fs::path(entry.path).filename().string().starts_with("libindurop.so")) {
      out.libraries = (files.deployment(id) / entry.path).parent_path();
    }
  }
  return out;
}

std::string release_folder_in(const fs::path& program) {
  constexpr std::string_view kFolder = "/platform/deployments/";  // below the state folder of a board
  const std::string path = program.string();
  const std::size_t at = path.find(kFolder);
  return at == std::string::npos ? std::string() : path.substr(0, path.find('/', at + kFolder.size()));
}

std::vector<std::string> release_environment(const fs::path& platform, const fs::path& libraries,
                                             const std::vector<std::string>& further) {
  std::vector<std::string> out = base::environment_without({kLibraryPath, kReleaseVariable, kLauncherVariable});
  out.insert(out.end(), further.begin(), further.end());
  const char* const inherited = std::getenv(kLibraryPath);
  std::vector<std::string> folders = without_releases(inherited == nullptr ? "" : inherited, platform.string());
  if (!libraries.empty()) {
    folders.insert(folders.begin(), libraries.string());
  }
  if (!folders.empty()) {
    out.push_back(fmt::format("{}={}", kLibraryPath, fmt::join(folders, ":")));
  }
  return out;
}

Result<void, Problem> try_release(const DeploymentFiles& files, const ReleasePrograms& release) {
  const fs::path node = release.agent.parent_path() / "indurop-node";
  const std::vector<std::string> environment = release_environment(files.folder(), release.libraries, {});
  for (const fs::path& program : {release.agent, node}) {
    const std::string what = what_prevents(program, environment);
    if (!what.empty()) {
      return Problem{fmt::format("release {} cannot run on this board: {}", release.version, what)};
    }
  }
  return {};
}

}  // namespace indurop::deploy
