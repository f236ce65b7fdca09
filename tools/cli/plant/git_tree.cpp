// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plant/git_tree.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>  // environ

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/descriptor.h"
#include "core/base/spawn.h"
#include "core/base/text.h"
#include "deploy/bundle/bundle.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

namespace fs = std::filesystem;
using base::Problem;

std::string content_of(const base::Descriptor& file) {
  std::string text;
  std::array<char, 65536> portion{};
  for (ssize_t got = 0;
       (got = ::pread(file.get(), portion.data(), portion.size(), static_cast<off_t>(text.size()))) > 0;) {
    text.append(portion.data(), static_cast<std::size_t>(got));
  }
  return text;
}

// A hook of git that runs us names its own repository in the environment, which need not be that of the folder.
std::vector<std::string> environment_without_repository() {
  std::vector<std::string> kept;
  for (char** one = environ; *one != nullptr; ++one) {
    const std::string_view entry(*one);
    const std::string_view name = entry.substr(0, entry.find('='));
    if (name != "GIT_DIR" && name != "GIT_WORK_TREE" && name != "GIT_INDEX_FILE" && name != "GIT_PREFIX" &&
        name != "GIT_COMMON_DIR" && name != "GIT_OBJECT_DIRECTORY") {
      kept.emplace_back(entry);
    }
  }
  return kept;
}

// Returns what a git command prints about `folder`; else why it failed, in git's words.
Result<std::string, Problem> git(const fs::path& folder, const std::vector<std::string>& words) {
  const base::Descriptor output(::memfd_create("indurop-git", MFD_CLOEXEC));
  const base::Descriptor errors(::memfd_create("indurop-git", MFD_CLOEXEC));
  std::vector<std::string> command{"git", "--no-optional-locks", "-c", "core.fsmonitor=false", "-C", folder.string()};
  command.insert(command.end(), words.begin(), words.end());
  const auto child = base::spawn({.words = command,
                                  .program = {},
                                  .environment = environment_without_repository(),
                                  .output = output.get(),
                                  .errors = errors.get()});
  if (!child) {
    return Problem{fmt::format("cannot start git: {}", std::strerror(child.error().sys_errno))};
  }
  int status = 0;
  while (::waitpid(*child, &status, 0) < 0) {
    if (errno != EINTR) {
      return Problem{fmt::format("lost git: {}", std::strerror(errno))};
    }
  }
  if (base::exit_code_of(status) != 0) {
    const std::string said = content_of(errors);
    return Problem{printable(base::trimmed(std::string_view(said).substr(0, said.find('\n'))))};
  }
  return content_of(output);
}

std::string git_line(const fs::path& folder, const std::vector<std::string>& words) {
  const auto text = git(folder, words);
  return text ? std::string(base::trimmed(*text)) : std::string();
}

// Returns the folder with `.git` that this one is in; empty if there is none.
fs::path work_tree_of(const fs::path& folder) {
  std::error_code error;
  for (fs::path at = fs::weakly_canonical(folder, error); !at.empty(); at = at.parent_path()) {
    if (fs::exists(fs::symlink_status(at / ".git", error))) {
      return at;
    }
    if (at == at.parent_path()) {
      break;
    }
  }
  return {};
}

// Returns whether anything in the folder differs from the commit, apart from new bundles, which are no sources.
bool has_changes(const fs::path& folder) {
  constexpr std::string_view kNew = "?? ";
  const fs::path root = git_line(folder, {"rev-parse", "--show-toplevel"});
  const auto status = git(folder, {"status", "--porcelain", "-z", "--", "."});
  for (std::size_t at = 0; status && at < status->size();) {
    const std::size_t end = std::min(status->find('\0', at), status->size());
    const std::string entry = status->substr(at, end - at);
    if (!entry.starts_with(kNew) || !deploy::is_packed_plant(root / entry.substr(kNew.size()))) {
      return true;
    }
    at = end + 1;
  }
  return false;
}

base::Json state_of(const fs::path& folder) {
  const std::string commit = git_line(folder, {"rev-parse", "--verify", "-q", "HEAD"});
  if (commit.empty()) {
    return {};
  }
  return {{"commit", commit},
          {"branch", git_line(folder, {"rev-parse", "--abbrev-ref", "HEAD"})},
          {"changed", has_changes(folder)}};
}

}  // namespace

Result<std::optional<GitTree>, Problem> read_git_tree(const fs::path& folder) {
  const auto listed = git(folder, {"ls-files", "-z", "--cached", "--others", "--exclude-standard"});
  if (!listed) {
    const fs::path tree = work_tree_of(folder);
    if (tree.empty()) {
      return std::optional<GitTree>();
    }
    return Problem{fmt::format(
        "git cannot tell which files of {} are sources: {}; correct this, or write <sources>off</sources>. {} is a "
        "work tree of git, so files that it ignores must not be sent",
        folder.string(), listed.error().text, tree.string())};
  }
  GitTree made;
  for (std::size_t at = 0; at < listed->size();) {
    const std::size_t end = listed->find('\0', at);
    made.paths.insert(listed->substr(at, end - at));
    at = end == std::string::npos ? end : end + 1;
  }
  made.state = state_of(folder);
  return std::optional(std::move(made));
}

}  // namespace indurop::tools
