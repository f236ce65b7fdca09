// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plant/project_files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <set>
#include <utility>

#include "core/base/file_problem.h"
#include "core/base/inside_folder.h"
#include "core/base/read_file.h"
#include "core/keys/private_key_in.h"
#include "deploy/bundle/bundle.h"
#include "deploy/transaction/package.h"
#include "tools/cli/plant/git_tree.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

namespace fs = std::filesystem;
using base::Problem;

constexpr const char* kInEachFolderOfKeys = "governance.p7s";

Problem unreadable(const fs::path& path, const base::FileProblem& problem) {
  return {base::cannot_read(path, problem) +
          "; sources are sent: check its permissions (ls -l), name another folder in <sources>, or write "
          "<sources>off</sources>"};
}

Result<std::set<std::string>, Problem> files_below(const fs::path& folder) {
  std::set<std::string> paths;
  std::error_code error;
  for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    std::error_code ignored;
    const std::string name = at->path().filename();
    const bool is_folder = at->is_directory(ignored);
    const bool holds_keys = is_folder && fs::exists(at->path() / kInEachFolderOfKeys, ignored);
    if (name.starts_with('.') || (is_folder && name.starts_with("build")) || holds_keys) {
      at.disable_recursion_pending();
    } else if (is_folder && ::faccessat(AT_FDCWD, at->path().c_str(), R_OK | X_OK, AT_EACCESS) != 0) {
      return unreadable(at->path(), base::file_problem(errno));
    } else if ((at->is_regular_file(ignored) || at->is_symlink(ignored)) && at->path().extension() != ".mcap") {
      paths.insert(at->path().lexically_relative(folder));
    }
  }
  if (error) {
    return Problem{fmt::format("cannot list the sources in {}: {}", folder.string(), error.message())};
  }
  return paths;
}

// Returns the folder of the sources; empty if there are none.
Result<fs::path, Problem> folder_of(const config::Plant& plant, const std::vector<fs::path>& also) {
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
  if (!base::lies_inside(named, own) &&
      std::none_of(also.begin(), also.end(), [&](const fs::path& one) { return base::lies_inside(named, one); })) {
    return Problem{fmt::format(
        "{}: <sources> names {}, which would be sent to all boards and is not in the manifest's folder; if the plant "
        "needs it, allow it: --also {}",
        plant.file.string(), named.string(), named.string())};
  }
  return named;
}

// What becomes of the files that may be sources.
class Gathering {
 public:
  Gathering(Project& project, const config::Plant& plant, bool in_git) : project_(project), in_git_(in_git) {
    std::error_code error;
    if (!plant.security.empty()) {
      keys_ = fs::absolute(plant.security, error).lexically_normal();
    }
    root_ = fs::canonical(project.folder, error);
  }

  Result<void, Problem> add(const std::string& path) {
    const fs::path source = project_.folder / path;
    std::error_code error;
    const auto kind = fs::symlink_status(source, error).type();
    if (kind == fs::file_type::none) {  // not even its kind can be read
      return unreadable(source, base::file_problem(error.value()));
    }
    if (kind == fs::file_type::symlink || kind == fs::file_type::directory) {
      project_.skipped.push_back(
          {path, kind == fs::file_type::symlink ? Project::Skipped::Link : Project::Skipped::Repository});
      return {};
    }
    // A folder that was replaced by a link has other files than those that git knows.
    const bool same_folder =
        fs::canonical(source.parent_path(), error) == (root_ / path).lexically_normal().parent_path();
    if (kind != fs::file_type::regular || !same_folder || is_key_of_plant(source) || deploy::is_packed_plant(source)) {
      return {};
    }
    return add_file(path, source);
  }
  [[nodiscard]] const base::Json& left_out() const { return left_out_; }

 private:
  [[nodiscard]] bool is_key_of_plant(const fs::path& source) const {
    return !keys_.empty() && source.string().starts_with(keys_.string() + "/");
  }

  Result<void, Problem> add_file(const std::string& path, const fs::path& source) {
    const auto text = base::read_file(source, deploy::kMaxProjectBytes);
    if (!text && text.error().kind != base::FileProblem::Kind::TooLarge) {
      return unreadable(source, text.error());
    }
    if (text && keys::holds_private_key(*text)) {
      left_out_.push_back(path);
      return {};
    }
    if (text && !in_git_ && deploy::is_program(source)) {
      return {};
    }
    bytes_ += text ? text->size() : deploy::kMaxProjectBytes + 1;
    if (bytes_ > deploy::kMaxProjectBytes) {
      return Problem{
          fmt::format("the sources in {} are larger than {} with {}: leave out what is made by .gitignore, name "
                      "another folder in the manifest, or write <sources>off</sources>",
                      project_.folder.string(), human_bytes(deploy::kMaxProjectBytes), path)};
    }
    project_.files.push_back({path, source});
    return {};
  }

  Project& project_;
  bool in_git_;
  fs::path root_;  // its folder, without links
  fs::path keys_;
  base::Json left_out_ = base::Json::array();
  std::uint64_t bytes_ = 0;
};

}  // namespace

Result<std::optional<Project>, Problem> find_project(const config::Plant& plant, const std::vector<fs::path>& also) {
  auto folder = folder_of(plant, also);
  if (!folder) {
    return std::move(folder).error();
  }
  if (folder->empty()) {
    return std::optional<Project>();
  }
  Project project;
  project.folder = *folder;
  const auto tree = read_git_tree(*folder);
  if (!tree) {
    return tree.error();
  }
  const auto paths = tree->has_value() ? Result<std::set<std::string>, Problem>((*tree)->paths) : files_below(*folder);
  if (!paths) {
    return paths.error();
  }
  Gathering gathering(project, plant, tree->has_value());
  for (const std::string& path : *paths) {
    if (auto added = gathering.add(path); !added) {
      return std::move(added).error();
    }
  }
  std::error_code error;
  const fs::path manifest = fs::absolute(plant.file, error).lexically_normal();
  project.about = {{"indurop", INDUROP_VERSION},
                   {"manifest", manifest.lexically_relative(*folder).string()},
                   {"git", tree->has_value() ? (*tree)->state : base::Json()},
                   {"left_out", gathering.left_out()}};
  return std::optional(std::move(project));
}

}  // namespace indurop::tools
