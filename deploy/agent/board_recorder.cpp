// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/board_recorder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/wait.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <system_error>
#include <utility>

#include "core/base/descriptor.h"
#include "core/base/exit_code.h"
#include "core/base/json.h"
#include "core/base/read_file.h"
#include "core/base/spawn.h"
#include "core/base/text.h"
#include "store/vars/retain.h"
#include "store/vars/shm_file.h"
#include "store/vars/store.h"
#include "store/vars/unmatched_patterns.h"

namespace indurop::deploy {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds kRecorderGrace{10};  // for writing its remaining data
constexpr std::chrono::seconds kRecorderPoll{1};
constexpr const char* kPast = "past";

fs::path folder_of(const std::string& board) {
  return vars::state_directory(board) / "recordings";
}

fs::path file_of(const std::string& board, const std::string& name) {
  return folder_of(board) / (name + ".mcap");
}

// The file with the recorder's output.
fs::path words_of(const std::string& board, const std::string& name) {
  return folder_of(board) / (name + ".log");
}

std::uint64_t size_of(const fs::path& file) {
  std::error_code error;
  const auto size = fs::file_size(file, error);
  return error ? 0 : size;
}

std::uint64_t megabytes(std::uint64_t bytes) {
  return bytes >> 20U;
}

}  // namespace

BoardRecorder::BoardRecorder(std::string board, fs::path program, Limits limits, const base::Log& log)
    : board_(std::move(board)), program_(std::move(program)), limits_(limits), log_(log) {}

BoardRecorder::~BoardRecorder() {
  if (pid_ > 0) {
    ::kill(pid_, SIGINT);  // it closes its file
  }
}

BoardRecorder::Answer BoardRecorder::begin(const Command& command, rt::MonoTime now) {
  if (command.action == Action::Record) {
    return record(command, now);
  }
  if (command.target != name_) {
    return {Outcome::Refused, "it has no such recording: its agent was restarted, or another recording has begun"};
  }
  if (command.action == Action::EndRecord && pid_ <= 0) {
    return {Outcome::Unchanged, ended_};
  }
  end("", now);
  return {Outcome::UnderWay, ""};
}

BoardRecorder::Answer BoardRecorder::record(const Command& command, rt::MonoTime now) {
  const auto lines = base::lines_of(command.target);
  if (lines.size() < 2 || !vars::valid_node_name(lines[0])) {
    return {Outcome::Refused, "the command cannot be understood"};
  }
  if (lines[0] == name_) {
    lease_until_ = now + limits_.lease;
    return pid_ > 0 ? Answer{Outcome::Unchanged, ""} : Answer{Outcome::Failed, ended_};
  }
  if (pid_ > 0) {
    return {Outcome::Refused, "it is being recorded for " + host_};
  }
  std::vector<std::string> names(lines.begin() + 2, lines.end());
  if (std::any_of(names.begin(), names.end(), [](const auto& name) { return name.empty() || name.front() == '-'; })) {
    return {Outcome::Refused, "a name of a variable cannot be empty or begin with '-'"};
  }
  const auto store = vars::Store::attach(board_, vars::Mode::ReadOnly);
  if (!store) {
    return {Outcome::Failed, fmt::format("its variables cannot be opened: {}", store.error().where)};
  }
  const auto none = vars::unmatched_patterns(*store, names);
  unknown_ = fmt::format("{}", fmt::join(none, "\n"));
  if (!names.empty() && none.size() == names.size()) {
    return {Outcome::Done, unknown_};
  }
  std::erase_if(names, [&](const auto& name) { return std::find(none.begin(), none.end(), name) != none.end(); });
  name_ = lines[0];
  host_ = command.host;
  lease_until_ = now + limits_.lease;
  return start(names, lines[1] == kPast);
}

// The earlier recording is deleted: the disk belongs to the board.
BoardRecorder::Answer BoardRecorder::start(const std::vector<std::string>& names, bool past) {
  std::error_code error;
  fs::remove_all(folder_of(board_), error);
  fs::create_directories(folder_of(board_), error);
  begun_ = false;
  asked_ = false;
  lacks_.clear();
  ended_ = limit();
  if (!ended_.empty()) {
    return {Outcome::Failed, ended_};
  }
  const base::Descriptor words(
      ::open(words_of(board_, name_).c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0644));
  base::Launch launch{.words = {"indurop", "record", "--node", board_, "-o", file_of(board_, name_).string()},
                      .program = program_,
                      .group = base::Launch::Group::Own,
                      .output = words.get(),
                      .fresh_signals = true,
                      .ends_with_us = SIGTERM};
  if (past) {
    launch.words.emplace_back("--past");
  }
  launch.words.insert(launch.words.end(), names.begin(), names.end());
  const auto pid = words.is_open() ? base::spawn(launch) : Result<pid_t>(Error{Errc::System, errno, ""});
  if (!pid) {
    ended_ = fmt::format("a recorder cannot be started: {}", std::strerror(pid.error().sys_errno));
    return {Outcome::Failed, ended_};
  }
  pid_ = *pid;
  log_.info("recording for {}", host_);
  return {Outcome::UnderWay, ""};
}

std::optional<BoardRecorder::Answer> BoardRecorder::poll(Action action) const {
  if (action == Action::Record) {
    if (pid_ <= 0 && !begun_) {
      return Answer{Outcome::Failed, ended_};
    }
    return begun_ ? std::optional(Answer{Outcome::Done, unknown_}) : std::nullopt;
  }
  if (pid_ > 0) {
    return std::nullopt;
  }
  if (action == Action::DropRecord) {
    std::error_code error;
    fs::remove_all(folder_of(board_), error);
    return error ? Answer{Outcome::Failed, error.message()} : Answer{Outcome::Done, ""};
  }
  return Answer{lacks_.empty() ? Outcome::Done : Outcome::Failed, lacks_};
}

void BoardRecorder::step(rt::MonoTime now) {
  if (pid_ <= 0) {
    return;
  }
  begun_ = begun_ || size_of(file_of(board_, name_)) > 0;
  if (int status = 0; ::waitpid(pid_, &status, WNOHANG) == pid_) {
    note_end(status);
    return;
  }
  if (asked_ && now >= kill_at_) {
    ::kill(pid_, SIGKILL);
  } else if (!asked_ && now > lease_until_) {
    end(fmt::format("{} did not report for {} s", host_, limits_.lease.count()), now);
  } else if (!asked_ && now >= next_check_) {
    next_check_ = now + kRecorderPoll;
    if (const std::string why = limit(); !why.empty()) {
      end(why, now);
    }
  }
}

// `why`: empty if it ends as requested.
void BoardRecorder::end(const std::string& why, rt::MonoTime now) {
  if (pid_ > 0 && !asked_) {
    ended_ = why;
    asked_ = true;
    kill_at_ = now + kRecorderGrace;
    ::kill(pid_, SIGINT);
  }
}

void BoardRecorder::note_end(int status) {
  pid_ = -1;
  const int code = base::exit_code_of(status);
  lacks_ = errors();
  if (lacks_.empty() && code != kOk && code != kInterrupted) {
    lacks_ = fmt::format("its recorder ended with exit code {}", code);
  }
  if (!asked_) {
    ended_ = lacks_.empty() ? "its node ended" : lacks_;
  }
  log_.info("the recording for {} has ended{}", host_, ended_.empty() ? "" : ": " + ended_);
}

std::string BoardRecorder::limit() const {
  std::error_code error;
  const fs::space_info space = fs::space(folder_of(board_), error);
  if (!error && space.available < limits_.least_free_bytes) {
    return fmt::format("{} MB are left on its disk, and it keeps {} MB free", megabytes(space.available),
                       megabytes(limits_.least_free_bytes));
  }
  return size_of(file_of(board_, name_)) >= limits_.most_bytes
             ? fmt::format("it reached the limit of {} MB", megabytes(limits_.most_bytes))
             : "";
}

// The errors that the recorder printed.
std::string BoardRecorder::errors() const {
  constexpr std::string_view kMark = "error: ";
  std::string all;
  const auto words = base::read_file(words_of(board_, name_));
  for (const std::string& line : base::lines_of(words ? *words : "")) {
    if (const auto at = line.find(kMark); at != std::string::npos) {
      all += (all.empty() ? "" : "\n") + line.substr(at + kMark.size());
    }
  }
  return all;
}

std::string recordings_text(const std::string& board) {
  using base::Json;
  Json list = Json::array();
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder_of(board), ignored)) {
    if (entry.path().extension() == ".mcap") {
      list.push_back({{"name", entry.path().stem().string()}, {"bytes", size_of(entry.path())}});
    }
  }
  return Json{{"recordings", list}}.dump();
}

std::optional<fs::path> recording_file(const std::string& board, const std::string& name) {
  std::error_code ignored;
  const fs::path file = vars::valid_node_name(name) ? file_of(board, name) : "";
  return fs::is_regular_file(file, ignored) ? std::optional(file) : std::nullopt;
}

}  // namespace indurop::deploy
