// SPDX-License-Identifier: Apache-2.0
// The kernel's counters for the threads of a node, in a file of shared memory: the node reads its counters several
// times a second and records what is unusual. Not for the real-time path.

#pragma once

#include <indurop/result.h>

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "history/explain/facts.h"
#include "store/vars/shm_file.h"

namespace indurop::explain {

inline constexpr std::uint64_t kKernelMagic = 0x314e52454b444e49ULL;  // "INDKERN1"
inline constexpr std::uint32_t kKernelEntries = 1024;

// Ring buffer, the newest entry overwrites the oldest.
struct KernelEntry {
  std::atomic<std::uint64_t> sequence;  // entry number + 1, stored last; 0 while being written
  std::int64_t from_ns;
  std::int64_t to_ns;
  std::int64_t waited_ns;
  std::int64_t stolen_ns;
  std::uint64_t major_faults;
  std::int32_t core;
  char thread[20];
};

struct KernelLog {
  std::atomic<std::uint64_t> magic;  // stored last
  std::atomic<std::int64_t> from_ns;
  std::atomic<std::int64_t> to_ns;
  std::atomic<std::uint64_t> next;
  KernelEntry entries[kKernelEntries];
};

std::string kernel_file(const std::string& node);

class KernelSampler {
 public:
  // Creates the file. `process`: the folder of the node's process, "/proc/self". Errors: those of a ShmFile.
  static Result<KernelSampler> begin(const std::string& node, std::filesystem::path process, bool realtime);
  // Records what was counted since the last call.
  void sample(std::int64_t now_ns);

 private:
  struct Counted {
    std::int64_t waited_ns = 0;
    std::uint64_t major_faults = 0;
    std::int32_t core = -1;
    bool matters = false;  // the thread runs modules, or releases them
    std::string name;
  };
  KernelSampler(vars::ShmFile file, std::filesystem::path process, bool realtime);
  [[nodiscard]] std::map<int, Counted> threads() const;
  void note(const KernelFact& fact);
  [[nodiscard]] KernelLog& log() noexcept;

  vars::ShmFile file_;
  std::filesystem::path process_;
  bool realtime_;
  std::map<int, Counted> before_;
  std::map<int, std::int64_t> stolen_before_;  // by core
  std::int64_t sampled_ns_ = 0;
};

// Adds the content of the file, if there is one.
void add_kernel(const std::string& node, Facts& facts);

}  // namespace indurop::explain
