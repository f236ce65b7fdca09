// SPDX-License-Identifier: Apache-2.0
// Where the file system supports it (O_TMPFILE), the new content has no name before it is complete, so that even a kill
// leaves nothing behind; elsewhere it has a temporary name.

#include "core/base/replace_file.h"

#include <fcntl.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <optional>
#include <string>

#include "core/base/descriptor.h"
#include "core/base/write_all.h"
#include "core/rt/clock.h"

namespace indurop::base {
namespace {

namespace fs = std::filesystem;

using Done = Result<void, FileProblem>;

constexpr int kMaxTries = 100;
constexpr int kMaxLinks = 40;

fs::path folder_of(const fs::path& path) {
  const fs::path folder = path.parent_path();
  return folder.empty() ? fs::path(".") : folder;
}

// Returns a new name at each call. Short, however long the name of the file to be replaced is. Early after a boot the
// kernel may have no random numbers yet.
fs::path fresh_name(const fs::path& folder) {
  std::uint64_t number = 0;
  if (::getrandom(&number, sizeof number, GRND_NONBLOCK) != sizeof number) {
    number = static_cast<std::uint64_t>(rt::to_ns(rt::MonoClock::now()));
  }
  return folder / (".indurop-" + std::to_string(number) + ".tmp");
}

// A file that is being written, in `folder`.
class Fresh {
 public:
  Fresh(const fs::path& folder, mode_t mode) : folder_(folder) {
    file_ = Descriptor(::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, mode));
    for (int i = 0; i < kMaxTries && !file_.is_open(); ++i) {
      name_ = fresh_name(folder_);
      file_ = Descriptor(::open(name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, mode));
      if (!file_.is_open() && errno != EEXIST) {
        error_ = errno;
        name_.clear();
        break;
      }
    }
  }
  Fresh(const Fresh&) = delete;
  Fresh& operator=(const Fresh&) = delete;
  ~Fresh() {
    if (!name_.empty()) {
      ::unlink(name_.c_str());
    }
  }

  // All return 0 or an errno; the first error is kept.
  int fill(std::string_view bytes, const std::optional<struct stat>& old, Durable durable) noexcept {
    keep_rights(old);
    error_ = error_ != 0 ? error_ : write_all(file_.get(), bytes);
    if (error_ == 0 && durable == Durable::Yes && ::fsync(file_.get()) != 0) {
      error_ = errno;
    }
    return error_;
  }
  int become(const fs::path& target) {
    give_name();
    if (error_ == 0 && file_.close() != 0) {
      error_ = errno;
    }
    if (error_ == 0 && ::rename(name_.c_str(), target.c_str()) != 0) {
      error_ = errno;
    }
    if (error_ == 0) {
      name_.clear();
    }
    return error_;
  }
  // Like become(), but never replaces a file.
  int become_new(const fs::path& target) {
    if (error_ == 0 && (name_.empty() ? link_open(target) : ::link(name_.c_str(), target.c_str())) != 0) {
      error_ = errno;
    }
    return error_;
  }

 private:
  void keep_rights(const std::optional<struct stat>& old) noexcept {
    struct stat mine {};
    if (error_ != 0 || !old || ::fstat(file_.get(), &mine) != 0) {
      return;
    }
    if (mine.st_uid != old->st_uid || mine.st_gid != old->st_gid) {
      [[maybe_unused]] const int forbidden = ::fchown(file_.get(), old->st_uid, old->st_gid);
    }
    constexpr mode_t kRights = 07777;
    if (::fchmod(file_.get(), old->st_mode & kRights) != 0) {
      error_ = errno;
    }
  }
  [[nodiscard]] int link_open(const fs::path& name) const {
    const std::string open_file = "/proc/self/fd/" + std::to_string(file_.get());
    return ::linkat(AT_FDCWD, open_file.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW);
  }
  void give_name() {
    for (int i = 0; i < kMaxTries && error_ == 0 && name_.empty(); ++i) {
      fs::path name = fresh_name(folder_);
      if (link_open(name) == 0) {
        name_ = std::move(name);
      } else if (errno != EEXIST) {
        error_ = errno;
      }
    }
  }

  const fs::path folder_;
  fs::path name_;
  Descriptor file_;
  int error_ = 0;
};

Done done(int error) {
  return error == 0 ? Done{} : Done{file_problem(error)};
}

// Writes to a device or a pipe. Opening does not wait for a reader, writing may.
Done write_into(const fs::path& path, bool pipe, std::string_view bytes) {
  Descriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
  if (!file.is_open()) {
    return pipe && errno == ENXIO ? Done{FileProblem{FileProblem::Kind::System, ENXIO, "no process reads this pipe"}}
                                  : done(errno);
  }
  const int flags = ::fcntl(file.get(), F_GETFL);
  (void)::fcntl(file.get(), F_SETFL, flags & ~O_NONBLOCK);
  const int error = write_all(file.get(), bytes);
  return done(error == 0 && file.close() != 0 ? errno : error);
}

// Returns the path of the file that a link leads to, whether it exists or not.
fs::path behind_links(fs::path path) {
  std::error_code error;
  for (int i = 0; i < kMaxLinks && fs::is_symlink(path, error); ++i) {
    const fs::path next = fs::read_symlink(path, error);
    path = next.is_absolute() ? next : path.parent_path() / next;
  }
  return path;
}

// Returns the open standard output or error that `path` is another name of ("/dev/stdout" > FILE); -1: none.
int standard_stream(const struct stat& status) noexcept {
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) {
    struct stat open {};
    if (::fstat(stream, &open) == 0 && open.st_dev == status.st_dev && open.st_ino == status.st_ino) {
      return stream;
    }
  }
  return -1;
}

Done replace_regular(const fs::path& target, std::string_view bytes, const std::optional<struct stat>& old,
                     Durable durable, mode_t mode) {
  Fresh fresh(folder_of(target), mode);
  int error = fresh.fill(bytes, old, durable);
  error = error == 0 ? fresh.become(target) : error;
  return error == 0 && durable == Durable::Yes ? sync_to_disk(folder_of(target)) : done(error);
}

}  // namespace

Result<void, FileProblem> replace_file(const fs::path& path, std::string_view bytes, Durable durable, mode_t mode) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) {
    if (errno != ENOENT) {
      return done(errno);
    }
    return replace_regular(behind_links(path), bytes, std::nullopt, durable, mode);
  }
  if (S_ISDIR(status.st_mode)) {
    return FileProblem{FileProblem::Kind::Directory, EISDIR, "it is a directory, not a file"};
  }
  std::error_code error;
  const bool link = fs::is_symlink(path, error);
  if (link || !S_ISREG(status.st_mode)) {
    if (const int stream = standard_stream(status); stream >= 0) {
      return done(write_all(stream, bytes));
    }
  }
  if (!S_ISREG(status.st_mode)) {
    return write_into(path, S_ISFIFO(status.st_mode), bytes);
  }
  return replace_regular(link ? behind_links(path) : path, bytes, status, durable, mode);
}

Result<void, FileProblem> create_file(const fs::path& path, std::string_view bytes, mode_t mode) {
  Fresh fresh(folder_of(path), mode);
  int error = fresh.fill(bytes, std::nullopt, Durable::Yes);
  error = error == 0 ? fresh.become_new(path) : error;
  return error == 0 ? sync_to_disk(folder_of(path)) : done(error);
}

Result<void, FileProblem> sync_to_disk(const fs::path& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (!file.is_open() || (::fsync(file.get()) != 0 && errno != EINVAL)) {  // EINVAL: it cannot be synced
    return done(errno);
  }
  return {};
}

}  // namespace indurop::base
