// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/agent_state.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>  // renameat2
#include <cstring>
#include <set>
#include <utility>

#include "core/base/clone_file.h"
#include "core/base/json.h"
#include "core/base/read_file.h"
#include "core/base/replace_file.h"
#include "core/base/text.h"
#include "core/keys/digest.h"
#include "core/rt/file_lock.h"
#include "store/vars/retain.h"

namespace indurop::deploy {
namespace {

namespace fs = std::filesystem;
using base::Json;
using base::Problem;

constexpr std::size_t kHistoryKept = 20;
constexpr std::chrono::hours kPiecesKept{24};  // age of leftovers of an interrupted deployment
constexpr mode_t kStateMode = 0640;
constexpr mode_t kProgramMode = 0750;

Problem failed(const std::string& what, const fs::path& where, int number) {
  return {fmt::format("{} {}: {}", what, where.string(), std::strerror(number))};
}

std::string package_name(const std::string& id) {
  return fmt::format("the package of deployment {}", shown_id(id));
}

// Older releases made hard links between files/ and a deployment's folder; both copies would change together.
bool shares_files(const fs::path& folder, const Package& package) {
  return std::any_of(package.files.begin(), package.files.end(), [&](const PackageFile& entry) {
    std::error_code error;
    return fs::hard_link_count(folder / entry.path, error) > 1 && !error;
  });
}

// Moves `fresh` to `target` and removes what was there. A node that runs from there keeps its open files.
Result<void, Problem> replace_folder(const fs::path& fresh, const fs::path& target) {
  if (::rename(fresh.c_str(), target.c_str()) == 0) {
    return {};
  }
  std::error_code error;
  if (::renameat2(AT_FDCWD, fresh.c_str(), AT_FDCWD, target.c_str(), RENAME_EXCHANGE) != 0) {
    fs::remove_all(target, error);  // a file system without atomic exchange
    fs::rename(fresh, target, error);
    return error ? Result<void, Problem>(failed("cannot make", target, error.value())) : Result<void, Problem>();
  }
  fs::remove_all(fresh, error);
  return {};
}

// Removes everything in a folder that is not among `wanted` and is older than `age`.
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

Result<AgentState, Problem> AgentState::open(const std::string& board, Log log) {
  return open_in(vars::state_directory(board), board, kDeploymentsKept, std::move(log));
}

Result<AgentState, Problem> AgentState::open_platform(const std::string& board, Log log) {
  return open_in(platform_folder(vars::state_directory(board)), board, kReleasesKept, std::move(log));
}

Result<AgentState, Problem> AgentState::open_in(const fs::path& folder, const std::string& board, std::size_t kept,
                                                Log log) {
  std::error_code error;
  for (const fs::path& needed : {folder / "files", folder / "parts", folder / "deployments"}) {
    fs::create_directories(needed, error);
    if (error) {
      return Problem{fmt::format("cannot make {}: {}; choose another place with INDUROP_STATE_DIR", needed.string(),
                                 error.message())};
    }
  }
  // Deployed files may contain data that not every user of the machine may read.
  if (::chmod(folder.c_str(), kProgramMode) != 0) {
    return failed("cannot lock", folder, errno);
  }
  const fs::path lock_file = folder / "agent.lock";
  const int lock = ::open(lock_file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, kStateMode);
  if (lock < 0) {
    return failed("cannot open", lock_file, errno);
  }
  AgentState state(folder, lock, kept, std::move(log));
  if (!rt::lock_file(lock, rt::FileLock::Exclusive)) {
    return Problem{fmt::format("another agent of board {} runs on this host", board)};
  }
  if (auto loaded = state.load(); !loaded) {
    return std::move(loaded).error();
  }
  return state;
}

AgentState::AgentState(AgentState&& other) noexcept
    : reserve_(std::move(other.reserve_)),
      files_(std::move(other.files_)),
      lock_(std::exchange(other.lock_, -1)),
      kept_(other.kept_),
      log_(std::move(other.log_)),
      committed_(std::move(other.committed_)),
      used_(std::move(other.used_)) {}

AgentState::~AgentState() {
  if (lock_ >= 0) {
    ::close(lock_);
  }
}

void AgentState::log(const std::string& line) const {
  if (log_) {
    log_(line);
  }
}

Result<void, Problem> AgentState::load() {
  const fs::path file = folder() / kCommittedFile;
  const auto text = base::read_file(file);
  if (!text) {
    return text.error().sys_errno == ENOENT ? Result<void, Problem>()
                                            : Result<void, Problem>(Problem{base::cannot_read(file, text.error())});
  }
  auto committed = read_committed(*text);
  if (committed) {
    committed_ = std::move(*committed);
    return {};
  }
  const fs::path aside = file.string() + ".damaged";
  if (::rename(file.c_str(), aside.c_str()) != 0) {
    return failed("cannot rename", file, errno);
  }
  log(
      fmt::format("{} is damaged: {}. It is kept as {}, and this board starts without a deployment: it takes over that "
                  "of the other boards of its plant; otherwise deploy again",
                  file.string(), committed.error().text, aside.filename().string()));
  return {};
}

Result<void, Problem> AgentState::commit(Committed next) {
  if (next.history.size() > kHistoryKept) {
    next.history.erase(next.history.begin(), next.history.end() - kHistoryKept);
  }
  const fs::path file = folder() / kCommittedFile;
  const std::string text = committed_text(next);
  const auto written = reserve_.use_for([&] { return base::replace_file(file, text, base::Durable::Yes, kStateMode); });
  if (!written) {
    return Problem{base::cannot_write(file, written.error())};
  }
  committed_ = std::move(next);
  return {};
}

std::string AgentState::history_text() const {
  const Json whole{{"current", committed_.current}, {"history", history_json(committed_.history)}};
  return whole.dump(2) + "\n";
}

bool AgentState::has_sound(const std::string& digest, const std::string& name) {
  if (!has(digest)) {
    return false;
  }
  const auto damage = files_.damage_of(digest, name);
  if (!damage) {
    return true;
  }
  // A file that cannot be read now may be intact; it stays until another one replaces it.
  std::error_code error;
  const bool dropped = !damage->found.empty() && fs::remove(file(digest), error);
  log(describe(*damage) + (dropped ? "; it is dropped" : ""));
  return false;
}

Result<void, Problem> AgentState::keep(const std::string& digest) {
  const fs::path from = part(digest);
  if (const auto synced = base::sync_to_disk(from); !synced) {
    return Problem{base::cannot_write(from, synced.error())};
  }
  if (::rename(from.c_str(), file(digest).c_str()) != 0) {
    return failed("cannot rename", from, errno);
  }
  (void)base::sync_to_disk(folder() / "files");
  return {};
}

// The copies are not synced to the disk: they are verified each time before they are run.
Result<void, Problem> AgentState::lay_out(const Package& package, const fs::path& fresh) {
  std::error_code error;
  fs::remove_all(fresh, error);
  for (const PackageFile& entry : package.files) {
    const fs::path name = fresh / entry.path;
    fs::create_directories(name.parent_path(), error);
    if (error) {
      return failed("cannot make", name.parent_path(), error.value());
    }
    if (!has(entry.digest)) {
      return Problem{fmt::format("{} is not on this board: {} is missing", entry.path, file(entry.digest).string())};
    }
    if (auto copied = base::clone_file(file(entry.digest), name); !copied) {
      return copied;
    }
    if (::chmod(name.c_str(), entry.executable ? kProgramMode : kStateMode) != 0) {
      return failed("cannot set the mode of", name, errno);
    }
    const auto copy = keys::digest_of_file(name);
    if (!copy || copy->digest != entry.digest) {
      const Damage damage{file(entry.digest), entry.path, entry.digest, copy ? copy->digest : std::string{}};
      (void)has_sound(entry.digest, entry.path);
      return Problem{describe(damage)};
    }
  }
  return {};
}

Result<void, Problem> AgentState::install(const std::string& id) {
  const auto content = package(id);
  if (!content) {
    (void)has_sound(id, package_name(id));
    return content.error();
  }
  const fs::path target = files_.deployment(id);
  std::error_code error;
  if (fs::is_directory(target, error)) {
    const auto damage = files_.damage_in(id, *content);
    if (!damage && !shares_files(target, *content)) {
      return {};
    }
    if (damage) {
      log(describe(*damage) + "; it is restored from files/");
    }
  }
  const fs::path fresh = target.string() + ".new";
  if (auto done = lay_out(*content, fresh); !done) {
    return done;
  }
  return replace_folder(fresh, target);
}

Result<void, Problem> AgentState::keep_copy(const fs::path& copy, const std::string& digest) {
  auto copied = base::clone_file(copy, part(digest));
  return copied ? keep(digest) : copied;
}

Result<void, Problem> AgentState::restore(const std::string& id, const PackageFile& entry) {
  if (has_sound(entry.digest, entry.path)) {
    return {};
  }
  const fs::path copy = files_.deployment(id) / entry.path;
  if (files_.damage_in(id, entry)) {
    return Problem{fmt::format("{}: neither {} nor {} has the SHA-256 {}", entry.path, file(entry.digest).string(),
                               copy.string(), entry.digest)};
  }
  auto kept = keep_copy(copy, entry.digest);
  if (kept) {
    log(fmt::format("{}: {} is restored from {}", entry.path, file(entry.digest).string(), copy.string()));
  }
  return kept;
}

Result<void, Problem> AgentState::repair(const std::string& id) {
  const auto content = package(id);
  std::vector<std::string> lost;
  for (const PackageFile& entry : content ? content->files : std::vector<PackageFile>{}) {
    if (auto restored = restore(id, entry); !restored) {
      lost.push_back(restored.error().text);
    }
  }
  return lost.empty() ? install(id) : Result<void, Problem>(Problem{base::enumerate(lost)});
}

fs::path AgentState::manifest(const std::string& id) const {
  const auto content = package(id);
  return content ? files_.deployment(id) / content->manifest : files_.deployment(id);
}

AgentState::Needed AgentState::needed_by(const std::set<std::string>& ids) const {
  Needed needed;
  needed.folders.insert(used_);
  for (const std::string& id : ids) {
    needed.folders.insert(files_.deployment(id).filename().string());
    needed.files.insert(id);
    if (const auto content = package(id)) {
      for (const PackageFile& entry : content->files) {
        needed.files.insert(entry.digest);
      }
    }
  }
  return needed;
}

// If the package of a deployment is damaged, it is not known which files it needs.
void AgentState::remove_files_but(const std::set<std::string>& needed, bool old_only) const {
  const auto is_known = [this](const std::string& id) { return id.empty() || id == kInstalledRelease || package(id); };
  if (is_known(committed_.current) && is_known(committed_.previous)) {
    remove_others(folder() / "files", needed, old_only ? kPiecesKept : std::chrono::hours{});
  }
}

void AgentState::keep_folder_of(const fs::path& manifest) {
  const fs::path inside = manifest.lexically_relative(folder() / "deployments");
  used_ = inside.empty() || *inside.begin() == ".." ? std::string() : inside.begin()->string();
}

void AgentState::collect_garbage(const std::string& tried) {
  std::set<std::string> ids = kept_deployments(committed_, kept_);
  std::set<std::string> pieces;
  if (!tried.empty()) {
    ids.insert(tried);
    pieces = needed_by({tried}).files;
  }
  const Needed needed = needed_by(ids);
  remove_others(folder() / "deployments", needed.folders);
  remove_files_but(needed.files, false);
  remove_others(folder() / "parts", pieces);
  (void)reserve_.take();  // the next deployment says so if it cannot be
}

void AgentState::collect_old_garbage() {
  const Needed needed = needed_by(kept_deployments(committed_, kept_));
  remove_others(folder() / "deployments", needed.folders, kPiecesKept);
  remove_files_but(needed.files, true);
  remove_others(folder() / "parts", {}, kPiecesKept);
}

}  // namespace indurop::deploy
