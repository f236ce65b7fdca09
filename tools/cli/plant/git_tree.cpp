// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plant/git_tree.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/descriptor.h"
#include "core/base/spawn.h"
#include "core/base/text.h"
#include "deploy/bundle/bundle.h"
#include "tools/client/process/child.h"
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

// Returns what a git command prints about `folder`; else why it failed, in git's words.
Result<std::string, Problem> git(const fs::path& folder, const std::vector<std::string>& words) {
  const base::Descriptor output(::memfd_create("indurop-git", MFD_CLOEXEC));
  const base::Descriptor errors(::memfd_create("indurop-git", MFD_CLOEXEC));
  std::vector<std::string> command{"git", "--no-optional-locks", "-c", "core.fsmonitor=false", "-C", folder.string()};
  command.insert(command.end(), words.begin(), words.end());
  // A hook of git that runs us names its own repository in the environment, which need not be that of the folder.
  const auto code =
      run_child({.words = command,
                 .program = {},
                 .environment = base::environment_without({"GIT_DIR", "GIT_WORK_TREE", "GIT_INDEX_FILE", "GIT_PREFIX",
                                                           "GIT_COMMON_DIR", "GIT_OBJECT_DIRECTORY"}),
                 .output = output.get(),
                 .errors = errors.get()});
  if (!code) {
    return code.error();
  }
  if (*code != 0) {
    const std::string said = content_of(errors);
    return Problem{printable(base::trimmed(std::string_view(said).substr(0, said.find('\n'))))};
  }
  return content_of(output);
}

std::string git_line(const fs::path& folder, const std::vector<std::string>& words) {
  const auto text = git(folder, words);
  return text ? std::string(base::trimmed(*text)) : std::string();
}

// Splits what git prints with -z.
std::vector<std::string> entries_of(std::string_view text) {
  std::vector<std::string> entries;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\0'), text.size());
    entries.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return entries;
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
  const std::vector<std::string> entries = status ? entries_of(*status) : std::vector<std::string>{};
  return std::any_of(entries.begin(), entries.end(), [&](const std::string& entry) {
    return !entry.starts_with(kNew) || !deploy::is_packed_plant(root / entry.substr(kNew.size()));
  });
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
  for (std::string& path : entries_of(*listed)) {
    made.paths.insert(std::move(path));
  }
  made.state = state_of(folder);
  return std::optional(std::move(made));
}

}  // namespace indurop::tools
