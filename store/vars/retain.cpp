// SPDX-License-Identifier: Apache-2.0
// File: FileHeader, u32 length and text of the types (schema JSON), then one record per variable: RecordHeader, name,
// value. A new copy replaces the older of the two at once, so at any moment one complete copy exists under its name.

#include "store/vars/retain.h"

#include <pwd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string_view>
#include <system_error>

#include "core/base/read_file.h"
#include "core/base/replace_file.h"
#include "core/schema/carry.h"
#include "store/vars/crc32c.h"
#include "store/vars/os_error.h"
#include "store/vars/shm_file.h"

namespace indurop::vars {

namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::uint64_t kRetainMagic = 0x3154455255444e49ULL;  // "INDURET1"
constexpr std::uint32_t kRetainVersion = 2;
constexpr std::uint32_t kWithoutTypes = 1;  // still readable
constexpr std::array<const char*, 2> kNames{"retain.a", "retain.b"};
constexpr const char* kLosses = "retain.lost";
constexpr std::size_t kMaxBytes = std::numeric_limits<std::size_t>::max() / 2;
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

void append(Bytes& to, const void* from, std::size_t size) {
  const auto* at = static_cast<const std::uint8_t*>(from);
  to.insert(to.end(), at, at + size);
}

// Text for people, empty if the copy is valid.
std::string damage_of(std::span<const std::uint8_t> bytes) {
  FileHeader header{};
  if (bytes.size() < sizeof(header)) {
    return "cut off";
  }
  std::memcpy(&header, bytes.data(), sizeof(header));
  if (header.magic != kRetainMagic) {
    return "not a file of retained values";
  }
  if (header.version != kRetainVersion && header.version != kWithoutTypes) {
    return "written by another version of InduRoP";
  }
  if (header.payload_size != bytes.size() - sizeof(header)) {
    return "cut off";
  }
  return header.checksum == crc32c(bytes.subspan(kChecked)) ? "" : "checksum is wrong";
}

struct Record {
  RecordHeader header{};
  std::string name;
  std::span<const std::uint8_t> value;
};

// Removes one record from `rest`. Returns false at the end, and at anything that cannot be a record.
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

// Reads the types at the start of `rest` and removes them.
schema::Schema take_types(std::span<const std::uint8_t>& rest) {
  std::uint32_t length = 0;
  if (rest.size() < sizeof length) {
    return {};
  }
  std::memcpy(&length, rest.data(), sizeof length);
  rest = rest.subspan(sizeof length);
  length = static_cast<std::uint32_t>(std::min<std::size_t>(length, rest.size()));
  auto types = schema::from_json({reinterpret_cast<const char*>(rest.data()), length});
  rest = rest.subspan(length);
  return types ? std::move(types).value() : schema::Schema{};  // another version: only equal types are restored
}

// The types of the retained variables, as a later run needs them.
std::string types_of(const Store& store) {
  schema::Schema out;
  for (const DirectoryEntry& entry : store.directory()) {
    if ((entry.flags & kRetain) != 0) {
      const schema::Variable& variable = store.schema().variables[entry.schema_index];
      schema::Variable& kept = out.variables.emplace_back();
      kept.name = variable.name;
      kept.type = variable.type;
      kept.unit = variable.unit;
      kept.kind = variable.kind;
    }
  }
  return schema::to_json(out);
}

class Restorer {
 public:
  Restorer(Store& store, const schema::Schema& types, bool only_changed, RetainReport& report)
      : store_(store), types_(types), only_changed_(only_changed), report_(report) {}

  void restore(const Record& record) {
    const DirectoryEntry* entry = store_.find(record.header.name_hash);
    if (entry == nullptr) {
      report_.lost.push_back(record.name + ": is no longer declared");
      return;
    }
    if ((entry->flags & kRetain) == 0) {
      report_.lost.push_back(record.name + ": is no longer declared retain, starts with its initial value");
      return;
    }
    const schema::Variable& variable = store_.schema().variables[entry->schema_index];
    const schema::Variable* before = schema::find_variable(types_, record.name);
    const bool equal = entry->type_hash == record.header.type_hash && entry->value_size == record.header.value_size;
    if (equal && (before == nullptr || before->unit == variable.unit)) {
      if (!only_changed_) {
        write(record.name, *entry, record.value);
      }
    } else if (before == nullptr) {
      report_.lost.push_back(record.name + ": its type has changed, starts with its initial value");
    } else {
      carry(record, *entry, *before, variable);
    }
  }

 private:
  void carry(const Record& record, const DirectoryEntry& entry, const schema::Variable& before,
             const schema::Variable& now) {
    Bytes value(entry.value_size);
    if (!store_.read(entry, 0, value).ok()) {
      report_.lost.push_back(record.name + ": its type has changed, starts with its initial value");
      return;
    }
    auto lost = schema::carry_value(record.name, {before.type, before.unit}, record.value, {now.type, now.unit}, value);
    report_.lost.insert(report_.lost.end(), lost.begin(), lost.end());
    write(record.name, entry, value);
  }

  void write(const std::string& name, const DirectoryEntry& entry, std::span<const std::uint8_t> value) {
    if (store_.write(entry, 0, value).ok()) {
      ++report_.restored;
    } else {
      report_.notes.push_back(name + ": locked by another process, not restored");
    }
  }

  Store& store_;
  const schema::Schema& types_;
  bool only_changed_;
  RetainReport& report_;
};

Result<Bytes> collect(const Store& store, const std::string& types) {
  Bytes payload;
  const auto length = static_cast<std::uint32_t>(types.size());
  append(payload, &length, sizeof length);
  append(payload, types.data(), types.size());
  Bytes value;
  bool any = false;
  for (const DirectoryEntry& entry : store.directory()) {
    if ((entry.flags & kRetain) == 0) {
      continue;
    }
    any = true;
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
  return any ? payload : Bytes{};
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
    const auto text = base::read_file(path, kMaxBytes);
    if (!text) {
      if (text.error().sys_errno == ENOENT) {
        continue;
      }
      return os_error(text.error().sys_errno, "read the file of retained values");
    }
    const std::span<const std::uint8_t> bytes(reinterpret_cast<const std::uint8_t*>(text->data()), text->size());
    if (const std::string damage = damage_of(bytes); !damage.empty()) {
      notes.push_back(path.string() + ": " + damage + ", this copy is not used");
      continue;
    }
    FileHeader header{};
    std::memcpy(&header, bytes.data(), sizeof(header));
    if (newest_ < 0 || header.sequence > copy_.sequence) {
      newest_ = static_cast<int>(i);
      copy_.sequence = header.sequence;
      copy_.version = header.version;
      copy_.payload.assign(bytes.begin() + sizeof(header), bytes.end());
    }
  }
  scanned_ = true;
  return {};
}

Result<RetainReport> RetainFile::load(Store& store, bool only_changed) {
  RetainReport report;
  if (Status status = scan(report.notes); !status) {
    return status.error();
  }
  std::span<const std::uint8_t> rest(copy_.payload);
  const schema::Schema types = copy_.version == kRetainVersion && !rest.empty() ? take_types(rest) : schema::Schema{};
  Restorer restorer(store, types, only_changed, report);
  Record record;
  while (next_record(rest, record)) {
    restorer.restore(record);
  }
  keep_losses(report);
  return report;
}

void RetainFile::keep_losses(RetainReport& report) const {
  const std::filesystem::path losses = directory_ / kLosses;
  std::error_code failure;
  if (report.lost.empty()) {
    std::filesystem::remove(losses, failure);
    return;
  }
  const std::filesystem::path kept = directory_ / ("retain.before." + std::to_string(copy_.sequence));
  std::filesystem::copy_file(directory_ / kNames[static_cast<std::size_t>(newest_)], kept,
                             std::filesystem::copy_options::overwrite_existing, failure);
  report.lost.push_back(failure ? kept.string() + ": cannot be written: " + failure.message()
                                : "the previous values are kept in " + kept.string());
  std::string text;
  for (const std::string& one : report.lost) {
    text += one + "\n";
  }
  static_cast<void>(base::replace_file(losses, text, base::Durable::No));  // already reported at the start
}

std::vector<std::string> RetainFile::losses() const {
  std::vector<std::string> lines;
  constexpr std::size_t kMaxText = 1U << 20U;
  const auto text = base::read_file(directory_ / kLosses, kMaxText);
  for (std::size_t from = 0; text && from < text->size();) {
    const std::size_t end = std::min(text->find('\n', from), text->size());
    lines.push_back(text->substr(from, end - from));
    from = end + 1;
  }
  return lines;
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
  if (types_layout_ != store.header().layout_hash) {
    types_ = types_of(store);
    types_layout_ = store.header().layout_hash;
  }
  auto payload = collect(store, types_);
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
  copy_ = {sequence, kRetainVersion, std::move(payload.value())};
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
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  constexpr mode_t kMode = 0644;
  if (const auto written = base::replace_file(target, text, base::Durable::Yes, kMode); !written) {
    return os_error(written.error().sys_errno, "write the file of retained values");
  }
  if (::chmod(target.c_str(), kMode) != 0) {  // whatever the umask is: tools of other users read it
    return os_error(errno, "write the file of retained values");
  }
  return {};
}

Status RetainFile::erase() {
  scanned_ = false;
  bool found = false;
  for (const char* name : {kNames[0], kNames[1], kLosses}) {
    if (::unlink((directory_ / name).c_str()) == 0) {
      found = true;
    } else if (errno != ENOENT && errno != ENOTDIR) {
      return os_error(errno, "remove the file of retained values");
    }
  }
  if (found) {
    if (const auto synced = base::sync_to_disk(directory_); !synced) {
      return os_error(synced.error().sys_errno, "bring the directory of retained values to disk");
    }
  }
  return {};
}

}  // namespace indurop::vars
