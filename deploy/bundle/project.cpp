// SPDX-License-Identifier: Apache-2.0
#include "deploy/bundle/project.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <optional>
#include <set>
#include <string_view>
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

Problem damaged(const std::filesystem::path& archive) {
  return {fmt::format("{}: the sources are damaged", archive.string())};
}

// Unpacks the files; what it made is removed again unless keep() is called.
class UnpackedFiles {
 public:
  explicit UnpackedFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}
  UnpackedFiles(const UnpackedFiles&) = delete;
  UnpackedFiles& operator=(const UnpackedFiles&) = delete;
  ~UnpackedFiles() {
    std::error_code error;
    for (auto one = made_.rbegin(); one != made_.rend(); ++one) {
      std::filesystem::remove(*one, error);  // a folder only if it is empty
    }
  }
  void keep() { made_.clear(); }

  // Returns false if the archive is damaged, or larger than sources may be.
  Result<bool, Problem> unpack(archives::ArchiveReader& in, const std::string& path) {
    const std::filesystem::path place = folder_ / path;
    if (!make_folders(std::filesystem::path(path).parent_path())) {
      return Problem{base::cannot_write(place, base::file_problem(errno_))};
    }
    made_.push_back(place);
    base::NewFile to(place);
    const bool read = in.read(left_, [&](std::string_view bytes) {
      left_ -= bytes.size();
      return to.write(bytes);
    });
    if (const auto written = to.close(); !written) {
      return Problem{base::cannot_write(place, written.error())};
    }
    if (in.is_executable()) {
      using std::filesystem::perms;
      std::error_code error;
      std::filesystem::permissions(place, perms::owner_exec | perms::group_exec | perms::others_exec,
                                   std::filesystem::perm_options::add, error);
      if (error) {
        return Problem{fmt::format("cannot write {}: {}", place.string(), error.message())};
      }
    }
    return read;
  }

 private:
  bool make_folders(const std::filesystem::path& path) {
    std::filesystem::path at = folder_;
    for (const auto& part : path) {
      at /= part;
      if (::mkdir(at.c_str(), 0777) == 0) {
        made_.push_back(at);
      } else if (errno != EEXIST) {
        errno_ = errno;
        return false;
      }
    }
    return true;
  }

  std::filesystem::path folder_;
  std::vector<std::filesystem::path> made_;
  std::uint64_t left_ = kMaxProjectBytes;
  int errno_ = 0;
};

// Files of a repository of git are no sources: the next git command would run programs that they name.
bool is_source_path(const std::string& path) {
  const std::filesystem::path parts(path);
  return is_package_path(path) &&
         std::none_of(parts.begin(), parts.end(), [](const auto& one) { return one == ".git"; });
}

}  // namespace

Result<void, Problem> write_project(const base::Json& about, const std::vector<ProjectFile>& files,
                                    const std::filesystem::path& archive) {
  archives::ArchiveWriter out;
  bool written = out.open(archive) && out.text(kAboutMember, about.dump());
  for (const ProjectFile& file : files) {
    const auto text = base::read_file(file.source, kMaxProjectBytes);
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
  archives::ArchiveReader in;
  const auto about = in.open(archive) ? in.text(kAboutMember, kMaxAboutBytes) : std::nullopt;
  auto json = about ? base::Json::parse(*about) : std::nullopt;
  if (!json) {
    return damaged(archive);
  }
  OpenedProject out{std::move(*json), {}};
  std::set<std::string> known;
  UnpackedFiles unpacked(folder);
  while (in.next()) {
    const std::string member = in.name();
    const std::string path = member.starts_with(kSourceFolder) ? member.substr(std::string(kSourceFolder).size()) : "";
    if (!in.is_regular() || !is_source_path(path) || !known.insert(path).second) {
      return damaged(archive);
    }
    const auto whole = unpacked.unpack(in, path);
    if (!whole) {
      return whole.error();
    }
    if (!*whole) {
      return damaged(archive);
    }
    out.paths.push_back(path);
  }
  if (in.failed()) {
    return damaged(archive);
  }
  unpacked.keep();
  return out;
}

}  // namespace indurop::deploy
