// SPDX-License-Identifier: Apache-2.0
// iceoryx 2.0.3 reports why a mapping failed only by printing it, so each is tried before iceoryx is called. Its object
// that opens by name is not used: it sets the umask of the whole process to 0 for a moment and maps more than the file
// has.

#include "store/vars/shm_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <iceoryx_hoofs/internal/posix_wrapper/shared_memory_object/memory_map.hpp>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "core/rt/lost_pages.h"
#include "store/vars/os_error.h"

namespace indurop::vars {

namespace {

using iox::posix::MemoryMap;

std::string path_of(const std::string& name) {
  return std::string(kShmDirectory) + "/" + name;
}

std::string unfinished(const std::string& name) {
  return name + ".tmp";
}

class Descriptor {
 public:
  explicit Descriptor(int number) noexcept : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) {
      ::close(number_);
    }
  }
  [[nodiscard]] int get() const noexcept { return number_; }

 private:
  int number_;
};

Result<MemoryMap> map(int file, std::size_t size, Mode mode) {
  const bool writable = mode == Mode::ReadWrite;
  void* const tried = ::mmap(nullptr, size, writable ? PROT_READ | PROT_WRITE : PROT_READ, MAP_SHARED, file, 0);
  if (tried == MAP_FAILED) {
    return os_error(errno, "map shared memory");
  }
  ::munmap(tried, size);
  auto mapped = iox::posix::MemoryMapBuilder()
                    .length(size)
                    .fileDescriptor(file)
                    .accessMode(writable ? iox::posix::AccessMode::READ_WRITE : iox::posix::AccessMode::READ_ONLY)
                    .create();
  if (mapped.has_error()) {
    return os_error(ENOMEM, "map shared memory");
  }
  return std::move(mapped.value());
}

int allocate(int file, std::size_t from, std::size_t size) noexcept {
  int error = EINTR;
  while (error == EINTR) {
    error = ::posix_fallocate(file, static_cast<off_t>(from), static_cast<off_t>(size));
  }
  return error;
}

void make_present(std::byte* memory, std::size_t size, Mode mode) noexcept {
  const int advice = mode == Mode::ReadWrite ? MADV_POPULATE_WRITE : MADV_POPULATE_READ;
  if (::madvise(memory, size, advice) == 0) {
    return;
  }
  // Kernels before 5.14: a read makes the page present, the first write may still cost a minor fault.
  constexpr std::size_t kSmallestPage = 4096;
  for (std::size_t i = 0; i < size; i += kSmallestPage) {
    static_cast<void>(__atomic_load_n(reinterpret_cast<const unsigned char*>(memory) + i, __ATOMIC_RELAXED));
  }
}

int open_file(const std::string& name, Mode mode) noexcept {
  const int flags = (mode == Mode::ReadWrite ? O_RDWR : O_RDONLY) | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK;
  return ::open(path_of(name).c_str(), flags);
}

Status inspect(const Descriptor& file, struct stat& info) noexcept {
  if (file.get() < 0) {
    return os_error(errno, "open shared memory");
  }
  if (::fstat(file.get(), &info) != 0) {
    return os_error(errno, "inspect shared memory");
  }
  if (!S_ISREG(info.st_mode) || info.st_size <= 0) {
    return Error{Errc::Corrupt, 0, "shared memory file is empty or not a regular file"};
  }
  // A file from create() has all its memory allocated. A sparse file may claim any size at no cost to its creator.
  constexpr off_t kBlock = 512;
  if (info.st_blocks * kBlock < info.st_size) {
    return Error{Errc::Corrupt, 0, "shared memory file has holes"};
  }
  return {};
}

}  // namespace

struct ShmFile::Impl {
  Impl(MemoryMap&& mapped, const struct stat& status, std::size_t room, Mode access, const std::string& name)
      : memory(std::move(mapped)),
        most(static_cast<std::size_t>(status.st_size) + room),
        guard(memory.getBaseAddress(), most, access == Mode::ReadWrite, name),
        info(status),
        size(static_cast<std::size_t>(status.st_size)),
        mode(access),
        final_path(path_of(name)) {}
  MemoryMap memory;
  std::size_t most;  // bytes of addresses
  rt::GuardedMapping guard;
  struct stat info;  // when it was mapped
  std::atomic<std::size_t> size;
  Mode mode;
  std::string unpublished;  // temporary path, empty if the file has its name
  std::string final_path;
};

bool valid_node_name(std::string_view node) noexcept {
  constexpr std::size_t kLongest = 40;
  return !node.empty() && node.size() <= kLongest && std::all_of(node.begin(), node.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
}

std::string block_file(const std::string& node) {
  return "indurop." + node;
}
std::string run_file(const std::string& node) {
  return "indurop." + node + ".run";
}
std::string mirror_file(const std::string& node) {
  return "indurop." + node + ".mirror";
}
std::string external_file(const std::string& node) {
  return "indurop." + node + ".external";
}
std::string tape_file(const std::string& node) {
  return "indurop." + node + ".tape";
}
std::string keyframe_file(const std::string& node) {
  return "indurop." + node + ".keyframes";
}
std::string replay_input_file(const std::string& node) {
  return "indurop." + node + ".retold";
}
std::string lock_file(const std::string& node) {
  return "indurop." + node + ".lock";
}

std::string pool_file(const std::string& node, std::uint64_t name_hash) {
  char hash[2 * sizeof(name_hash) + 1];
  std::snprintf(hash, sizeof hash, "%016llx", static_cast<unsigned long long>(name_hash));
  return "indurop." + node + ".pool." + hash;
}

std::vector<std::string> shm_files_beginning_with(const std::string& beginning) {
  std::vector<std::string> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(kShmDirectory, error)) {
    if (std::string name = entry.path().filename(); name.starts_with(beginning)) {
      files.push_back(std::move(name));
    }
  }
  return files;
}

std::vector<std::string> pool_files(const std::string& node) {
  return shm_files_beginning_with("indurop." + node + ".pool.");
}

std::uint64_t store_number(const std::string& node) noexcept {
  const std::string path = std::string(kShmDirectory) + "/" + block_file(node);
  struct stat info {};
  return ::stat(path.c_str(), &info) == 0 ? info.st_ino : 0;
}

Result<ShmFile> ShmFile::open(const std::string& name, Mode mode, std::size_t room) {
  const Descriptor file(open_file(name, mode));
  struct stat info {};
  if (const Status good = inspect(file, info); !good) {
    return good.error();
  }
  auto mapped = map(file.get(), static_cast<std::size_t>(info.st_size) + room, mode);
  if (!mapped) {
    return mapped.error();
  }
  return ShmFile(std::make_unique<Impl>(std::move(mapped.value()), info, room, mode, name));
}

Result<ShmFile> ShmFile::create(const std::string& name, std::size_t size, std::size_t room) {
  if (Status status = remove_unfinished(name); !status) {
    return status.error();
  }
  const std::string temporary = path_of(unfinished(name));
  const Descriptor file(::open(temporary.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, kShmMode));
  if (file.get() < 0) {
    return os_error(errno, "create shared memory");
  }
  const auto give_up = [&](int error, const char* where) {
    ::unlink(temporary.c_str());
    return os_error(error, where);
  };
  if (::fchmod(file.get(), kShmMode) != 0) {
    return give_up(errno, "set rights of shared memory");
  }
  if (const int error = allocate(file.get(), 0, size); error != 0) {
    return give_up(error, "reserve shared memory");
  }
  struct stat info {};
  if (::fstat(file.get(), &info) != 0) {
    return give_up(errno, "inspect new shared memory");
  }
  auto mapped = map(file.get(), size + room, Mode::ReadWrite);
  if (!mapped) {
    ::unlink(temporary.c_str());
    return mapped.error();
  }
  auto impl = std::make_unique<Impl>(std::move(mapped.value()), info, room, Mode::ReadWrite, name);
  impl->unpublished = temporary;
  return ShmFile(std::move(impl));
}

Result<ShmCopy> ShmCopy::of(const std::string& name) {
  const Descriptor file(open_file(name, Mode::ReadOnly));
  struct stat info {};
  if (const Status good = inspect(file, info); !good) {
    return good.error();
  }
  ShmCopy copy;
  const auto size = static_cast<std::size_t>(info.st_size);
  if (constexpr std::size_t kMaxFileSize = std::size_t{64} << 20U; size > kMaxFileSize) {
    return Error{Errc::Corrupt, 0, "shared memory file is larger than any of its kind"};
  }
  copy.words_.resize((size + sizeof(std::uint64_t) - 1) / sizeof(std::uint64_t));
  while (copy.bytes_ < size) {
    const ssize_t got = ::pread(file.get(), reinterpret_cast<char*>(copy.words_.data()) + copy.bytes_,
                                size - copy.bytes_, static_cast<off_t>(copy.bytes_));
    if (got <= 0) {
      break;  // it was truncated meanwhile
    }
    copy.bytes_ += static_cast<std::size_t>(got);
  }
  return copy;
}

Status ShmFile::grow(std::size_t size) noexcept {
  const std::size_t before = impl_->size.load(std::memory_order_relaxed);
  if (size <= before) {
    return {};
  }
  if (size > impl_->most) {
    return Error{Errc::NoSpace, 0, "room that was reserved for shared memory to grow"};
  }
  const Descriptor file(::open(impl_->final_path.c_str(), O_RDWR | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK));
  struct stat now {};
  if (file.get() < 0 || ::fstat(file.get(), &now) != 0) {
    return os_error(errno, "open shared memory that grows");
  }
  if (now.st_ino != impl_->info.st_ino || now.st_dev != impl_->info.st_dev) {
    return Error{Errc::NotFound, 0, "the shared memory's file was replaced"};
  }
  if (const int error = allocate(file.get(), before, size - before); error != 0) {
    return os_error(error, "reserve shared memory");
  }
  impl_->size.store(size, std::memory_order_release);
  make_present(data() + before, size - before, mode());
  return {};
}

Status ShmFile::publish() noexcept {
  if (::rename(impl_->unpublished.c_str(), impl_->final_path.c_str()) != 0) {
    return os_error(errno, "give shared memory its name");
  }
  impl_->unpublished.clear();
  return {};
}

ShmFile::ShmFile(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}
ShmFile::ShmFile(ShmFile&&) noexcept = default;
ShmFile& ShmFile::operator=(ShmFile&& other) noexcept {
  std::swap(impl_, other.impl_);
  return *this;
}
ShmFile::~ShmFile() {
  if (impl_ != nullptr && !impl_->unpublished.empty()) {
    ::unlink(impl_->unpublished.c_str());
  }
}

std::byte* ShmFile::data() const noexcept {
  return static_cast<std::byte*>(impl_->memory.getBaseAddress());
}
std::size_t ShmFile::size() const noexcept {
  return impl_->size.load(std::memory_order_acquire);
}
Mode ShmFile::mode() const noexcept {
  return impl_->mode;
}

bool ShmFile::trusted() const noexcept {
  const struct stat& info = impl_->info;
  if ((info.st_mode & S_IWOTH) != 0) {
    return false;
  }
  return info.st_uid == ::geteuid() || info.st_uid == 0 || (::geteuid() != 0 && info.st_gid == ::getegid());
}

bool ShmFile::lost() const noexcept {
  return impl_->guard.lost();
}

ShmFile::Named ShmFile::named() const noexcept {
  struct stat now {};
  if (::lstat(impl_->final_path.c_str(), &now) != 0 || now.st_dev != impl_->info.st_dev ||
      now.st_ino != impl_->info.st_ino) {
    return Named::Gone;
  }
  return static_cast<std::size_t>(now.st_size) < size() ? Named::Cut : Named::Whole;
}

void ShmFile::prefault() const noexcept {
  make_present(data(), size(), mode());
}

Status remove_unfinished(const std::string& name) noexcept {
  return remove_shm_file(unfinished(name));
}

Status remove_shm_file(const std::string& name) noexcept {
  if (::unlink(path_of(name).c_str()) != 0 && errno != ENOENT) {
    return os_error(errno, "remove shared memory");
  }
  return {};
}

}  // namespace indurop::vars
