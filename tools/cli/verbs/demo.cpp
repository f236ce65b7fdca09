// SPDX-License-Identifier: Apache-2.0
// indurop demo: runs a copy of a built example, with its script.
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/wait.h>

#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "core/base/descriptor.h"
#include "core/base/program_folder.h"
#include "core/base/spawn.h"
#include "core/base/temporary_folder.h"
#include "core/rt/clock.h"
#include "core/rt/thread.h"
#include "tools/cli/command/example_folder.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/client/process/interrupt.h"

namespace indurop::tools {
namespace {

namespace fs = std::filesystem;

constexpr std::uint16_t kModbusPort = 1502;  // of ioconfig.xml of the robot cell
constexpr std::int64_t kPollNs = 20'000'000;
constexpr std::int64_t kGraceNs = 20'000'000'000;  // the script ends its nodes, which end their processes

struct DemoOptions {
  std::string example;  // empty: the page
  fs::path folder;      // empty: a temporary one
};

// Examples write pictures and recordings next to their modules, so they run in a copy. Folders are what a build leaves
// there.
std::string copy_files(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::create_directories(to, error);
  if (error) {
    return fmt::format("cannot make {}: {}; name another one: indurop demo --folder DIR", to.string(), error.message());
  }
  for (fs::directory_iterator file(from, error), end; !error && file != end; file.increment(error)) {
    std::error_code failed;
    if (fs::is_regular_file(*file, failed)) {
      fs::copy_file(file->path(), to / file->path().filename(), fs::copy_options::overwrite_existing, failed);
    }
    if (failed) {
      return fmt::format("cannot copy {} to {}: {}", file->path().string(), to.string(), failed.message());
    }
  }
  return error ? fmt::format("cannot copy {} to {}: {}", from.string(), to.string(), error.message()) : "";
}

// What this user lacks for real time, and how to get it. The demo runs without it.
void report_rights(Context& context) {
  if (rt::set_fifo(1).ok()) {
    (void)rt::set_fifo(0);
    return;
  }
  std::error_code ignored;
  const bool group = fs::exists("/etc/security/limits.d/60-indurop.conf", ignored);
  context.out.note(fmt::format(
      "this user has no right to real time: the example keeps its order, not its times. {}; indurop doctor says more",
      group ? "To have it: sudo adduser $USER indurop, then log in again; or run this as root"
            : "To have it: run this as root, or allow rtprio and memlock in /etc/security/limits.d"));
}

// Returns what is wrong with this port of the host; empty if a program can listen on it.
std::string port_problem(std::uint16_t port) {
  const base::Descriptor tried(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  const int on = 1;
  sockaddr_in at{};
  at.sin_family = AF_INET;
  at.sin_port = htons(port);
  at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (tried.get() >= 0 && ::setsockopt(tried.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on) == 0 &&
      ::bind(tried.get(), reinterpret_cast<const sockaddr*>(&at), sizeof at) == 0) {
    return {};
  }
  return fmt::format(
      "its field devices cannot listen on TCP port {} of this host: {}; if another robot cell runs here, end it first",
      port, std::strerror(errno));  // NOLINT(concurrency-mt-unsafe): there is one thread
}

void set_environment(const fs::path& programs, const fs::path& folder, bool temporary) {
  const char* const path = std::getenv("PATH");  // NOLINT(concurrency-mt-unsafe): there is one thread
  const std::string searched = programs.string() + (path == nullptr ? "" : std::string(":") + path);
  ::setenv("PATH", searched.c_str(), 1);                           // NOLINT(concurrency-mt-unsafe): likewise
  ::setenv("INDUROP_DEMO_DIR", folder.string().c_str(), 1);        // NOLINT(concurrency-mt-unsafe): likewise
  if (temporary) {                                                 // what the nodes keep goes with the folder
    ::setenv("INDUROP_STATE_DIR", (folder / "state").c_str(), 1);  // NOLINT(concurrency-mt-unsafe): likewise
  }
}

// The exit code of `child`. Ctrl-C reaches the script as it reaches us, SIGTERM through us; it then ends what it has
// started.
int wait_for(Context& context, pid_t child) {
  std::optional<std::int64_t> deadline;
  int status = 0;
  while (true) {
    const pid_t ended = ::waitpid(child, &status, WNOHANG);
    if (ended == child) {
      return interrupted() ? interrupt_code() : base::exit_code_of(status);
    }
    if (ended < 0 && errno != EINTR) {
      context.out.error(fmt::format("lost the example: {}", std::strerror(errno)));
      return kFailed;
    }
    if (interrupted() && !deadline) {
      deadline = rt::now_ns() + kGraceNs;
      ::kill(child, SIGTERM);
    }
    if (deadline && rt::now_ns() > *deadline) {
      context.out.error("the example did not end within 20 s and was killed");
      ::kill(child, SIGKILL);
    }
    rt::sleep_until(rt::now_ns() + kPollNs);
  }
}

int run_script(Context& context, const fs::path& folder, bool page) {
  std::vector<std::string> words{"sh", (folder / "demo.sh").string()};
  if (page) {
    words.emplace_back("page");
  }
  context.out.flush();
  const auto child =
      base::spawn({.words = std::move(words), .program = {}, .fresh_signals = true, .ends_with_us = SIGTERM});
  if (!child) {
    context.out.error(fmt::format("cannot start sh: {}", std::strerror(child.error().sys_errno)));
    return kFailed;
  }
  return wait_for(context, *child);
}

int demo(Context& context, const DemoOptions& options) {
  const bool page = options.example.empty();
  const std::string name = page ? "robot_cell" : options.example;
  const fs::path programs = base::program_folder();
  const fs::path example = example_folder(programs, name);
  if (example.empty()) {
    context.out.error(fmt::format(
        "the built example {} does not come with this program: install the package indurop-examples, or in the source "
        "tree: make demo",
        name));
    return kFailed;
  }
  if (name == "robot_cell") {
    if (const std::string problem = port_problem(kModbusPort); !problem.empty()) {
      context.out.error(problem);
      return kFailed;
    }
  }
  std::optional<base::TemporaryFolder> temporary;
  if (options.folder.empty()) {
    temporary.emplace();
    if (temporary->path().empty()) {
      context.out.error("cannot make a temporary folder; name one that may be written: indurop demo --folder DIR");
      return kFailed;
    }
  }
  std::error_code ignored;
  const fs::path folder = temporary ? temporary->path() : fs::absolute(options.folder, ignored);
  if (const std::string problem = copy_files(example, folder); !problem.empty()) {
    context.out.error(problem);
    return kFailed;
  }
  report_rights(context);
  set_environment(programs, folder, temporary.has_value());
  return run_script(context, folder, page);
}

Action declare_demo(base::Options& app, Context& /*context*/) {
  auto options = std::make_shared<DemoOptions>();
  app.add("example", "EXAMPLE", options->example,
          "chapter, two_boards or robot_cell: what it shows, step by step (default: the robot cell and its page)")
      .choices({"chapter", "two_boards", "robot_cell"});
  app.add("--folder", "DIR", options->folder, "Run there and keep its files, pictures and recordings")
      .completes(base::Completion::Folder);
  return [options](Context& c) { return demo(c, *options); };
}

}  // namespace

const Verb kDemoVerb{
    "demo", "Before it runs", "Run a built example: a robot cell and its page, the chapter's modules, a plant",
    "Needs no compiler and no special privileges. The demo runs in a temporary copy of the example, which is\n"
    "removed on Ctrl-C. Without EXAMPLE, the robot cell runs until Ctrl-C, and the address of its page is\n"
    "printed.\n"
    "Examples:\n"
    "  indurop demo\n"
    "  indurop demo two_boards\n"
    "  indurop demo robot_cell --folder cell\n",
    &declare_demo};

}  // namespace indurop::tools
