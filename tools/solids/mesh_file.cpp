// SPDX-License-Identifier: Apache-2.0
#include "tools/solids/mesh_file.h"

#include <fmt/format.h>

#include <string_view>
#include <system_error>

namespace indurop::solids {

namespace {

namespace fs = std::filesystem;

bool is_there(const fs::path& file) {
  std::error_code none;
  return fs::exists(file, none);
}

Result<fs::path, base::Problem> in_package(const std::string& package, const std::string& rest, const fs::path& urdf,
                                           const Packages& packages) {
  if (const auto given = packages.find(package); given != packages.end()) {
    fs::path file = given->second / rest;
    if (is_there(file)) {
      return file;
    }
    return base::Problem{fmt::format("there is no {}", file.string())};
  }
  if (package.empty() || package == "." || package == "..") {
    return base::Problem{fmt::format("'{}' is not the name of a package; write package://NAME/FILE", package)};
  }
  std::error_code none;
  const fs::path from = fs::absolute(urdf, none).lexically_normal().parent_path();
  for (fs::path folder = from;; folder = folder.parent_path()) {
    if (folder.filename() == package && is_there(folder / rest)) {
      return folder / rest;
    }
    if (is_there(folder / package / rest)) {
      return folder / package / rest;
    }
    if (folder == folder.parent_path()) {
      break;
    }
  }
  return base::Problem{
      fmt::format("there is no {}/{} in the folders around the URDF file; say where it is with "
                  "--package {}=FOLDER",
                  package, rest, package)};
}

}  // namespace

Result<fs::path, base::Problem> mesh_file(const std::string& uri, const fs::path& urdf, const Packages& packages) {
  for (const std::string_view scheme : {"package://", "model://"}) {
    if (uri.starts_with(scheme)) {
      const std::size_t slash = std::min(uri.find('/', scheme.size()), uri.size());
      const std::size_t rest = std::min(slash + 1, uri.size());
      return in_package(uri.substr(scheme.size(), slash - scheme.size()), uri.substr(rest), urdf, packages);
    }
  }
  constexpr std::string_view kFile = "file://";
  const fs::path named = uri.starts_with(kFile) ? uri.substr(kFile.size()) : uri;
  fs::path file = named.is_absolute() ? named : urdf.parent_path() / named;
  if (!is_there(file)) {
    return base::Problem{fmt::format("there is no {}", file.string())};
  }
  return file;
}

}  // namespace indurop::solids
