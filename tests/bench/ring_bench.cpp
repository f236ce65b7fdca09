// SPDX-License-Identifier: Apache-2.0
// A ring of boards on this host: `ring_bench DOMAIN BOARDS SECONDS`. Each board is a process with a store and a mirror,
// and reads one variable of the board before it. Prints one line of JSON: how long after the first process was started
// every board had discovered every other one and had the value it reads, the processor time and the datagrams that
// took, and the same for SECONDS of rest. Datagrams are counted for the whole network namespace.

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "core/rt/clock.h"
#include "network/mirror/frames/mirror.h"
#include "network/mirror/frames/mirror_block.h"
#include "store/vars/shm_file.h"
#include "store/vars/store.h"

namespace {

using namespace indurop;  // NOLINT

constexpr std::int64_t kLookNs = 20'000'000;
constexpr std::int64_t kPatienceNs = 15'000'000'000;

std::string board_name(int number) {
  return "b" + std::to_string(number);
}

std::string node_name(int number) {
  return "ring" + std::to_string(::getpid()) + "-" + std::to_string(number);
}

std::string variable_name(int number) {
  return "ring::v" + std::to_string(number);
}

schema::Schema make_schema(int count) {
  schema::Schema schema;
  for (int i = 0; i < count; ++i) {
    schema::Variable v;
    v.name = variable_name(i);
    v.type.base = schema::Base::Int64;
    v.type.element_size = v.type.align = 8;
    v.kind = abi::Kind::Scalar;
    v.type_hash = schema::hash_of(v.type);
    schema.variables.push_back(v);
  }
  return schema;
}

// Runs until SIGTERM.
[[noreturn]] void run_board(const std::string& node, int domain, int number, int count) {
  mirror::Settings settings;
  settings.plant = "ring";
  settings.network.board = board_name(number);
  settings.network.domain = domain;
  settings.network.one_host = true;
  settings.network.others = static_cast<std::size_t>(count - 1);
  for (int other = 0; other < count; ++other) {
    if (other != number) {
      settings.boards.push_back(board_name(other));
    }
  }
  const int before = (number + count - 1) % count;
  settings.routes.outgoing.push_back({variable_name(number)});
  settings.routes.incoming.push_back({variable_name(before), board_name(before)});
  sigset_t stop;
  sigemptyset(&stop);
  sigaddset(&stop, SIGTERM);
  sigprocmask(SIG_BLOCK, &stop, nullptr);
  auto store = vars::Store::create(node, make_schema(count));
  if (!store) {
    std::fprintf(stderr, "store: %s\n", store.error().where);
    std::_Exit(1);
  }
  const std::atomic<std::uint64_t> tick{1};
  {
    auto mirror = mirror::Mirror::start(settings, node, store.value(), tick);
    int signal = 0;
    (void)sigwait(&stop, &signal);
  }
  std::_Exit(0);
}

struct Board {
  std::string node;
  pid_t pid = 0;
  std::vector<vars::ShmFile> file;  // one when it is there

  // Returns whether it has discovered every other board and has received the value it reads.
  bool complete() {
    if (file.empty()) {
      auto opened = vars::ShmFile::open(vars::mirror_file(node), vars::Mode::ReadOnly);
      if (!opened) {
        return false;
      }
      file.push_back(std::move(opened).value());
    }
    const mirror::MirrorBlock* block = mirror::mirror_block_in({file[0].data(), file[0].size()});
    if (block == nullptr) {
      return false;
    }
    return std::all_of(block->peers(), block->peers() + block->peer_count, [](const mirror::PeerRecord& peer) {
      return peer.state.load() == mirror::PeerState::Alive && (peer.wanted == 0 || peer.frames.load() > 0);
    });
  }
  // Processor time of the process until now.
  [[nodiscard]] double cpu_seconds() const {
    std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
    std::string text;
    std::getline(stat, text);
    std::istringstream fields(text.substr(text.rfind(')') + 2));
    std::string field;
    long ticks = 0;
    for (int i = 3; i <= 15 && fields >> field; ++i) {
      ticks += i >= 14 ? std::atol(field.c_str()) : 0;  // utime and stime, see proc(5)
    }
    return static_cast<double>(ticks) / static_cast<double>(::sysconf(_SC_CLK_TCK));
  }
};

struct Figures {
  std::int64_t ns = 0;
  double cpu = 0;
  std::uint64_t datagrams = 0;
};

// The numbers of datagrams sent in this network namespace until now.
std::uint64_t datagrams_sent() {
  std::ifstream snmp("/proc/net/snmp");
  std::string line;
  std::uint64_t sent = 0;
  while (std::getline(snmp, line)) {
    (void)std::sscanf(line.c_str(), "Udp: %*u %*u %*u %lu", &sent);
  }
  return sent;
}

Figures figures(const std::vector<Board>& boards) {
  Figures now{rt::now_ns(), 0, datagrams_sent()};
  for (const Board& board : boards) {
    now.cpu += board.cpu_seconds();
  }
  return now;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4 || std::atoi(argv[2]) < 2) {
    std::fprintf(stderr, "usage: ring_bench DOMAIN BOARDS SECONDS\n");
    return 2;
  }
  const int count = std::atoi(argv[2]);
  std::vector<Board> boards(static_cast<std::size_t>(count));
  const Figures start = figures({});
  for (int i = 0; i < count; ++i) {
    Board& board = boards[static_cast<std::size_t>(i)];
    board.node = node_name(i);
    board.pid = ::fork();
    if (board.pid == 0) {
      run_board(board.node, std::atoi(argv[1]), i, count);
    }
  }
  bool complete = false;
  while (!complete && rt::now_ns() - start.ns < kPatienceNs) {
    rt::sleep_until(rt::now_ns() + kLookNs);
    complete = std::all_of(boards.begin(), boards.end(), [](Board& board) { return board.complete(); });
  }
  const Figures seen = figures(boards);
  rt::sleep_until(rt::now_ns() + static_cast<std::int64_t>(std::atof(argv[3]) * 1e9));
  const Figures end = figures(boards);
  for (const Board& board : boards) {
    ::kill(board.pid, SIGTERM);
  }
  while (::wait(nullptr) > 0) {
  }
  for (const Board& board : boards) {
    (void)vars::remove_node(board.node);
  }
  const double rest = static_cast<double>(end.ns - seen.ns) * 1e-9;
  std::printf(
      "{\"boards\": %d, \"complete\": %s, \"s\": %.3f, \"cpu_s\": %.2f, \"datagrams\": %llu, \"rest_cores\": %.3f, "
      "\"rest_datagrams_per_s\": %.0f}\n",
      count, complete ? "true" : "false", static_cast<double>(seen.ns - start.ns) * 1e-9, seen.cpu,
      static_cast<unsigned long long>(seen.datagrams - start.datagrams), (end.cpu - seen.cpu) / std::max(rest, 1e-9),
      static_cast<double>(end.datagrams - seen.datagrams) / std::max(rest, 1e-9));
  return complete ? 0 : 1;
}
