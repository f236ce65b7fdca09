// SPDX-License-Identifier: Apache-2.0
// Agents as processes, a state directory and manifests of the test's own, and what `indurop` says about them.

#pragma once

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/dds_domain.h"
#include "tests/support/wait_until.h"
#include "vars/node_lock.h"
#include "vars/shm_file.h"
#include "vars/store.h"

namespace indurop::test {

using namespace std::chrono_literals;
using Json = nlohmann::json;

class PlantTest : public ::testing::Test {
 protected:
  struct Outcome {
    int code = -1;  // exit code, or 128 + signal
    std::string out;
    std::string err;
    [[nodiscard]] Json json() const { return Json::parse(out, nullptr, false); }
  };

  PlantTest() : folder_(std::filesystem::temp_directory_path() / ("irp-deploy-" + std::to_string(::getpid()))) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_ / "state");
    for (const char* module : {"steady", "other", "faulty", "slow"}) {
      std::filesystem::copy_file(std::string(MODULE_FOLDER) + "/" + module + ".so",
                                 folder_ / (std::string(module) + ".so"));
    }
  }
  ~PlantTest() override {
    for (const auto& [board, pid] : agents_) {
      end(pid, SIGKILL);
    }
    for (const std::string& board : boards_) {
      kill_node(board);
      wait_until([&] { return vars::running_node(board) == 0; });
      (void)vars::remove_node(board);
    }
    std::filesystem::remove_all(folder_);
  }

  // Names are unique on this machine: /dev/shm is everybody's.
  static std::string board(const std::string& name) { return "d" + std::to_string(::getpid()) + name; }
  [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }

  // A plant of boards and their modules; `more`: elements of the first board besides.
  [[nodiscard]] std::string manifest(const std::string& file,
                                     const std::vector<std::pair<std::string, std::string>>& boards,
                                     std::string more = {}) const {
    std::ofstream out(folder_ / file);
    out << "<plant name=\"p" << ::getpid() << "\"><domain>" << domain() << "</domain><external>off</external>\n";
    for (const auto& [name, module] : boards) {
      out << "<board name=\"" << board(name) << "\"><module><filename>./" << module
          << ".so</filename><moduletype>thread</moduletype><operationtype>periodic</operationtype>"
             "<period>2ms</period><priority>1</priority></module>"
          << std::exchange(more, {}) << "</board>\n";
    }
    out << "</plant>\n";
    out.close();
    return path(file);
  }

  // Extra words stand before the program, as those of indurop-lab.
  void start_agent(const std::string& name, const std::vector<std::string>& before = {},
                   const std::string& state = "") {
    std::vector<std::string> words = before;
    for (const std::string& word : {agent_program_, std::string("--quiet"), std::string("--board"), board(name)}) {
      words.push_back(word);
    }
    add_link_words(words, !before.empty());
    agents_[name] = launch(words, path(name + ".log"), path(name + ".log"), state);
    if (std::find(boards_.begin(), boards_.end(), board(name)) == boards_.end()) {
      boards_.push_back(board(name));
    }
  }
  // Of agents started from now on.
  void use_program(const std::string& program) { agent_program_ = program; }
  void stop_agent(const std::string& name, int signal) {
    end(agents_.at(name), signal);
    agents_.erase(name);
  }
  // For a second agent of the same name: the first one's process, and back again.
  [[nodiscard]] pid_t agent(const std::string& name) const { return agents_.at(name); }
  void adopt_agent(const std::string& name, pid_t pid) { agents_[name] = pid; }
  void kill_node(const std::string& node) const {
    if (const pid_t pid = vars::running_node(node); pid > 0) {
      ::kill(pid, SIGKILL);
    }
  }

  pid_t start_indurop(const std::vector<std::string>& arguments, const std::string& out,
                      const std::vector<std::string>& before = {}) {
    std::vector<std::string> words = before;
    words.emplace_back(INDUROP_PROGRAM);
    words.insert(words.end(), arguments.begin(), arguments.end());
    add_link_words(words, !before.empty());
    return launch(words, path(out), path(out + ".err"), "");
  }
  Outcome finish(pid_t pid, const std::string& out) {
    int status = 0;
    if (!wait_until([&] { return ::waitpid(pid, &status, WNOHANG) == pid; }, 60s)) {
      end(pid, SIGKILL);
      return {-1, text(path(out)), text(path(out + ".err"))};
    }
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), text(path(out)),
            text(path(out + ".err"))};
  }
  Outcome indurop(const std::vector<std::string>& arguments, const std::vector<std::string>& before = {}) {
    return finish(start_indurop(arguments, "indurop.out", before), "indurop.out");
  }
  pid_t start_program(const std::vector<std::string>& words, const std::string& out) {
    return launch(words, path(out), path(out + ".err"), "");
  }
  // Without the words that lead to agents.
  Outcome indurop_here(const std::vector<std::string>& arguments) {
    std::vector<std::string> words{INDUROP_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    return finish(launch(words, path("here.out"), path("here.out.err"), ""), "here.out");
  }
  Outcome deploy(const std::string& file, const std::vector<std::string>& more = {},
                 const std::vector<std::string>& before = {}) {
    std::vector<std::string> words{"deploy", file, "--health", "500ms", "--timeout", "10s", "-o", "json"};
    words.insert(words.end(), more.begin(), more.end());
    return indurop(words, before);
  }
  // What the board says of itself; null if it is not heard.
  Json report(const std::string& name, const std::vector<std::string>& before = {}) {
    const Json all = indurop({"boards", "-o", "json"}, before).json();
    if (all.is_object() && all.contains("boards")) {
      for (const Json& one : all["boards"]) {
        if (one["board"] == board(name)) {
          return one;
        }
      }
    }
    return {};
  }
  bool runs(const std::string& name, const std::string& deployment, const std::vector<std::string>& before = {}) {
    const Json one = report(name, before);
    return one.is_object() && one["state"] == "running" && one["deployment"] == deployment && one["phase"] == "steady";
  }

  static std::string text(const std::string& file) {
    std::ifstream in(file);
    std::ostringstream all;
    all << in.rdbuf();
    return all.str();
  }
  static int domain() { return dds_domain(); }
  // Of agents and who speaks to them.
  static int link_domain() { return dds_domain(1); }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

 private:
  static void add_link_words(std::vector<std::string>& words, bool network) {
    words.insert(words.end(), {"--domain", std::to_string(link_domain())});
    if (!network) {
      words.emplace_back("--one-host");
    }
  }
  pid_t launch(std::vector<std::string> words, const std::string& out, const std::string& err,
               const std::string& state) {
    const std::string place = state.empty() ? path("state") : state;
    const pid_t pid = ::fork();
    if (pid == 0) {
      ::setenv("INDUROP_STATE_DIR", place.c_str(), 1);
      const int out_file = ::open(out.c_str(), O_WRONLY | O_CREAT | (out == err ? O_APPEND : O_TRUNC), 0644);
      const int err_file = ::open(err.c_str(), O_WRONLY | O_CREAT | (out == err ? O_APPEND : O_TRUNC), 0644);
      ::dup2(out_file, STDOUT_FILENO);
      ::dup2(err_file, STDERR_FILENO);
      std::vector<char*> raw;
      for (std::string& word : words) {
        raw.push_back(word.data());
      }
      raw.push_back(nullptr);
      ::execv(raw[0], raw.data());
      ::_exit(127);
    }
    return pid;
  }
  static void end(pid_t pid, int signal) {
    ::kill(pid, signal);
    int status = 0;
    if (!wait_until([&] { return ::waitpid(pid, &status, WNOHANG) == pid; })) {
      ::kill(pid, SIGKILL);
      ::waitpid(pid, &status, 0);
      ADD_FAILURE() << "a program did not end";
    }
  }

  std::filesystem::path folder_;
  std::string agent_program_ = AGENT_PROGRAM;
  std::map<std::string, pid_t> agents_;
  std::vector<std::string> boards_;
};

}  // namespace indurop::test
