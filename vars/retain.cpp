// SPDX-License-Identifier: Apache-2.0
// File: FileHeader, then one record per variable: RecordHeader, name, value. A copy is written beside its place,
// brought to disk and renamed over the older of the two, so at any moment one complete copy exists under its name.

#include "vars/retain.h"

#include <fcntl.h>
#include <pwd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <system_error>

#include "vars/crc32c.h"
#include "vars/os_error.h"
#include "vars/shm_file.h"

namespace indurop::vars {

namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::uint64_t kRetainMagic = 0x3154455255444e49ULL;  // "INDURET1"
constexpr std::uint32_t kRetainVersion = 1;
constexpr std::array<const char*, 2> kNames{"retain.a", "retain.b"};
constexpr std::size_t kChecked = 16;  // the checksum covers everything from this offset on

struct FileHeader {
  std::uint64_t magic;
  std::uint32_t version;
  std::uint32_t checksum;
  std::uint64_t sequence;  // the higher one is the newer
  std::uint64_t payload_size;
};
static_assert(sizeof(FileHeader) == 32 && offsetof(FileHeader, sequence) == kChecked);

struct RecordHeader {
  std::uint64_t name_hash;
  std::uint64_t type_hash;
  std::uint32_t name_length;
  std::uint32_t value_size;
};

class File {
 public:
  explicit File(int number) noexcept : number_(number) {}
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  ~File() { static_cast<void>(close()); }
  [[nodiscard]] int get() const noexcept { return number_; }
  int close() noexcept {
    const int number = number_;
    number_ = -1;
    return number >= 0 ? ::close(number) : 0;
  }

 private:
  int number_;
};

void append(Bytes& to, const void* from, std::size_t size) {
  const auto* at = static_cast<const std::uint8_t*>(from);
  to.insert(to.end(), at, at + size);
}

bool write_all(int file, const Bytes& bytes) noexcept {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t count = ::write(file, bytes.data() + done, bytes.size() - done);
    if (count > 0) {
      done += static_cast<std::size_t>(count);
    } else if (errno != EINTR) {
      return false;
    }
  }
  return true;
}

// Errors: NotFound, PermissionDenied, System.
Result<Bytes> read_all(const std::filesystem::path& path) {
  const File file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (file.get() < 0) {
    return os_error(errno, "open the file of retained values");
  }
  Bytes bytes;
  std::array<std::uint8_t, 65536> part{};
  while (true) {
    const ssize_t count = ::read(file.get(), part.data(), part.size());
    if (count == 0) {
      return bytes;
    }
    if (count > 0) {
      append(bytes, part.data(), static_cast<std::size_t>(count));
    } else if (errno != EINTR) {
      return os_error(errno, "read the file of retained values");
    }
  }
}

// Text for people, empty if the copy is sound.
std::string damage_of(const Bytes& bytes) {
  FileHeader header{};
  if (bytes.size() < sizeof(header)) {
    return "cut off";
  }
  std::memcpy(&header, bytes.data(), sizeof(header));
  if (header.magic != kRetainMagic) {
    return "not a file of retained values";
  }
  if (header.version != kRetainVersion) {
    return "written by another version of InduRoP";
  }
  if (header.payload_size != bytes.size() - sizeof(header)) {
    return "cut off";
  }
  return header.checksum == crc32c(std::span(bytes).subspan(kChecked)) ? "" : "checksum is wrong";
}

struct Record {
  RecordHeader header{};
  std::string name;
  std::span<const std::uint8_t> value;
};

// Takes one record off `rest`. False at the end, and at anything that cannot be a record.
bool next_record(std::span<const std::uint8_t>& rest, Record& record) {
  if (rest.size() < sizeof(RecordHeader)) {
    return false;
  }
  std::memcpy(&record.header, rest.data(), sizeof(RecordHeader));
  rest = rest.subspan(sizeof(RecordHeader));
  const std::uint64_t size = std::uint64_t{record.header.name_length} + record.header.value_size;
  if (size > rest.size()) {
    return false;
  }
  record.name.assign(reinterpret_cast<const char*>(rest.data()), record.header.name_length);
  record.value = rest.subspan(record.header.name_length, record.header.value_size);
  rest = rest.subspan(size);
  return true;
}

// Restores one variable, or says why not.
std::string restore(Store& store, const Record& record) {
  const DirectoryEntry* entry = store.find(record.header.name_hash);
  if (entry == nullptr) {
    return record.name + ": no longer declared, its retained value is dropped";
  }
  if ((entry->flags & kRetain) == 0) {
    return record.name + ": no longer declared retain, starts with its initial value";
  }
  if (entry->type_hash != record.header.type_hash || entry->value_size != record.header.value_size) {
    return record.name + ": its type has changed, starts with its initial value";
  }
  return store.write(*entry, 0, record.value).ok() ? "" : record.name + ": locked by another process, not restored";
}

Result<Bytes> collect(const Store& store) {
  Bytes payload;
  Bytes value;
  for (const DirectoryEntry& entry : store.directory()) {
    if ((entry.flags & kRetain) == 0) {
      continue;
    }
    value.resize(entry.value_size);
    if (Status status = store.read(entry, 0, value); !status) {
      return status.error();
    }
    const std::string& name = store.schema().variables[entry.schema_index].name;
    const RecordHeader header{entry.name_hash, entry.type_hash, static_cast<std::uint32_t>(name.size()),
                              entry.value_size};
    append(payload, &header, sizeof(header));
    append(payload, name.data(), name.size());
    append(payload, value.data(), value.size());
  }
  return payload;
}

Bytes encode(std::uint64_t sequence, const Bytes& payload) {
  FileHeader header{kRetainMagic, kRetainVersion, 0, sequence, payload.size()};
  Bytes bytes;
  bytes.reserve(sizeof(header) + payload.size());
  append(bytes, &header, sizeof(header));
  append(bytes, payload.data(), payload.size());
  header.checksum = crc32c(std::span(bytes).subspan(kChecked));
  std::memcpy(bytes.data(), &header, sizeof(header));
  return bytes;
}

}  // namespace

std::filesystem::path state_directory(const std::string& node) {
  const auto from_environment = [](const char* name) -> std::string {
    const char* const value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): read before threads change it
    return value == nullptr ? "" : value;
  };
  if (const std::string chosen = from_environment("INDUROP_STATE_DIR"); !chosen.empty()) {
    return std::filesystem::path(chosen) / node;
  }
  if (::geteuid() == 0) {
    return std::filesystem::path("/var/lib/indurop") / node;
  }
  if (const std::string state = from_environment("XDG_STATE_HOME"); !state.empty() && state.front() == '/') {
    return std::filesystem::path(state) / "indurop" / node;
  }
  std::string home = from_environment("HOME");
  if (home.empty()) {
    const passwd* const user = ::getpwuid(::geteuid());  // NOLINT(concurrency-mt-unsafe): at start only
    home = user == nullptr ? "/" : user->pw_dir;
  }
  return std::filesystem::path(home) / ".local/state/indurop" / node;
}

RetainFile::RetainFile(std::filesystem::path directory) : directory_(std::move(directory)) {}

Status RetainFile::scan(std::vector<std::string>& notes) {
  newest_ = -1;
  copy_ = {};
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    const std::filesystem::path path = directory_ / kNames[i];
    auto bytes = read_all(path);
    if (!bytes) {
      if (bytes.error().code == Errc::NotFound) {
        continue;
      }
      return bytes.error();
    }
    if (const std::string damage = damage_of(*bytes); !damage.empty()) {
      notes.push_back(path.string() + ": " + damage + ", this copy is not used");
      continue;
    }
    FileHeader header{};
    std::memcpy(&header, bytes->data(), sizeof(header));
    if (newest_ < 0 || header.sequence > copy_.sequence) {
      newest_ = static_cast<int>(i);
      copy_.sequence = header.sequence;
      copy_.payload.assign(bytes->begin() + sizeof(header), bytes->end());
    }
  }
  scanned_ = true;
  return {};
}

Result<RetainReport> RetainFile::load(Store& store) {
  RetainReport report;
  if (Status status = scan(report.notes); !status) {
    return status.error();
  }
  std::span<const std::uint8_t> rest(copy_.payload);
  Record record;
  while (next_record(rest, record)) {
    if (std::string note = restore(store, record); !note.empty()) {
      report.notes.push_back(std::move(note));
    } else {
      ++report.restored;
    }
  }
  return report;
}

Status RetainFile::save(const Store& store, bool* written) {
  if (written != nullptr) {
    *written = false;
  }
  std::vector<std::string> notes;
  if (!scanned_) {
    if (Status status = scan(notes); !status) {
      return status;
    }
  }
  auto payload = collect(store);
  if (!payload) {
    return payload.error();
  }
  if (newest_ >= 0 ? *payload == copy_.payload : payload->empty()) {
    return {};
  }
  const int target = newest_ == 0 ? 1 : 0;
  const std::uint64_t sequence = copy_.sequence + 1;
  if (Status status = write_copy(directory_ / kNames[static_cast<std::size_t>(target)], encode(sequence, *payload));
      !status) {
    return status;
  }
  newest_ = target;
  copy_ = {sequence, std::move(payload.value())};
  if (written != nullptr) {
    *written = true;
  }
  return {};
}

Status RetainFile::write_copy(const std::filesystem::path& target, const Bytes& bytes) const {
  std::error_code failure;
  std::filesystem::create_directories(directory_, failure);
  if (failure) {
    return os_error(failure.value(), "make the directory of retained values");
  }
  const std::string temporary = target.string() + ".tmp";
  constexpr mode_t kMode = 0644;
  File file(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, kMode));
  if (file.get() < 0) {
    return os_error(errno, "create the file of retained values");
  }
  if (::fchmod(file.get(), kMode) != 0 || !write_all(file.get(), bytes) || ::fsync(file.get()) != 0 ||
      file.close() != 0 || ::rename(temporary.c_str(), target.c_str()) != 0) {
    const int error = errno;
    ::unlink(temporary.c_str());
    return os_error(error, "write the file of retained values");
  }
  return sync_directory();
}

Status RetainFile::sync_directory() const {
  const File directory(::open(directory_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (directory.get() < 0 || ::fsync(directory.get()) != 0) {
    return os_error(errno, "bring the directory of retained values to disk");
  }
  return {};
}

Status RetainFile::erase() {
  scanned_ = false;
  bool found = false;
  for (const char* name : kNames) {
    for (const std::string& path : {(directory_ / name).string(), (directory_ / name).string() + ".tmp"}) {
      if (::unlink(path.c_str()) == 0) {
        found = true;
      } else if (errno != ENOENT && errno != ENOTDIR) {
        return os_error(errno, "remove the file of retained values");
      }
    }
  }
  return found ? sync_directory() : Status{};
}

}  // namespace indurop::vars
