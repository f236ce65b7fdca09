// SPDX-License-Identifier: Apache-2.0
#include "deploy/transaction/package.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <set>
#include <sstream>
#include <string_view>

#include "config/check/io_access.h"
#include "core/base/file_problem.h"
#include "core/base/json.h"
#include "core/base/read_file.h"
#include "core/base/text.h"
#include "core/keys/digest.h"
#include "deploy/words/release_version.h"

namespace indurop::deploy {
namespace {

using base::Json;

constexpr int kFormat = 1;
constexpr std::size_t kMaxFiles = 10'000;
constexpr std::size_t kMaxBoards = 1'000;
constexpr std::size_t kLongestPath = 1'000;
constexpr std::size_t kLongestComment = 1'000;
constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 36U;

enum class Use { Program, Data };  // a module or a library of types; anything else

// Returns the deepest folder that contains all files.
std::filesystem::path common_folder(const std::map<std::filesystem::path, Use>& files) {
  std::filesystem::path common = files.begin()->first.parent_path();
  for (const auto& [file, use] : files) {
    std::filesystem::path shared;
    auto a = common.begin();
    for (auto b = file.begin(); a != common.end() && b != file.end() && *a == *b; ++a, ++b) {
      shared /= *a;
    }
    common = shared;
  }
  return common;
}

// A module searches the manifest's folder for the files named in its properties, one or several in a value: pick.job
// place.job
std::vector<std::filesystem::path> files_named_by_properties(const config::Module& module,
                                                             const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const config::Property& property : module.properties) {
    std::istringstream words(property.value);
    for (std::string word; words >> word;) {
      const std::filesystem::path file = (folder / word).lexically_normal();
      std::error_code none;
      if (!std::filesystem::path(word).is_absolute() && std::filesystem::is_regular_file(file, none)) {
        files.push_back(file);
      }
    }
  }
  return files;
}

// Returns the files to send, and what each is used as.
std::map<std::filesystem::path, Use> files_of(const config::Plant& plant, const std::filesystem::path& manifest) {
  const std::filesystem::path folder = manifest.parent_path();
  std::map<std::filesystem::path, Use> files;
  const auto add_program = [&](const std::string& as_written) {
    if (!std::filesystem::path(as_written).is_absolute()) {
      files.emplace((folder / as_written).lexically_normal(), Use::Program);
    }
  };
  // A bare name may resolve to another path: next to the manifest, or a module of each board's own installation.
  const auto add_module = [&](const config::Module& module) {
    if (module.file_as_written.find('/') != std::string::npos || module.file.empty()) {
      add_program(module.file_as_written);
    } else if (module.file.parent_path() == folder) {
      files.emplace(module.file, Use::Program);
    }
  };
  const auto add_data = [&](const std::vector<std::filesystem::path>& named) {
    for (const std::filesystem::path& file : named) {
      files[file] = Use::Data;
    }
  };
  for (const config::Board& board : plant.boards) {
    for (const std::string& library : board.types.types_as_written) {
      add_program(library);
    }
    for (const config::Module& module : board.config.modules) {
      add_module(module);
      add_data(files_named_by_properties(module, folder));
      add_data(io_files_of(module, folder));
    }
  }
  add_data({manifest});
  return files;
}

bool lies_in(const std::filesystem::path& file, const std::filesystem::path& folder) {
  std::error_code error;
  const std::filesystem::path inside = file.lexically_relative(std::filesystem::weakly_canonical(folder, error));
  return !error && !inside.empty() && *inside.begin() != "..";
}

// Returns why some of the files must not be sent; empty: all may. Links and ".." are resolved.
std::string refusal_of(const std::map<std::filesystem::path, Use>& files,
                       const std::vector<std::filesystem::path>& allowed) {
  std::vector<std::string> refused;
  for (const auto& [file, use] : files) {
    std::error_code error;
    const std::filesystem::path real = std::filesystem::weakly_canonical(file, error);
    const bool inside =
        std::any_of(allowed.begin(), allowed.end(), [&](const auto& one) { return lies_in(real, one); });
    if (!error && std::filesystem::exists(real, error) && !inside && !(use == Use::Program && is_program(real))) {
      refused.push_back(real == file ? file.string() : fmt::format("{} ({})", file.string(), real.string()));
    }
  }
  return refused.empty() ? std::string{}
                         : fmt::format(
                               "{} would be sent to all boards and is not in the manifest's folder; if the plant "
                               "needs it, name the folder it may come from: --also FOLDER",
                               base::enumerate(refused));
}

std::string problem_of(const Package& package) {
  std::set<std::string> paths;
  std::uint64_t bytes = 0;
  for (const PackageFile& file : package.files) {
    if (!is_package_path(file.path)) {
      return fmt::format("'{}' is not a path of a file in a package", file.path);
    }
    if (!paths.insert(file.path).second) {
      return fmt::format("{} is in the package twice", file.path);
    }
    if (!keys::is_digest(file.digest)) {
      return fmt::format("{} has no SHA-256", file.path);
    }
    if (file.size > kMaxBytes || (bytes += file.size) > kMaxBytes) {
      return "the package is larger than 64 GiB";
    }
  }
  for (const std::string& path : paths) {
    for (auto folder = std::filesystem::path(path).parent_path(); !folder.empty(); folder = folder.parent_path()) {
      if (paths.contains(folder.string())) {
        return fmt::format("{} is both a file and a folder", folder.string());
      }
    }
  }
  if (!package.release.empty()) {
    return package.plant.empty() && package.boards.empty() && is_release_version(package.release)
               ? ""
               : "it is neither a release of the platform nor a plant";
  }
  if (!paths.contains(package.manifest)) {
    return "the manifest is not among its files";
  }
  return package.plant.empty() || package.boards.empty() ? "it names no plant or no boards" : "";
}

}  // namespace

bool is_package_of(const Package& package, const config::Plant& plant) {
  return package.plant == plant.name &&
         std::equal(package.boards.begin(), package.boards.end(), plant.boards.begin(), plant.boards.end(),
                    [](const std::string& name, const config::Board& board) { return name == board.name; });
}

bool is_package_path(const std::string& path) {
  const std::filesystem::path parts(path);
  if (path.empty() || path.size() > kLongestPath || parts.is_absolute() || parts.lexically_normal().string() != path ||
      path.back() == '/' || path.find('\0') != std::string::npos) {
    return false;
  }
  return std::none_of(parts.begin(), parts.end(), [](const auto& part) { return part == ".." || part == "."; });
}

bool is_program(const std::filesystem::path& file) {
  constexpr std::string_view kElf =
      "\x7f"
      "ELF";
  const auto opened = base::open_file(file);
  std::array<char, kElf.size()> begin{};
  return opened && ::pread(opened->file.get(), begin.data(), begin.size(), 0) == static_cast<ssize_t>(begin.size()) &&
         std::string_view(begin.data(), begin.size()) == kElf;
}

std::string to_text(const Package& package) {
  Json files = Json::array();
  for (const PackageFile& file : package.files) {
    files.push_back(
        {{"path", file.path}, {"sha256", file.digest}, {"size", file.size}, {"executable", file.executable}});
  }
  Json whole = package.release.empty()
                   ? Json{{"indurop_package", kFormat},
                          {"plant", package.plant},
                          {"manifest", package.manifest},
                          {"boards", package.boards},
                          {"files", files}}
                   : Json{{"indurop_package", kFormat}, {"release", package.release}, {"files", files}};
  if (!package.comment.empty()) {
    whole["comment"] = package.comment;
  }
  return whole.dump();
}

Result<Package, base::Problem> read_package(std::string_view text) {
  const Json whole = Json::parse(text).value_or(Json());
  const base::Problem damaged{"the package is damaged"};
  std::uint64_t format = 0;
  if (!read(whole, "indurop_package", format)) {
    return damaged;
  }
  if (format != kFormat) {
    return base::Problem{
        "the package is of another InduRoP version; use the same on all boards and where you deploy from"};
  }
  Package package;
  const Json& files = whole["files"];
  (void)read(whole, "comment", package.comment);
  const bool is_plant = read(whole, "plant", package.plant) && read(whole, "manifest", package.manifest) &&
                        read(whole, "boards", package.boards);
  if (is_plant == read(whole, "release", package.release) || package.boards.size() > kMaxBoards || !files.is_array() ||
      files.values().size() > kMaxFiles || package.comment.size() > kLongestComment) {
    return damaged;
  }
  for (const Json& each : files.values()) {
    PackageFile& file = package.files.emplace_back();
    if (!read(each, "path", file.path) || !read(each, "sha256", file.digest) || !read(each, "size", file.size) ||
        !read(each, "executable", file.executable)) {
      return damaged;
    }
  }
  if (std::string problem = problem_of(package); !problem.empty()) {
    return base::Problem{std::move(problem)};
  }
  return package;
}

Result<PackedPlant, base::Problem> pack_plant(const config::Plant& plant,
                                              const std::vector<std::filesystem::path>& also,
                                              const std::string& comment,
                                              const std::map<std::string, std::filesystem::path>& more) {
  const std::filesystem::path manifest = std::filesystem::absolute(plant.file).lexically_normal();
  const std::filesystem::path folder = manifest.parent_path();
  PackedPlant packed;
  packed.package.plant = plant.name;
  packed.package.comment = comment;
  for (const config::Board& board : plant.boards) {
    packed.package.boards.push_back(board.name);
  }
  const std::map<std::filesystem::path, Use> travelling = files_of(plant, manifest);
  std::vector<std::filesystem::path> allowed{folder};
  allowed.insert(allowed.end(), also.begin(), also.end());
  if (std::string outside = refusal_of(travelling, allowed); !outside.empty()) {
    return base::Problem{std::move(outside)};
  }
  const std::filesystem::path base = common_folder(travelling);
  std::map<std::string, std::filesystem::path> by_path = more;
  for (const auto& [file, use] : travelling) {
    by_path.emplace(file.lexically_relative(base).string(), file);
  }
  for (const auto& [path, file] : by_path) {
    auto digest = keys::digest_of_file(file);
    if (!digest) {
      return base::Problem{base::cannot_read(file, digest.error())};
    }
    packed.package.files.push_back({path, digest->digest, digest->size, ::access(file.c_str(), X_OK) == 0});
    packed.sources.emplace(digest->digest, file);
  }
  packed.package.manifest = manifest.lexically_relative(base).string();
  if (std::string problem = problem_of(packed.package); !problem.empty()) {
    return base::Problem{std::move(problem)};
  }
  packed.text = to_text(packed.package);
  packed.id = keys::digest_of(packed.text);
  return packed;
}

}  // namespace indurop::deploy
