// SPDX-License-Identifier: Apache-2.0
// Reports what a simulation cannot repeat, from the system functions that modules use and from the writers of their
// variables.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <span>
#include <string_view>

#include "config/check/check_parts.h"
#include "config/check/determinism.h"
#include "core/base/text.h"

namespace indurop::config {
namespace {

constexpr std::size_t kShownVariables = 4;

struct Symbol {
  std::string_view name;  // a whole name, or a prefix with a * at the end
  std::string_view shown;
};
struct Source {
  std::string_view what;
  std::span<const Symbol> symbols;
};

constexpr std::array kTime{Symbol{"clock_gettime", "clock_gettime"},
                           Symbol{"gettimeofday", "gettimeofday"},
                           Symbol{"time", "time"},
                           Symbol{"clock", "clock"},
                           Symbol{"timespec_get", "timespec_get"},
                           Symbol{"_ZNSt6chrono3_V212steady_clock3nowEv", "std::chrono::steady_clock"},
                           Symbol{"_ZNSt6chrono3_V212system_clock3nowEv", "std::chrono::system_clock"}};
constexpr std::array kWaiting{Symbol{"nanosleep", "nanosleep"}, Symbol{"clock_nanosleep", "clock_nanosleep"},
                              Symbol{"usleep", "usleep"},       Symbol{"sleep", "sleep"},
                              Symbol{"poll", "poll"},           Symbol{"ppoll", "ppoll"},
                              Symbol{"select", "select"},       Symbol{"epoll_wait", "epoll_wait"}};
constexpr std::array kRandom{Symbol{"rand", "rand"},
                             Symbol{"random", "random"},
                             Symbol{"drand48", "drand48"},
                             Symbol{"getrandom", "getrandom"},
                             Symbol{"getentropy", "getentropy"},
                             Symbol{"arc4random*", "arc4random"},
                             Symbol{"_ZNSt13random_device*", "std::random_device"}};
constexpr std::array kIds{Symbol{"getpid", "getpid"}, Symbol{"getppid", "getppid"}, Symbol{"gettid", "gettid"}};
constexpr std::array kNetwork{Symbol{"socket", "socket"},   Symbol{"recv", "recv"},     Symbol{"recvfrom", "recvfrom"},
                              Symbol{"recvmsg", "recvmsg"}, Symbol{"accept", "accept"}, Symbol{"accept4", "accept4"}};
constexpr std::array kFiles{Symbol{"open", "open"},
                            Symbol{"open64", "open"},
                            Symbol{"openat", "openat"},
                            Symbol{"read", "read"},
                            Symbol{"pread", "pread"},
                            Symbol{"pread64", "pread"},
                            Symbol{"fopen", "fopen"},
                            Symbol{"fopen64", "fopen"},
                            Symbol{"ioctl", "ioctl"},
                            Symbol{"shm_open", "shm_open"},
                            Symbol{"_ZNSt14basic_ifstream*", "std::ifstream"},
                            Symbol{"_ZNSt13basic_filebuf*", "std::fstream"}};
constexpr std::array kCalls{Symbol{"syscall", "syscall"}};
constexpr std::array kThreads{Symbol{"pthread_create", "pthread_create"},
                              Symbol{"thrd_create", "thrd_create"},
                              Symbol{"_ZNSt6thread15_M_start_thread*", "std::thread"},
                              Symbol{"fork", "fork"},
                              Symbol{"popen", "popen"},
                              Symbol{"system", "system"}};
constexpr std::array kSources{Source{"real time", kTime},
                              Source{"waiting in real time", kWaiting},
                              Source{"random numbers", kRandom},
                              Source{"numbers of processes", kIds},
                              Source{"the network", kNetwork},
                              Source{"files or devices", kFiles},
                              Source{"calls of the kernel", kCalls},
                              Source{"threads or processes of its own", kThreads}};

bool is(std::string_view import, std::string_view symbol) {
  return symbol.ends_with('*') ? import.starts_with(symbol.substr(0, symbol.size() - 1)) : import == symbol;
}

// Returns the variables that the module may write.
std::vector<std::string> written_by(const std::string& module, const std::vector<VariableUse>& uses) {
  std::vector<std::string> names;
  for (const VariableUse& use : uses) {
    if (std::find(use.writers.begin(), use.writers.end(), module) != use.writers.end()) {
      names.push_back(use.name);
    }
  }
  return names;
}

}  // namespace

std::vector<std::string> sources_of_chance(const std::vector<std::string>& imports) {
  std::vector<std::string> sources;
  for (const Source& source : kSources) {
    std::vector<std::string> found;
    for (const std::string& import : imports) {
      for (const Symbol& symbol : source.symbols) {
        if (is(import, symbol.name) && std::find(found.begin(), found.end(), symbol.shown) == found.end()) {
          found.emplace_back(symbol.shown);
        }
      }
    }
    if (!found.empty()) {
      sources.push_back(fmt::format("{} ({})", source.what, fmt::join(found, ", ")));
    }
  }
  return sources;
}

bool talks_to_others(const std::vector<std::string>& imports) {
  constexpr Symbol kModbus{"modbus_*", "modbus"};
  return std::any_of(imports.begin(), imports.end(), [&](const std::string& import) {
    return is(import, kModbus.name) ||
           std::any_of(kNetwork.begin(), kNetwork.end(), [&](const Symbol& symbol) { return is(import, symbol.name); });
  });
}

void check_determinism(CheckContext& context) {
  const CheckResult& result = context.result;
  for (std::size_t i = 0; i < context.config.modules.size() && i < result.facts.size(); ++i) {
    const Module& module = context.config.modules[i];
    const std::string as_it_likes = module.operation == scheduler::Operation::NonReal && module.period.count() == 0
                                        ? "it runs outside the schedule, at any time"
                                        : "";
    std::vector<std::string> reasons = sources_of_chance(result.facts[i].file.imports);
    if (!reasons.empty()) {
      reasons = {"it uses " + base::enumerate(reasons)};
    }
    if (!as_it_likes.empty()) {
      reasons.insert(reasons.begin(), as_it_likes);
    }
    if (reasons.empty()) {
      continue;
    }
    const std::vector<std::string> written = written_by(module.name, result.uses);
    context.report.note(
        module.places.file,
        fmt::format("module {}: {}; {} may differ from run to run in a simulation{}", module.name,
                    base::enumerate(reasons),
                    written.empty() ? "what it does" : base::enumerate(written, kShownVariables),
                    reasons.back().find("real time (") != std::string::npos ? "; irp::now_ns() is virtual time" : ""));
  }
}

}  // namespace indurop::config
