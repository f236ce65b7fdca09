// SPDX-License-Identifier: Apache-2.0
#include "history/explain/kernel_log.h"

#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>

#include "core/base/read_file.h"

namespace indurop::explain {
namespace {

constexpr std::int64_t kWorthNoting = 20'000;  // ns
// Fields in /proc/PID/stat, counted after the name of the program.
constexpr std::size_t kMajorFaults = 9;
constexpr std::size_t kProcessor = 36;
constexpr std::size_t kRealtimePriority = 37;

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> words;
  for (std::string word; in >> word;) {
    words.push_back(word);
  }
  return words;
}

template <class T>
T number_in(const std::vector<std::string>& words, std::size_t place) {
  T value{};
  if (place < words.size()) {
    std::from_chars(words[place].data(), words[place].data() + words[place].size(), value);
  }
  return value;
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

// The time that the hypervisor took from each core.
std::map<int, std::int64_t> stolen() {
  constexpr std::size_t kSteal = 8;
  static const std::int64_t kUnitNs = 1'000'000'000 / std::max<long>(::sysconf(_SC_CLK_TCK), 1);
  std::map<int, std::int64_t> out;
  std::istringstream lines(text_of("/proc/stat"));
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("cpu") && line.size() > 3 && line[3] != ' ') {
      const auto words = words_of(line.substr(3));
      out[number_in<int>(words, 0)] = number_in<std::int64_t>(words, kSteal) * kUnitNs;
    }
  }
  return out;
}

}  // namespace

std::string kernel_file(const std::string& node) {
  return vars::block_file(node) + ".kernel";
}

KernelSampler::KernelSampler(vars::ShmFile file, std::filesystem::path process, bool realtime)
    : file_(std::move(file)), process_(std::move(process)), realtime_(realtime) {}

KernelLog& KernelSampler::log() noexcept {
  return *reinterpret_cast<KernelLog*>(file_.data());
}

Result<KernelSampler> KernelSampler::begin(const std::string& node, std::filesystem::path process, bool realtime) {
  auto file = vars::ShmFile::create(kernel_file(node), sizeof(KernelLog));
  if (!file) {
    return file.error();
  }
  KernelSampler sample(std::move(file).value(), std::move(process), realtime);
  sample.log().magic.store(kKernelMagic, std::memory_order_release);
  if (const Status published = sample.file_.publish(); !published) {
    return published.error();
  }
  return sample;
}

std::map<int, KernelSampler::Counted> KernelSampler::threads() const {
  std::map<int, Counted> out;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(process_ / "task", error)) {
    const std::string stat = text_of(entry.path() / "stat");
    const auto name_begin = stat.find('(');
    const auto name_end = stat.rfind(')');
    if (name_begin == std::string::npos || name_end == std::string::npos) {
      continue;  // it has just ended
    }
    const auto words = words_of(stat.substr(name_end + 1));
    const auto schedule = words_of(text_of(entry.path() / "schedstat"));
    Counted counted;
    counted.name = stat.substr(name_begin + 1, name_end - name_begin - 1);
    counted.waited_ns = number_in<std::int64_t>(schedule, 1);
    counted.major_faults = number_in<std::uint64_t>(words, kMajorFaults);
    counted.core = number_in<std::int32_t>(words, kProcessor);
    const bool runs_modules = counted.name.starts_with("irp-tick") || counted.name.starts_with("irp-band");
    counted.matters = realtime_ ? number_in<int>(words, kRealtimePriority) > 0 : runs_modules;
    out[number_in<int>({entry.path().filename().string()}, 0)] = std::move(counted);
  }
  return out;
}

void KernelSampler::note(const KernelFact& fact) {
  const std::uint64_t number = log().next.load(std::memory_order_relaxed);
  KernelEntry& entry = log().entries[number % kKernelEntries];
  entry.sequence.store(0, std::memory_order_relaxed);
  std::atomic_thread_fence(std::memory_order_release);
  entry.from_ns = fact.from_ns;
  entry.to_ns = fact.to_ns;
  entry.waited_ns = fact.waited_ns;
  entry.stolen_ns = fact.stolen_ns;
  entry.major_faults = fact.major_faults;
  entry.core = fact.core;
  const std::size_t length = std::min(fact.thread.size(), sizeof entry.thread - 1);
  std::memcpy(entry.thread, fact.thread.data(), length);
  entry.thread[length] = '\0';
  entry.sequence.store(number + 1, std::memory_order_release);
  log().next.store(number + 1, std::memory_order_release);
}

void KernelSampler::sample(std::int64_t now_ns) {
  auto now = threads();
  auto stolen_now = stolen();
  if (sampled_ns_ == 0) {
    log().from_ns.store(now_ns);
  } else {
    for (const auto& [id, counted] : now) {
      const auto known = before_.find(id);
      const Counted none;
      const Counted& before = known == before_.end() ? none : known->second;
      const KernelFact fact{sampled_ns_,
                            now_ns,
                            counted.core,
                            counted.name,
                            0,
                            counted.waited_ns - before.waited_ns,
                            counted.major_faults - before.major_faults,
                            0};
      if (counted.matters && known != before_.end() && (fact.waited_ns >= kWorthNoting || fact.major_faults > 0)) {
        note(fact);
      }
    }
    for (const auto& [core, time] : stolen_now) {
      if (const std::int64_t more = time - stolen_before_[core]; more > 0) {
        note({sampled_ns_, now_ns, core, {}, 0, 0, 0, more});
      }
    }
  }
  before_ = std::move(now);
  stolen_before_ = std::move(stolen_now);
  sampled_ns_ = now_ns;
  log().to_ns.store(now_ns, std::memory_order_release);
}

void add_kernel(const std::string& node, Facts& facts) {
  const auto file = vars::ShmFile::open(kernel_file(node), vars::Mode::ReadOnly);
  if (!file || file->size() < sizeof(KernelLog)) {
    return;
  }
  const auto& log = *reinterpret_cast<const KernelLog*>(file->data());
  if (log.magic.load(std::memory_order_acquire) != kKernelMagic) {
    return;
  }
  facts.kernel_from_ns = log.from_ns.load();
  facts.kernel_to_ns = log.to_ns.load(std::memory_order_acquire);
  const std::uint64_t next = log.next.load(std::memory_order_acquire);
  for (std::uint64_t number = next > kKernelEntries ? next - kKernelEntries : 0; number < next; ++number) {
    const KernelEntry& entry = log.entries[number % kKernelEntries];
    const KernelFact fact{entry.from_ns,
                          entry.to_ns,
                          entry.core,
                          std::string(entry.thread, ::strnlen(entry.thread, sizeof entry.thread)),
                          0,
                          entry.waited_ns,
                          entry.major_faults,
                          entry.stolen_ns};
    if (entry.sequence.load(std::memory_order_acquire) == number + 1) {
      facts.kernel.push_back(fact);
    }
  }
  if (next > kKernelEntries && !facts.kernel.empty()) {
    facts.kernel_from_ns = std::max(facts.kernel_from_ns, facts.kernel.front().to_ns);
  }
}

}  // namespace indurop::explain
