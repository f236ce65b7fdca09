// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plant/project_files.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "core/base/descriptor.h"
#include "core/base/file_problem.h"
#include "core/base/read_file.h"
#include "core/base/text.h"
#include "deploy/transaction/package.h"
#include "tools/client/process/child.h"
#include "tools/client/process/temporary_folder.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

namespace fs = std::filesystem;
using base::Problem;

constexpr std::uint64_t kMaxBytes = std::uint64_t{64} << 20U;

// Returns what a git command prints in `folder`; nothing if it fails, or if there is no git.
std::optional<std::string> git(const fs::path& folder, std::vector<std::string> words) {
  const TemporaryFolder temporary;
  const fs::path out = temporary.path() / "out";
  const base::Descriptor file(::open(out.c_str(), O_CREAT | O_WRONLY | O_CLOEXEC, 0600));
  words.insert(words.begin(), {"git", "-C", folder.string()});
  const auto code = run_child(words, file.get());
  if (!code || *code != 0) {
    return std::nullopt;
  }
  const auto text = base::read_file(out);
  return text ? std::optional(*text) : std::nullopt;
}

std::optional<std::string> git_line(const fs::path& folder, const std::vector<std::string>& words) {
  const auto text = git(folder, words);
  return text ? std::optional(std::string(base::trimmed(*text))) : std::nullopt;
}

// Paths that git tracks or would add; nothing outside of a work tree.
std::optional<std::set<std::string>> files_of_git(const fs::path& folder) {
  const auto text = git(folder, {"ls-files", "-z", "--cached", "--others", "--exclude-standard"});
  if (!text) {
    return std::nullopt;
  }
  std::set<std::string> paths;
  for (std::size_t at = 0; at < text->size();) {
    const std::size_t end = text->find('\0', at);
    paths.insert(text->substr(at, end - at));
    at = end + 1;
  }
  return paths;
}

std::set<std::string> files_below(const fs::path& folder) {
  std::set<std::string> paths;
  std::error_code error;
  for (fs::recursive_directory_iterator at(folder, error), end; at != end && !error; at.increment(error)) {
    const std::string name = at->path().filename();
    if (name.starts_with('.') || (at->is_directory() && name.starts_with("build"))) {
      at.disable_recursion_pending();
    } else if (at->is_regular_file() && at->path().extension() != ".mcap") {
      paths.insert(at->path().lexically_relative(folder));
    }
  }
  return paths;
}

base::Json state_of_git(const fs::path& folder) {
  const auto commit = git_line(folder, {"rev-parse", "HEAD"});
  if (!commit) {
    return {};
  }
  const auto branch = git_line(folder, {"rev-parse", "--abbrev-ref", "HEAD"});
  const auto changed = git_line(folder, {"status", "--porcelain", "--", "."});
  return {{"commit", *commit}, {"branch", branch.value_or("")}, {"changed", !changed.value_or("").empty()}};
}

bool holds_private_key(const std::string& text) {
  return text.find("PRIVATE KEY-----") != std::string::npos;
}

// Returns the folder of the sources; empty if there are none.
Result<fs::path, Problem> folder_of(const config::Plant& plant) {
  std::error_code error;
  const fs::path own = fs::absolute(plant.file, error).lexically_normal().parent_path();
  if (!plant.sources) {
    return fs::path{};
  }
  if (plant.sources_folder.empty()) {
    return fs::is_regular_file(own / "CMakeLists.txt", error) ? own : fs::path{};
  }
  const fs::path named = fs::absolute(plant.sources_folder, error).lexically_normal();
  if (!fs::is_directory(named, error)) {
    return Problem{fmt::format("{}: <sources> names {}, which is not a folder", plant.file.string(), named.string())};
  }
  return named;
}

}  // namespace

Result<std::optional<Project>, Problem> find_project(const config::Plant& plant) {
  auto folder = folder_of(plant);
  if (!folder) {
    return std::move(folder).error();
  }
  if (folder->empty()) {
    return std::optional<Project>();
  }
  Project project;
  project.folder = *folder;
  const auto tracked = files_of_git(*folder);
  const std::set<std::string> paths = tracked ? *tracked : files_below(*folder);
  std::error_code error;
  const fs::path keys = plant.security.empty() ? fs::path{} : fs::absolute(plant.security, error).lexically_normal();
  base::Json left_out = base::Json::array();
  std::uint64_t bytes = 0;
  for (const std::string& path : paths) {
    const fs::path source = *folder / path;
    if (!fs::is_regular_file(fs::symlink_status(source, error)) ||
        (!keys.empty() && source.string().starts_with(keys.string() + "/"))) {
      continue;
    }
    const auto text = base::read_file(source, kMaxBytes);
    if (!text && text.error().kind != base::FileProblem::Kind::TooLarge) {
      return Problem{base::cannot_read(source, text.error())};
    }
    if (text && holds_private_key(*text)) {
      left_out.push_back(path);
      continue;
    }
    if (text && !tracked && deploy::is_program(source)) {
      continue;
    }
    bytes += text ? text->size() : kMaxBytes + 1;
    if (bytes > kMaxBytes) {
      return Problem{
          fmt::format("the sources in {} are larger than {} with {}: leave out what is made by .gitignore, name "
                      "another folder in the manifest, or write <sources>off</sources>",
                      folder->string(), human_bytes(kMaxBytes), path)};
    }
    project.files.push_back({path, source});
  }
  const fs::path manifest = fs::absolute(plant.file, error).lexically_normal();
  project.about = {{"indurop", INDUROP_VERSION},
                   {"manifest", manifest.lexically_relative(*folder).string()},
                   {"git", state_of_git(*folder)},
                   {"left_out", left_out}};
  return std::optional(std::move(project));
}

}  // namespace indurop::tools
