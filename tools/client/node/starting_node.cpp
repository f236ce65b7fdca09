// SPDX-License-Identifier: Apache-2.0
#include "tools/client/node/starting_node.h"

#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <charconv>
#include <cstddef>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "store/vars/node_lock.h"
#include "store/vars/process.h"
#include "store/vars/store.h"
#include "tools/client/node/run_view.h"

namespace indurop::tools {
namespace {

constexpr double kPatienceSeconds = 2;

// Returns the begin of a file. A process may end between two calls: then the text is empty, without an exception of a
// stream's buffer.
std::string text_of(const std::filesystem::path& file) {
  constexpr std::size_t kMaxBytes = 4096;
  std::string text(kMaxBytes, '\0');
  std::ifstream stream(file);
  stream.read(text.data(), kMaxBytes);
  text.resize(static_cast<std::size_t>(stream.gcount()));
  return text;
}

// Returns true for a node, or for `indurop run` that is about to become one.
bool becomes_node(const std::filesystem::path& process) {
  const std::string name = text_of(process / "comm");
  if (name == "indurop-node\n") {
    return true;
  }
  // Arguments end with NUL.
  return name == "indurop\n" && text_of(process / "cmdline").find(std::string_view("\0run\0", 5)) != std::string::npos;
}

// Returns true if the process has the same /dev/shm (mount namespace) and belongs to this user or root. Processes of
// other users are not waited for: they could be named like a node only to delay this program.
bool sees_our_files(const std::filesystem::path& process) {
  struct stat info {};
  if (::stat(process.c_str(), &info) != 0 || (info.st_uid != ::geteuid() && info.st_uid != 0)) {
    return false;
  }
  std::error_code error;
  const auto theirs = std::filesystem::read_symlink(process / "ns/mnt", error);
  return !error && theirs == std::filesystem::read_symlink("/proc/self/ns/mnt", error);
}

// Returns true if it is a node whose modules run.
bool runs_already(pid_t pid) {
  for (const std::string& node : vars::list_nodes()) {
    if (vars::running_node(node) == pid) {
      const auto run = RunView::open(node);
      return run.ok() && run->block().state.load(std::memory_order_relaxed) != scheduler::NodeState::Starting;
    }
  }
  return false;
}

double age_in_seconds(pid_t pid) {
  timespec now{};
  ::clock_gettime(CLOCK_BOOTTIME, &now);
  const double up = static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  return up - static_cast<double>(vars::process_start_time(pid)) / static_cast<double>(::sysconf(_SC_CLK_TCK));
}

}  // namespace

bool node_is_starting() {
  std::error_code error;
  for (std::filesystem::directory_iterator entry("/proc", error), end_of_all; entry != end_of_all && !error;
       entry.increment(error)) {
    const std::string name = entry->path().filename();
    pid_t pid = 0;
    const auto [end, problem] = std::from_chars(name.data(), name.data() + name.size(), pid);
    if (problem == std::errc() && *end == '\0' && pid != ::getpid() && age_in_seconds(pid) < kPatienceSeconds &&
        becomes_node(entry->path()) && sees_our_files(entry->path()) && !runs_already(pid)) {
      return true;
    }
  }
  return false;
}

}  // namespace indurop::tools
