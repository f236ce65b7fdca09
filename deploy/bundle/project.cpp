// SPDX-License-Identifier: Apache-2.0
#include "deploy/bundle/project.h"

#include <fmt/format.h>
#include <unistd.h>

#include <optional>
#include <utility>

#include "core/archives/archive.h"
#include "core/base/file_problem.h"
#include "core/base/new_file.h"
#include "core/base/read_file.h"
#include "deploy/transaction/package.h"

namespace indurop::deploy {
namespace {

using base::Problem;

constexpr const char* kAboutMember = "project.json";
constexpr const char* kSourceFolder = "source/";
constexpr std::uint64_t kMaxAboutBytes = std::uint64_t{16} << 20U;
constexpr std::uint64_t kMaxFileBytes = std::uint64_t{1} << 30U;

Problem damaged(const std::filesystem::path& archive) {
  return {fmt::format("{}: the sources are damaged", archive.string())};
}

}  // namespace

Result<void, Problem> write_project(const base::Json& about, const std::vector<ProjectFile>& files,
                                    const std::filesystem::path& archive) {
  archives::ArchiveWriter out;
  bool written = out.open(archive) && out.text(kAboutMember, about.dump());
  for (const ProjectFile& file : files) {
    const auto text = base::read_file(file.source, kMaxFileBytes);
    if (!text) {
      return Problem{base::cannot_read(file.source, text.error())};
    }
    written = written && out.text(kSourceFolder + file.path, *text, ::access(file.source.c_str(), X_OK) == 0);
  }
  if (!written || !out.close()) {
    return Problem{fmt::format("cannot write {}: {}", archive.string(), out.message())};
  }
  return {};
}

Result<OpenedProject, Problem> open_project(const std::filesystem::path& archive, const std::filesystem::path& folder) {
  using std::filesystem::perms;
  archives::ArchiveReader in;
  const auto about = in.open(archive) ? in.text(kAboutMember, kMaxAboutBytes) : std::nullopt;
  auto json = about ? base::Json::parse(*about) : std::nullopt;
  if (!json) {
    return damaged(archive);
  }
  OpenedProject out{std::move(*json), {}};
  while (in.next()) {
    const std::string member = in.name();
    const std::string path = member.starts_with(kSourceFolder) ? member.substr(std::string(kSourceFolder).size()) : "";
    if (!in.is_regular() || !is_package_path(path)) {
      return damaged(archive);
    }
    const std::filesystem::path place = folder / path;
    std::error_code error;
    std::filesystem::create_directories(place.parent_path(), error);
    base::NewFile to(place);
    const bool read = in.read(kMaxFileBytes, [&](std::string_view bytes) { return to.write(bytes); });
    if (const auto written = to.close(); !written) {
      return Problem{base::cannot_write(place, written.error())};
    }
    if (in.is_executable()) {
      std::filesystem::permissions(place, perms::owner_exec | perms::group_exec | perms::others_exec,
                                   std::filesystem::perm_options::add, error);
    }
    if (error) {
      return Problem{fmt::format("cannot write {}: {}", place.string(), error.message())};
    }
    if (!read) {
      return damaged(archive);
    }
    out.paths.push_back(path);
  }
  return in.failed() ? Result<OpenedProject, Problem>(damaged(archive))
                     : Result<OpenedProject, Problem>(std::move(out));
}

}  // namespace indurop::deploy
