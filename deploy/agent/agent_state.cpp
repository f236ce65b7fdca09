// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/agent_state.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <set>
#include <utility>

#include "base/json.h"
#include "base/read_file.h"
#include "base/replace_file.h"
#include "keys/digest.h"
#include "rt/file_lock.h"
#include "vars/retain.h"

namespace indurop::deploy {
namespace {

namespace fs = std::filesystem;
using base::Json;
using base::Problem;

constexpr const char* kCommitted = "committed.json";
constexpr std::size_t kHistoryKept = 20;
constexpr std::size_t kDeploymentsKept = 5;
constexpr std::chrono::hours kPiecesKept{24};  // of a deployment that was cut short
constexpr std::size_t kFolderDigits = 16;

Problem failed(const std::string& what, const fs::path& where, int number) {
  return {fmt::format("{} {}: {}", what, where.string(), std::strerror(number))};
}

std::string read_text(const fs::path& file) {
  auto text = base::read_file(file);
  return text ? std::move(*text) : std::string{};
}

Json history_json(const std::vector<HistoryEntry>& history) {
  Json entries = Json::array();
  for (const HistoryEntry& entry : history) {
    entries.push_back({{"deployment", entry.deployment},
                       {"plant", entry.plant},
                       {"generation", entry.generation},
                       {"host", entry.host},
                       {"wall_ns", entry.wall_ns},
                       {"outcome", entry.outcome}});
  }
  return entries;
}

std::string dump(const Json& json) {
  return json.dump(2) + "\n";
}

// Nothing if anything is missing but the grant, which plants without keys do not have.
std::optional<Committed> from_json(const Json& whole) {
  Committed out;
  static_cast<void>(read(whole, "grant", out.grant));
  bool good = read(whole, "generation", out.generation) && read(whole, "plant", out.plant) &&
              read(whole, "current", out.current) && read(whole, "current_size", out.current_size) &&
              read(whole, "previous", out.previous) && read(whole, "members", out.members) &&
              whole["history"].is_array();
  for (const Json& each : whole["history"].values()) {
    HistoryEntry& entry = out.history.emplace_back();
    good = good && read(each, "deployment", entry.deployment) && read(each, "plant", entry.plant) &&
           read(each, "generation", entry.generation) && read(each, "host", entry.host) &&
           read(each, "wall_ns", entry.wall_ns) && read(each, "outcome", entry.outcome);
  }
  return good ? std::optional(std::move(out)) : std::nullopt;
}

// Removes what is in a folder, is not among `wanted` and is older than `age`.
void remove_others(const fs::path& folder, const std::set<std::string>& wanted, std::chrono::hours age = {}) {
  const auto newest = fs::file_time_type::clock::now() - age;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; at != end; at.increment(error)) {
    std::error_code ignored;
    const bool old = age.count() == 0 || fs::last_write_time(at->path(), ignored) < newest;
    if (old && !wanted.contains(at->path().filename().string())) {
      fs::remove_all(at->path(), ignored);
    }
  }
}

}  // namespace

Result<AgentState, Problem> AgentState::open(const std::string& board) {
  const fs::path folder = vars::state_directory(board);
  std::error_code error;
  for (const fs::path& needed : {folder / "files", folder / "parts", folder / "deployments"}) {
    fs::create_directories(needed, error);
    if (error) {
      return Problem{fmt::format("cannot make {}: {}; choose another place with INDUROP_STATE_DIR", needed.string(),
                                 error.message())};
    }
  }
  const fs::path lock_file = folder / "agent.lock";
  const int lock = ::open(lock_file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (lock < 0) {
    return failed("cannot open", lock_file, errno);
  }
  AgentState state(folder, lock);
  if (!rt::lock_file(lock, rt::FileLock::Exclusive)) {
    return Problem{fmt::format("another agent of board {} runs on this host", board)};
  }
  if (auto loaded = state.load(); !loaded) {
    return std::move(loaded).error();
  }
  return state;
}

AgentState::AgentState(AgentState&& other) noexcept
    : folder_(std::move(other.folder_)),
      lock_(std::exchange(other.lock_, -1)),
      committed_(std::move(other.committed_)) {}

AgentState::~AgentState() {
  if (lock_ >= 0) {
    ::close(lock_);
  }
}

Result<void, Problem> AgentState::load() {
  const fs::path file = folder_ / kCommitted;
  std::error_code error;
  if (!fs::exists(file, error)) {
    return {};
  }
  std::optional<Committed> committed = from_json(Json::parse(read_text(file)).value_or(Json()));
  if (!committed) {
    return Problem{
        fmt::format("{} is damaged; remove {} to begin without a deployment", file.string(), folder_.string())};
  }
  committed_ = std::move(*committed);
  return {};
}

Result<void, Problem> AgentState::commit(Committed next) {
  if (next.history.size() > kHistoryKept) {
    next.history.erase(next.history.begin(), next.history.end() - kHistoryKept);
  }
  const Json whole = {
      {"indurop_state", 1},        {"generation", next.generation},     {"plant", next.plant},
      {"current", next.current},   {"current_size", next.current_size}, {"grant", next.grant},
      {"previous", next.previous}, {"members", next.members},           {"history", history_json(next.history)}};
  const fs::path file = folder_ / kCommitted;
  constexpr mode_t kMode = 0644;
  if (const auto written = base::replace_file(file, dump(whole), base::Durable::Yes, kMode); !written) {
    return Problem{base::cannot_write(file, written.error())};
  }
  committed_ = std::move(next);
  return {};
}

std::string AgentState::history_text() const {
  return dump({{"current", committed_.current}, {"history", history_json(committed_.history)}});
}

bool AgentState::has(const std::string& digest) const {
  std::error_code error;
  return keys::is_digest(digest) && fs::is_regular_file(file(digest), error);
}

Result<void, Problem> AgentState::keep(const std::string& digest) {
  const fs::path from = part(digest);
  if (const auto synced = base::sync_to_disk(from); !synced) {
    return Problem{base::cannot_write(from, synced.error())};
  }
  if (::rename(from.c_str(), file(digest).c_str()) != 0) {
    return failed("cannot rename", from, errno);
  }
  (void)base::sync_to_disk(folder_ / "files");
  return {};
}

Result<Package, Problem> AgentState::package(const std::string& id) const {
  if (!has(id)) {
    return Problem{fmt::format("deployment {} is not on this board any more", shown_id(id))};
  }
  const std::string text = read_text(file(id));
  if (keys::digest_of(text) != id) {
    return Problem{fmt::format("the package of deployment {} is damaged on this board's disk", shown_id(id))};
  }
  return read_package(text);
}

fs::path AgentState::deployment(const std::string& id) const {
  return folder_ / "deployments" / id.substr(0, kFolderDigits);
}

Result<void, Problem> AgentState::install(const std::string& id) {
  const auto content = package(id);
  if (!content) {
    return content.error();
  }
  const fs::path target = deployment(id);
  const fs::path fresh = target.string() + ".new";
  std::error_code error;
  if (fs::is_directory(target, error)) {
    return {};  // it got its name when it was complete, and an id has one content
  }
  fs::remove_all(fresh, error);
  std::set<fs::path> folders{fresh};
  for (const PackageFile& entry : content->files) {
    const fs::path name = fresh / entry.path;
    for (fs::path folder = name.parent_path(); folder != fresh; folder = folder.parent_path()) {
      folders.insert(folder);
    }
    fs::create_directories(name.parent_path(), error);
    if (error) {
      return failed("cannot make", name.parent_path(), error.value());
    }
    // One copy of a file, whatever it is called; a file that is needed in two ways is marked executable.
    if (::link(file(entry.digest).c_str(), name.c_str()) != 0) {
      return failed("cannot make", name, errno);
    }
    if (entry.executable && ::chmod(name.c_str(), 0755) != 0) {
      return failed("cannot make executable", name, errno);
    }
  }
  for (const fs::path& folder : folders) {
    (void)base::sync_to_disk(folder);
  }
  fs::rename(fresh, target, error);
  if (error) {
    return failed("cannot make", target, error.value());
  }
  (void)base::sync_to_disk(folder_ / "deployments");
  return {};
}

fs::path AgentState::manifest(const std::string& id) const {
  const auto content = package(id);
  if (!content) {
    return {};
  }
  fs::path file = deployment(id) / content->manifest;
  std::error_code error;
  return fs::is_regular_file(file, error) ? file : fs::path{};
}

AgentState::Needed AgentState::needed_by(const std::set<std::string>& ids) const {
  Needed needed;
  for (const std::string& id : ids) {
    if (const auto content = package(id)) {
      needed.files.insert(id);
      needed.folders.insert(deployment(id).filename().string());
      for (const PackageFile& entry : content->files) {
        needed.files.insert(entry.digest);
      }
    }
  }
  return needed;
}

std::set<std::string> AgentState::kept() const {
  std::set<std::string> ids{committed_.current, committed_.previous};
  for (auto entry = committed_.history.rbegin(); entry != committed_.history.rend() && ids.size() < kDeploymentsKept;
       ++entry) {
    if (entry->outcome == "committed") {
      ids.insert(entry->deployment);
    }
  }
  return ids;
}

void AgentState::collect_garbage(const std::string& tried) {
  std::set<std::string> ids = kept();
  std::set<std::string> pieces;
  if (!tried.empty()) {
    ids.insert(tried);
    pieces = needed_by({tried}).files;
    pieces.insert(tried);
  }
  const Needed needed = needed_by(ids);
  remove_others(folder_ / "deployments", needed.folders);
  remove_others(folder_ / "files", needed.files);
  remove_others(folder_ / "parts", pieces);
}

void AgentState::collect_old_garbage() {
  const Needed needed = needed_by(kept());
  remove_others(folder_ / "deployments", needed.folders, kPiecesKept);
  remove_others(folder_ / "files", needed.files, kPiecesKept);
  remove_others(folder_ / "parts", {}, kPiecesKept);
}

}  // namespace indurop::deploy
