// SPDX-License-Identifier: Apache-2.0
#include "sandbox.h"

#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fstream>

namespace indurop::test {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

bool write_file(const char* path, const std::string& text) {
  std::ofstream file(path);
  return static_cast<bool>(file << text << std::flush);
}

bool private_mounts() {
  if (geteuid() == 0 && unshare(CLONE_NEWNS) == 0) {
    return true;
  }
  const std::string user = std::to_string(getuid());
  const std::string group = std::to_string(getgid());
  return unshare(CLONE_NEWUSER | CLONE_NEWNS) == 0 && write_file("/proc/self/setgroups", "deny") &&
         write_file("/proc/self/uid_map", user + " " + user + " 1") &&
         write_file("/proc/self/gid_map", group + " " + group + " 1");
}

int code_of(int status) {
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

struct Pipe {
  int read = -1;
  int write = -1;
  Pipe() {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) == 0) {
      read = ends[0];
      write = ends[1];
    }
  }
};

[[noreturn]] void become(const std::vector<std::string>& command, const std::vector<std::string>& environment,
                         uid_t user) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  ::signal(SIGPIPE, SIG_DFL);
  unsetenv("INDUROP_NODE");
  unsetenv("NO_COLOR");
  setenv("LC_ALL", "C.UTF-8", 1);
  setenv("INDUROP_STATE_DIR", (scratch() / "state").c_str(), 1);
  for (const std::string& entry : environment) {
    putenv(strdup(entry.c_str()));
  }
  if (user != static_cast<uid_t>(-1) && (setgid(user) != 0 || setuid(user) != 0)) {
    _exit(127);
  }
  std::vector<char*> raw;
  for (const std::string& word : command) {
    raw.push_back(const_cast<char*>(word.c_str()));
  }
  raw.push_back(nullptr);
  execv(raw[0], raw.data());
  _exit(127);
}

void feed(int file, const std::string& text) {
  [[maybe_unused]] const ssize_t n = ::write(file, text.data(), text.size());
  close(file);
}

// Reads both until they are closed or time is up.
bool drain(int out, int err, Outcome& to, Clock::time_point deadline) {
  pollfd files[2] = {{out, POLLIN, 0}, {err, POLLIN, 0}};
  std::string* texts[2] = {&to.out, &to.err};
  while (files[0].fd >= 0 || files[1].fd >= 0) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
    if (left <= 0 || poll(files, 2, static_cast<int>(left)) < 0) {
      return false;
    }
    for (int i = 0; i < 2; ++i) {
      char bytes[4096];
      if (files[i].fd >= 0 && files[i].revents != 0) {
        const ssize_t n = ::read(files[i].fd, bytes, sizeof bytes);
        if (n > 0) {
          texts[i]->append(bytes, static_cast<std::size_t>(n));
        } else {
          files[i].fd = -1;
        }
      }
    }
  }
  return true;
}

struct Scratch {
  fs::path path = fs::temp_directory_path() / ("indurop_cli_test." + std::to_string(getpid()));
  pid_t owner = getpid();
  Scratch() { fs::create_directories(path); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch() {
    if (getpid() == owner) {
      std::error_code error;
      fs::remove_all(path, error);
    }
  }
};

}  // namespace

bool enter_sandbox() {
  static const bool kPrivate = private_mounts() && mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0;
  return kPrivate && mount("tmpfs", "/dev/shm", "tmpfs", MS_NOSUID | MS_NODEV, "size=64m,mode=1777") == 0;
}

fs::path scratch() {
  static const Scratch kScratch;
  return kScratch.path;
}

std::vector<std::string> indurop_command(const std::vector<std::string>& arguments) {
  std::vector<std::string> command{INDUROP_PROGRAM};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return command;
}

std::vector<std::string> fake_node(const std::string& name, const std::vector<std::string>& more) {
  std::vector<std::string> command{FAKE_NODE_PROGRAM, name};
  command.insert(command.end(), more.begin(), more.end());
  return command;
}

Outcome indurop(const std::vector<std::string>& arguments, const RunOptions& options) {
  scratch();
  const Pipe in;
  const Pipe out;
  const Pipe err;
  const pid_t pid = fork();
  if (pid == 0) {
    const int target =
        options.stdout_to.empty() ? out.write : open(options.stdout_to.c_str(), O_WRONLY | O_CREAT, 0600);
    dup2(in.read, STDIN_FILENO);
    dup2(target, STDOUT_FILENO);
    dup2(err.write, STDERR_FILENO);
    become(indurop_command(arguments), options.environment, options.user);
  }
  for (const int file : {in.read, out.write, err.write}) {
    close(file);
  }
  feed(in.write, options.input);
  Outcome outcome;
  const bool ended = drain(out.read, err.read, outcome, Clock::now() + std::chrono::seconds(options.seconds));
  close(out.read);
  close(err.read);
  if (!ended) {
    kill(pid, SIGKILL);
  }
  int status = 0;
  waitpid(pid, &status, 0);
  outcome.code = ended ? code_of(status) : -1;
  return outcome;
}

Background::Background(const std::vector<std::string>& command, const std::vector<std::string>& environment) {
  scratch();
  const Pipe out;
  pid_ = fork();
  if (pid_ == 0) {
    dup2(out.write, STDOUT_FILENO);
    dup2(out.write, STDERR_FILENO);
    become(command, environment, static_cast<uid_t>(-1));
  }
  close(out.write);
  pipe_ = out.read;
}

Background::~Background() {
  if (pid_ > 0) {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  close(pipe_);
}

bool Background::read_more(int timeout_ms) {
  pollfd file{pipe_, POLLIN, 0};
  char bytes[4096];
  if (poll(&file, 1, timeout_ms) <= 0) {
    return false;
  }
  const ssize_t n = ::read(pipe_, bytes, sizeof bytes);
  if (n > 0) {
    output_.append(bytes, static_cast<std::size_t>(n));
  }
  return n > 0;
}

bool Background::wait_for(const std::string& text) {
  const auto deadline = Clock::now() + std::chrono::seconds(10);
  while (output_.find(text) == std::string::npos) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
    if (left <= 0 || !read_more(static_cast<int>(left))) {
      return output_.find(text) != std::string::npos;
    }
  }
  return true;
}

void Background::signal(int number) const {
  kill(pid_, number);
}

int Background::wait() {
  const auto deadline = Clock::now() + std::chrono::seconds(10);
  while (Clock::now() < deadline) {
    int status = 0;
    if (waitpid(pid_, &status, WNOHANG) == pid_) {
      while (read_more(0)) {
      }
      pid_ = -1;
      return code_of(status);
    }
    if (!read_more(10)) {
      usleep(1000);
    }
  }
  return -1;
}

}  // namespace indurop::test
