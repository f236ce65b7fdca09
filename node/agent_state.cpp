// SPDX-License-Identifier: Apache-2.0
#include "node/agent_state.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <utility>

#include "deploy/deployment_words.h"
#include "deploy/digest.h"
#include "vars/retain.h"

namespace indurop::node {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kCommitted = "committed.json";
constexpr std::size_t kHistoryKept = 20;
constexpr std::size_t kDeploymentsKept = 5;
constexpr std::size_t kFolderDigits = 16;

std::string failed(const std::string& what, const fs::path& where, int number) {
  return fmt::format("{} {}: {}", what, where.string(), std::strerror(number));
}

bool sync_path(const fs::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) {
    return false;
  }
  const bool done = ::fsync(file) == 0;
  ::close(file);
  return done;
}

std::string read_text(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return in ? text.str() : std::string{};
}

std::string replace_file(const fs::path& target, const std::string& text) {
  const fs::path fresh = target.string() + ".new";
  const int file = ::open(fresh.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file < 0) {
    return failed("cannot write", fresh, errno);
  }
  const bool written = ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  const int write_error = written ? 0 : errno != 0 ? errno : ENOSPC;
  const bool synced = ::fsync(file) == 0;
  const int sync_error = errno;
  ::close(file);
  if (!written || !synced) {
    ::unlink(fresh.c_str());
    return failed("cannot write", target, written ? sync_error : write_error);
  }
  if (::rename(fresh.c_str(), target.c_str()) != 0) {
    return failed("cannot replace", target, errno);
  }
  (void)sync_path(target.parent_path());
  return {};
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
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Committed from_json(const Json& whole) {
  Committed out;
  out.generation = whole.at("generation").get<std::uint64_t>();
  out.plant = whole.at("plant").get<std::string>();
  out.current = whole.at("current").get<std::string>();
  out.current_size = whole.at("current_size").get<std::uint64_t>();
  out.grant = whole.value("grant", "");
  out.previous = whole.at("previous").get<std::string>();
  out.members = whole.at("members").get<std::vector<std::string>>();
  for (const Json& entry : whole.at("history")) {
    out.history.push_back({entry.at("deployment").get<std::string>(), entry.at("plant").get<std::string>(),
                           entry.at("generation").get<std::uint64_t>(), entry.at("host").get<std::string>(),
                           entry.at("wall_ns").get<std::int64_t>(), entry.at("outcome").get<std::string>()});
  }
  return out;
}

}  // namespace

std::optional<AgentState> AgentState::open(const std::string& board, std::string& problem) {
  const fs::path folder = vars::state_directory(board);
  std::error_code error;
  for (const fs::path& needed : {folder / "files", folder / "parts", folder / "deployments"}) {
    fs::create_directories(needed, error);
    if (error) {
      problem = fmt::format("cannot make {}: {}; choose another place with INDUROP_STATE_DIR", needed.string(),
                            error.message());
      return std::nullopt;
    }
  }
  const fs::path lock_file = folder / "agent.lock";
  const int lock = ::open(lock_file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (lock < 0) {
    problem = failed("cannot open", lock_file, errno);
    return std::nullopt;
  }
  AgentState state(folder, lock);
  if (::flock(lock, LOCK_EX | LOCK_NB) != 0) {
    problem = fmt::format("another agent of board {} runs on this host", board);
    return std::nullopt;
  }
  problem = state.load();
  if (!problem.empty()) {
    return std::nullopt;
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

std::string AgentState::load() {
  const fs::path file = folder_ / kCommitted;
  std::error_code error;
  if (!fs::exists(file, error)) {
    return {};
  }
  const Json whole = Json::parse(read_text(file), nullptr, false);
  try {
    committed_ = from_json(whole);
  } catch (const Json::exception&) {
    return fmt::format("{} is damaged; remove {} to begin without a deployment", file.string(), folder_.string());
  }
  return {};
}

std::string AgentState::commit(Committed next) {
  if (next.history.size() > kHistoryKept) {
    next.history.erase(next.history.begin(), next.history.end() - kHistoryKept);
  }
  const Json whole = {
      {"indurop_state", 1},        {"generation", next.generation},     {"plant", next.plant},
      {"current", next.current},   {"current_size", next.current_size}, {"grant", next.grant},
      {"previous", next.previous}, {"members", next.members},           {"history", history_json(next.history)}};
  std::string problem = replace_file(folder_ / kCommitted, dump(whole));
  if (problem.empty()) {
    committed_ = std::move(next);
  }
  return problem;
}

std::string AgentState::history_text() const {
  return dump({{"current", committed_.current}, {"history", history_json(committed_.history)}});
}

bool AgentState::has(const std::string& digest) const {
  std::error_code error;
  return deploy::is_digest(digest) && fs::is_regular_file(file(digest), error);
}

std::string AgentState::keep(const std::string& digest) {
  const fs::path from = part(digest);
  if (!sync_path(from)) {
    return failed("cannot write", from, errno);
  }
  if (::rename(from.c_str(), file(digest).c_str()) != 0) {
    return failed("cannot rename", from, errno);
  }
  (void)sync_path(folder_ / "files");
  return {};
}

std::optional<deploy::Package> AgentState::package(const std::string& id, std::string& problem) const {
  if (!has(id)) {
    problem = fmt::format("deployment {} is not on this board any more", deploy::shown_id(id));
    return std::nullopt;
  }
  const std::string text = read_text(file(id));
  if (deploy::digest_of(text) != id) {
    problem = fmt::format("the package of deployment {} is damaged on this board's disk", deploy::shown_id(id));
    return std::nullopt;
  }
  return deploy::read_package(text, problem);
}

fs::path AgentState::deployment(const std::string& id) const {
  return folder_ / "deployments" / id.substr(0, kFolderDigits);
}

std::string AgentState::install(const std::string& id) {
  std::string problem;
  const auto content = package(id, problem);
  if (!content) {
    return problem;
  }
  const fs::path target = deployment(id);
  const fs::path fresh = target.string() + ".new";
  std::error_code error;
  if (fs::is_directory(target, error)) {
    return {};  // it got its name when it was complete, and an id has one content
  }
  fs::remove_all(fresh, error);
  std::set<fs::path> folders{fresh};
  for (const deploy::PackageFile& entry : content->files) {
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
    (void)sync_path(folder);
  }
  fs::rename(fresh, target, error);
  if (error) {
    return failed("cannot make", target, error.value());
  }
  (void)sync_path(folder_ / "deployments");
  return {};
}

fs::path AgentState::manifest(const std::string& id) const {
  std::string problem;
  const auto content = id.empty() ? std::nullopt : package(id, problem);
  if (!content) {
    return {};
  }
  fs::path file = deployment(id) / content->manifest;
  std::error_code error;
  return fs::is_regular_file(file, error) ? file : fs::path{};
}

void AgentState::collect_garbage() {
  std::set<std::string> ids{committed_.current, committed_.previous};
  for (auto entry = committed_.history.rbegin(); entry != committed_.history.rend() && ids.size() < kDeploymentsKept;
       ++entry) {
    if (entry->outcome == "committed") {
      ids.insert(entry->deployment);
    }
  }
  std::set<std::string> files;
  std::set<std::string> folders;
  for (const std::string& id : ids) {
    std::string problem;
    if (const auto content = id.empty() ? std::nullopt : package(id, problem)) {
      files.insert(id);
      folders.insert(deployment(id).filename().string());
      for (const deploy::PackageFile& entry : content->files) {
        files.insert(entry.digest);
      }
    }
  }
  const auto clean = [](const fs::path& folder, const std::set<std::string>& wanted) {
    std::error_code error;
    for (fs::directory_iterator at(folder, error), end; at != end; at.increment(error)) {
      if (!wanted.contains(at->path().filename().string())) {
        std::error_code ignored;
        fs::remove_all(at->path(), ignored);
      }
    }
  };
  clean(folder_ / "deployments", folders);
  clean(folder_ / "files", files);
  clean(folder_ / "parts", {});
}

}  // namespace indurop::node
