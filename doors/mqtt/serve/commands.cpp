// SPDX-License-Identifier: Apache-2.0
#include "doors/mqtt/serve/commands.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <sstream>

#include "core/base/read_file.h"

namespace indurop::mqtt {

CommandResult refused_command(const char* error, const std::string& message) {
  return {false, base::Json{{"error", error}, {"message", message}}};
}

Commands::Commands(ServeAccess access, Mailbox& mailbox)
    : access_(std::move(access)), mailbox_(&mailbox), thread_([this] { run(); }) {}

Commands::~Commands() {
  {
    const std::lock_guard guard(mutex_);
    stopped_ = true;
  }
  more_.notify_all();
  thread_.join();
}

void Commands::add(Command command) {
  if (command.token.empty()) {
    command.then(refused_command("forbidden", "no user of indurop serve is known for this command"));
    return;
  }
  {
    const std::lock_guard guard(mutex_);
    if (waiting_.size() < kMostWaiting) {
      waiting_.push_back(std::move(command));
      more_.notify_all();
      return;
    }
  }
  command.then(refused_command("unavailable", "too many commands wait already; try again later"));
}

void Commands::run() {
  for (;;) {
    Command command;
    {
      std::unique_lock guard(mutex_);
      more_.wait(guard, [this] { return stopped_ || !waiting_.empty(); });
      if (stopped_) {
        return;
      }
      command = std::move(waiting_.front());
      waiting_.pop_front();
    }
    mailbox_->post([then = command.then, result = request(command)] { then(result); });
  }
}

CommandResult Commands::request(const Command& command) const {
  base::Json body{{"values", command.values}, {"reason", command.reason}};
  const auto reply =
      ask(access_, "POST", fmt::format("/api/v1/boards/{}/set", path_part(command.board)), command.token, body.dump());
  if (!reply) {
    return refused_command("no_answer", reply.error().text);
  }
  auto answer = base::Json::parse(reply->body);
  if (!answer || !answer->is_object()) {
    return refused_command("no_answer", fmt::format("the server's answer is no JSON (status {})", reply->status));
  }
  constexpr int kDone = 200;
  return {reply->status == kDone, std::move(*answer)};
}

Result<std::vector<UserToken>, base::Problem> read_tokens(const std::filesystem::path& file) {
  const auto text = base::read_file(file);
  if (!text) {
    return base::Problem{base::cannot_read(file, text.error())};
  }
  struct stat info {};
  if (::stat(file.c_str(), &info) == 0 && (info.st_mode & (S_IRWXG | S_IRWXO)) != 0) {
    return base::Problem{
        fmt::format("{} can be read by others than its owner; chmod 600 '{}'", file.string(), file.string())};
  }
  std::vector<UserToken> all;
  std::istringstream lines(*text);
  std::string line;
  for (std::size_t number = 1; std::getline(lines, line); ++number) {
    std::istringstream words(line);
    UserToken one;
    if (!(words >> one.user) || one.user.starts_with('#')) {
      continue;
    }
    if (!(words >> one.token)) {
      return base::Problem{fmt::format("{}:{}: error: a line is NAME TOKEN", file.string(), number)};
    }
    all.push_back(std::move(one));
  }
  if (all.empty()) {
    return base::Problem{fmt::format("{}:1: error: there is no token", file.string())};
  }
  return all;
}

}  // namespace indurop::mqtt
