// SPDX-License-Identifier: Apache-2.0
// A new copy replaces the older of the two at once, so at any moment one complete copy exists under its name.

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
#include "store/vars/os_error.h"
#include "store/vars/retain_format.h"
#include "store/vars/shm_file.h"
#include "store/vars/snapshot.h"

namespace indurop::vars {

namespace {

constexpr std::array<const char*, 2> kNames{"retain.a", "retain.b"};
constexpr const char* kReport = "retain.lost";
constexpr std::size_t kMaxBytes = std::numeric_limits<std::size_t>::max() / 2;

const DirectoryEntry* find_retained(const Store& store, const Record& record) {
  const DirectoryEntry* const entry = store.find(record.header.name_hash);
  return entry != nullptr && (entry->flags & kRetain) != 0 ? entry : nullptr;
}

void add_type(schema::Schema& types, const schema::Variable& variable) {
  schema::Variable& one = types.variables.emplace_back();
  one.name = variable.name;
  one.type = variable.type;
  one.unit = variable.unit;
  one.kind = variable.kind;
}

class Restorer {
 public:
  Restorer(Store& store, const schema::Schema& types, bool only_changed, RetainReport& report)
      : store_(store), types_(types), only_changed_(only_changed), report_(report) {}

  void restore(const Record& record) {
    const DirectoryEntry* entry = find_retained(store_, record);
    if (entry == nullptr) {
      report_.kept.push_back(record.name);
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

Status read_each(const Store& store, const std::vector<PartToRead>& parts) {
  for (const PartToRead& part : parts) {
    if (Status status = store.read(*part.variable, part.offset, part.to); !status) {
      return status;
    }
  }
  return {};
}

bool is_of_this_board(const Store& store, const DirectoryEntry& entry) {
  return abi::update_offset_of(store.entry(entry.name_hash, 0), entry.kind).load(std::memory_order_relaxed) == 0;
}

// Values of this board are of one instant, so that those that belong together fit. If they are written without a pause,
// and always for values that other boards send, each is whole, but of its own instant.
Status read_values(const Store& store, const std::vector<PartToRead>& parts) {
  std::vector<PartToRead> own;
  std::vector<PartToRead> sent;
  for (const PartToRead& part : parts) {
    (is_of_this_board(store, *part.variable) ? own : sent).push_back(part);
  }
  Status status = read_snapshot(store, own);
  if (!status && status.error().code == Errc::Busy) {
    status = read_each(store, own);
  }
  return status ? read_each(store, sent) : status;
}

Result<Bytes> collect(const Store& store, const std::string& types, const Bytes& kept) {
  const auto directory = store.directory();
  std::vector<Bytes> values;
  values.reserve(directory.size());
  std::vector<PartToRead> parts;
  for (const DirectoryEntry& entry : directory) {
    if ((entry.flags & kRetain) != 0) {
      parts.push_back({&entry, 0, values.emplace_back(entry.value_size)});
    }
  }
  if (Status status = read_values(store, parts); !status) {
    return status.error();
  }
  Bytes payload;
  append_types(payload, types);
  const std::size_t without_records = payload.size();
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const DirectoryEntry& entry = *parts[i].variable;
    const std::string& name = store.schema().variables[entry.schema_index].name;
    const auto length = static_cast<std::uint32_t>(name.size());
    append_record(payload, {{entry.name_hash, entry.type_hash, length, entry.value_size}, name, values[i]});
  }
  payload.insert(payload.end(), kept.begin(), kept.end());
  return payload.size() > without_records ? payload : Bytes{};
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

std::string RetainReport::kept_line() const {
  constexpr std::size_t kShown = 5;
  std::string names;
  for (std::size_t i = 0; i < std::min(kept.size(), kShown); ++i) {
    names += (i == 0 ? " " : ", ") + kept[i];
  }
  if (kept.size() > kShown) {
    names += " and " + std::to_string(kept.size() - kShown) + " more";
  }
  return names.empty() ? "" : "values are kept for variables that this configuration does not declare retain:" + names;
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
  const schema::Schema types = take_types(copy_.version, rest);
  Restorer restorer(store, types, only_changed, report);
  Record record;
  while (next_record(rest, record)) {
    restorer.restore(record);
  }
  std::sort(report.kept.begin(), report.kept.end());
  keep_report(report);
  return report;
}

void RetainFile::keep_report(RetainReport& report) const {
  std::error_code failure;
  if (!report.lost.empty()) {
    const std::filesystem::path kept = directory_ / ("retain.before." + std::to_string(copy_.sequence));
    std::filesystem::copy_file(directory_ / kNames[static_cast<std::size_t>(newest_)], kept,
                               std::filesystem::copy_options::overwrite_existing, failure);
    report.lost.push_back(failure ? kept.string() + ": cannot be written: " + failure.message()
                                  : "the previous values are kept in " + kept.string());
  }
  std::string text;
  for (const std::string& one : report.lost) {
    text += one + "\n";
  }
  if (const std::string kept = report.kept_line(); !kept.empty()) {
    text += kept + "\n";
  }
  if (text.empty()) {
    std::filesystem::remove(directory_ / kReport, failure);
    return;
  }
  static_cast<void>(base::replace_file(directory_ / kReport, text, base::Durable::No));  // reported at the start, too
}

std::vector<std::string> RetainFile::last_report() const {
  std::vector<std::string> lines;
  constexpr std::size_t kMaxText = 1U << 20U;
  const auto text = base::read_file(directory_ / kReport, kMaxText);
  for (std::size_t from = 0; text && from < text->size();) {
    const std::size_t end = std::min(text->find('\n', from), text->size());
    lines.push_back(text->substr(from, end - from));
    from = end + 1;
  }
  return lines;
}

void RetainFile::prepare(const Store& store) {
  schema::Schema types;
  for (const DirectoryEntry& entry : store.directory()) {
    if ((entry.flags & kRetain) != 0) {
      add_type(types, store.schema().variables[entry.schema_index]);
    }
  }
  kept_.clear();
  std::span<const std::uint8_t> rest(copy_.payload);
  const schema::Schema older = take_types(copy_.version, rest);
  Record record;
  while (next_record(rest, record)) {
    if (find_retained(store, record) == nullptr) {
      append_record(kept_, record);
      if (const schema::Variable* const type = schema::find_variable(older, record.name); type != nullptr) {
        add_type(types, *type);
      }
    }
  }
  types_ = schema::to_json(types);
  layout_ = store.layout_hash();
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
  if (layout_ != store.layout_hash()) {
    prepare(store);
  }
  auto payload = collect(store, types_, kept_);
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
  for (const char* name : {kNames[0], kNames[1], kReport}) {
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
