// SPDX-License-Identifier: Apache-2.0
#include "tests/support/program.h"

#include <fcntl.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/mount.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

namespace indurop::test {
namespace {

bool write_file(const char* path, const std::string& text) {
  std::ofstream file(path);
  file << text << std::flush;
  return file.good();
}

[[noreturn]] void become(const std::vector<std::string>& command, const Environment& environment) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  ::signal(SIGPIPE, SIG_DFL);
  ::unsetenv("INDUROP_NODE");
  ::unsetenv("INDUROP_MODULE");
  ::unsetenv("NO_COLOR");
  ::setenv("LC_ALL", "C.UTF-8", 1);
  for (const std::string& variable : environment.variables) {
    ::putenv(::strdup(variable.c_str()));
  }
  if (environment.prepare && !environment.prepare()) {
    ::_exit(Program::kNotPrepared);
  }
  if (environment.user != static_cast<uid_t>(-1)) {
    if (::setgid(environment.user) != 0 || ::setuid(environment.user) != 0) {
      ::_exit(Program::kNotPrepared);
    }
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // forgotten with the user
  }
  std::vector<char*> words;
  for (const std::string& word : command) {
    words.push_back(const_cast<char*>(word.c_str()));
  }
  words.push_back(nullptr);
  ::execv(words[0], words.data());
  ::_exit(127);
}

void connect(int in, int out, int err, const Environment& environment) {
  ::dup2(in, STDIN_FILENO);
  ::dup2(environment.stdout_to.empty() ? out : ::open(environment.stdout_to.c_str(), O_WRONLY | O_CREAT, 0600),
         STDOUT_FILENO);
  ::dup2(environment.one_output ? out : err, STDERR_FILENO);
}

}  // namespace

nlohmann::json Outcome::json() const {
  return nlohmann::json::parse(out, nullptr, false);
}

Program::Program(const std::vector<std::string>& command, const Environment& environment)
    : out_(::memfd_create("out", MFD_CLOEXEC)), err_(::memfd_create("err", MFD_CLOEXEC)) {
  int ends[2] = {-1, -1};
  if (::pipe2(ends, O_CLOEXEC) != 0) {
    std::abort();
  }
  // Appending, or several programs that print at once would overwrite each other.
  for (const int file : {out_, err_}) {
    ::fcntl(file, F_SETFL, O_APPEND);
  }
  pid_ = ::fork();
  if (pid_ == 0) {
    connect(ends[0], out_, err_, environment);
    become(command, environment);
  }
  ::close(ends[0]);
  in_ = ends[1];
}

Program::~Program() {
  kill();
  for (const int file : {in_, out_, err_}) {
    ::close(file);
  }
}

bool Program::running() {
  ended_ = ended_ || ::waitpid(pid_, &status_, WNOHANG) == pid_;
  return !ended_;
}

void Program::signal(int number) const {
  if (!ended_) {
    ::kill(pid_, number);
  }
}

void Program::kill() {
  if (!ended_) {
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, &status_, 0);
    ended_ = true;
  }
}

int Program::wait(std::chrono::milliseconds patience) {
  if (!wait_until([this] { return !running(); }, patience)) {
    return -1;
  }
  return WIFEXITED(status_) ? WEXITSTATUS(status_) : 128 + WTERMSIG(status_);
}

Outcome Program::finish() {
  ::close(std::exchange(in_, -1));
  const int code = wait(2 * kPatience);
  kill();
  return {code, out(), err()};
}

void Program::input(const std::string& text) const {
  [[maybe_unused]] const ssize_t n = ::write(in_, text.data(), text.size());
}

std::string Program::contents(int file) {
  std::string text;
  char part[8192];
  for (off_t at = 0;;) {
    const ssize_t n = ::pread(file, part, sizeof part, at);
    if (n <= 0) {
      return text;
    }
    text.append(part, static_cast<std::size_t>(n));
    at += n;
  }
}

bool Program::prints(const std::string& text) {
  return wait_until([&] { return out().find(text) != std::string::npos || !running(); }) &&
         out().find(text) != std::string::npos;
}

bool Program::says(const std::string& text) {
  return wait_until([&] { return err().find(text) != std::string::npos || !running(); }) &&
         err().find(text) != std::string::npos;
}

bool alive(pid_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
  std::stringstream text;
  text << file.rdbuf();
  const std::string stat = text.str();
  const auto end = stat.rfind(')');
  return end != std::string::npos && end + 2 < stat.size() && stat[end + 2] != 'Z' && stat[end + 2] != 'X';
}

pid_t dead_pid() {
  const pid_t pid = ::fork();
  if (pid == 0) {
    ::_exit(0);
  }
  ::waitpid(pid, nullptr, 0);
  return pid;
}

namespace {

// What is made private; who is not root becomes this user and group in a user namespace.
bool make_own(int what, const std::string& user, const std::string& group) {
  if (::geteuid() == 0) {
    return ::unshare(what) == 0;
  }
  const std::string users = user + " " + std::to_string(::getuid()) + " 1";
  const std::string groups = group + " " + std::to_string(::getgid()) + " 1";
  return ::unshare(CLONE_NEWUSER | what) == 0 && write_file("/proc/self/setgroups", "deny") &&
         write_file("/proc/self/uid_map", users) && write_file("/proc/self/gid_map", groups);
}

}  // namespace

bool own_mounts() {
  return make_own(CLONE_NEWNS, std::to_string(::getuid()), std::to_string(::getgid()));
}

bool own_network() {
  return make_own(CLONE_NEWNET, "0", "0");
}

bool mount_small(const std::string& folder, const std::string& size) {
  return own_mounts() && ::mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
         ::mount("tmpfs", folder.c_str(), "tmpfs", MS_NOSUID | MS_NODEV, ("size=" + size + ",mode=1777").c_str()) == 0;
}

}  // namespace indurop::test
