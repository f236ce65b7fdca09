// SPDX-License-Identifier: Apache-2.0
#include "deploy/package.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "deploy/digest.h"
#include "deploy/io_access.h"

namespace indurop::deploy {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kFormat = 1;
constexpr std::size_t kMostFiles = 10'000;
constexpr std::size_t kMostBoards = 1'000;
constexpr std::size_t kLongestPath = 1'000;
constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 36U;

bool is_safe_path(const std::string& text) {
  const std::filesystem::path path(text);
  if (text.empty() || text.size() > kLongestPath || path.is_absolute() || path.lexically_normal().string() != text ||
      text.back() == '/' || text.find('\0') != std::string::npos) {
    return false;
  }
  return std::none_of(path.begin(), path.end(), [](const auto& part) { return part == ".." || part == "."; });
}

// The longest folder all files lie below.
std::filesystem::path common_folder(const std::vector<std::filesystem::path>& files) {
  std::filesystem::path common = files.front().parent_path();
  for (const auto& file : files) {
    std::filesystem::path shared;
    auto a = common.begin();
    for (auto b = file.begin(); a != common.end() && b != file.end() && *a == *b; ++a, ++b) {
      shared /= *a;
    }
    common = shared;
  }
  return common;
}

// A module looks beside the manifest for the files its properties name, one or several in a value: pick.job place.job
std::vector<std::filesystem::path> files_named_by_properties(const Module& module,
                                                             const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const Property& property : module.properties) {
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

std::string problem_of(const Package& package) {
  std::set<std::string> paths;
  std::uint64_t bytes = 0;
  for (const PackageFile& file : package.files) {
    if (!is_safe_path(file.path)) {
      return fmt::format("'{}' is no path of a file in a package", file.path);
    }
    if (!paths.insert(file.path).second) {
      return fmt::format("{} is in the package twice", file.path);
    }
    if (!is_digest(file.digest)) {
      return fmt::format("{} has no SHA-256", file.path);
    }
    if (file.size > kMostBytes || (bytes += file.size) > kMostBytes) {
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
  if (!paths.contains(package.manifest)) {
    return "the manifest is not among its files";
  }
  return package.plant.empty() || package.boards.empty() ? "it names no plant or no boards" : "";
}

}  // namespace

std::string to_text(const Package& package) {
  Json files = Json::array();
  for (const PackageFile& file : package.files) {
    files.push_back(
        {{"path", file.path}, {"sha256", file.digest}, {"size", file.size}, {"executable", file.executable}});
  }
  const Json whole = {{"indurop_package", kFormat},
                      {"plant", package.plant},
                      {"manifest", package.manifest},
                      {"boards", package.boards},
                      {"files", files}};
  return whole.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::optional<Package> read_package(std::string_view text, std::string& problem) {
  const Json whole = Json::parse(text, nullptr, false);
  const auto is = [](const Json& object, const char* key, Json::value_t type) {
    const auto found = object.find(key);
    return found != object.end() && found->type() == type;
  };
  constexpr auto kString = Json::value_t::string;
  constexpr auto kArray = Json::value_t::array;
  constexpr auto kNumber = Json::value_t::number_unsigned;
  problem = "the package is damaged";
  if (!whole.is_object() || !is(whole, "indurop_package", kNumber)) {
    return std::nullopt;
  }
  if (whole["indurop_package"] != kFormat) {
    problem = "the package is of another InduRoP version; use the same on all boards and where you deploy from";
    return std::nullopt;
  }
  if (!is(whole, "plant", kString) || !is(whole, "manifest", kString) || !is(whole, "boards", kArray) ||
      !is(whole, "files", kArray) || whole["files"].size() > kMostFiles || whole["boards"].size() > kMostBoards) {
    return std::nullopt;
  }
  Package package;
  package.plant = whole["plant"].get<std::string>();
  package.manifest = whole["manifest"].get<std::string>();
  for (const Json& board : whole["boards"]) {
    if (!board.is_string()) {
      return std::nullopt;
    }
    package.boards.push_back(board.get<std::string>());
  }
  for (const Json& file : whole["files"]) {
    if (!file.is_object() || !is(file, "path", kString) || !is(file, "sha256", kString) || !is(file, "size", kNumber) ||
        !is(file, "executable", Json::value_t::boolean)) {
      return std::nullopt;
    }
    package.files.push_back({file["path"].get<std::string>(), file["sha256"].get<std::string>(),
                             file["size"].get<std::uint64_t>(), file["executable"].get<bool>()});
  }
  problem = problem_of(package);
  return problem.empty() ? std::optional(std::move(package)) : std::nullopt;
}

std::optional<PackedPlant> pack_plant(const Plant& plant, std::string& problem) {
  const std::filesystem::path manifest = std::filesystem::absolute(plant.file).lexically_normal();
  std::set<std::filesystem::path> travelling{manifest};
  const auto add = [&](const std::string& as_written) {
    if (!std::filesystem::path(as_written).is_absolute()) {
      travelling.insert((manifest.parent_path() / as_written).lexically_normal());
    }
  };
  for (const std::string& library : plant.types_as_written) {
    add(library);
  }
  PackedPlant packed;
  packed.package.plant = plant.name;
  for (const Board& board : plant.boards) {
    packed.package.boards.push_back(board.name);
    for (const Module& module : board.config.modules) {
      add(module.file_as_written);
      for (const std::filesystem::path& file : files_named_by_properties(module, manifest.parent_path())) {
        travelling.insert(file);
      }
      for (const std::filesystem::path& file : io_files_of(module, manifest.parent_path())) {
        travelling.insert(file);
      }
    }
  }
  const std::filesystem::path base = common_folder({travelling.begin(), travelling.end()});
  for (const std::filesystem::path& file : travelling) {
    PackageFile entry;
    entry.path = file.lexically_relative(base).string();
    entry.digest = digest_of_file(file, entry.size);
    if (entry.digest.empty()) {
      problem = fmt::format("{} cannot be read: {}", file.string(), std::strerror(errno));
      return std::nullopt;
    }
    entry.executable = ::access(file.c_str(), X_OK) == 0;
    packed.sources.emplace(entry.digest, file);
    packed.package.files.push_back(std::move(entry));
  }
  packed.package.manifest = manifest.lexically_relative(base).string();
  problem = problem_of(packed.package);
  if (!problem.empty()) {
    return std::nullopt;
  }
  packed.text = to_text(packed.package);
  packed.id = digest_of(packed.text);
  return packed;
}

}  // namespace indurop::deploy
