// SPDX-License-Identifier: Apache-2.0
#include "control/io/fmu_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "control/io/fmu/fmu_file.h"
#include "core/rt/file_lock.h"

namespace indurop::io {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = "indurop-fmu-";

// Who holds this file locked has the folder.
base::Descriptor open_lock(const fs::path& folder) {
  return base::Descriptor(::open((folder / "lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600));
}

bool is_own_folder(const fs::path& path) {
  struct stat info {};
  return ::lstat(path.c_str(), &info) == 0 && S_ISDIR(info.st_mode) && info.st_uid == ::geteuid();
}

// Of processes that ended without removing them.
void remove_abandoned(const fs::path& where) {
  std::error_code error;
  for (fs::directory_iterator entry(where, error), end; !error && entry != end; entry.increment(error)) {
    const fs::path& folder = entry->path();
    if (!folder.filename().string().starts_with(kPrefix) || !is_own_folder(folder)) {
      continue;
    }
    const base::Descriptor lock = open_lock(folder);
    if (lock.is_open() && rt::lock_file(lock.get(), rt::FileLock::Exclusive)) {
      std::error_code ignored;
      fs::remove_all(folder, ignored);
    }
  }
}

// Another process may take a new folder for an abandoned one before it is locked; then the next one is tried.
Result<std::pair<fs::path, base::Descriptor>, std::string> make_folder(const fs::path& where) {
  constexpr int kTries = 100;
  for (int i = 0; i < kTries; ++i) {
    std::string name = (where / kPrefix).string() + "XXXXXX";
    if (::mkdtemp(name.data()) == nullptr) {
      break;
    }
    base::Descriptor lock = open_lock(name);
    struct stat info {};
    if (lock.is_open() && rt::lock_file_when_free(lock.get(), rt::FileLock::Exclusive) &&
        ::fstat(lock.get(), &info) == 0 && info.st_nlink > 0) {
      return std::pair(fs::path(name), std::move(lock));
    }
  }
  return fmt::format("cannot create a folder in {}: {}; TMPDIR names another place", where.string(),
                     std::strerror(errno));
}

}  // namespace

Result<FmuFolder, std::string> FmuFolder::unpack(const fs::path& fmu) {
  std::error_code error;
  const fs::path where = fs::temp_directory_path(error);
  if (error) {
    return fmt::format("there is no folder for temporary files: {}; TMPDIR names one", error.message());
  }
  remove_abandoned(where);
  auto made = make_folder(where);
  if (!made) {
    return std::move(made).error();
  }
  FmuFolder folder(made->first / "fmu", std::move(made->second));
  fs::create_directory(folder.path(), error);
  if (auto unpacked = fmu::unpack_fmu(fmu, folder.path()); !unpacked) {
    return std::move(unpacked).error();
  }
  return folder;
}

FmuFolder::~FmuFolder() {
  if (lock_.is_open()) {
    std::error_code ignored;
    fs::remove_all(path_.parent_path(), ignored);
  }
}

}  // namespace indurop::io
