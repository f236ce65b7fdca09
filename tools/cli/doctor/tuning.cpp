// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/doctor/tuning.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <set>

#include "core/base/descriptor.h"
#include "core/base/json.h"
#include "core/base/read_file.h"
#include "core/base/replace_file.h"
#include "core/rt/thread.h"

namespace indurop::tools {
namespace {

namespace fs = std::filesystem;

fs::path below(const fs::path& root, const std::string& file) {
  return root / fs::path(file).relative_path();
}

// Not base::read_file: files of the kernel have no size.
std::string setting_in(const fs::path& root, const std::string& file) {
  std::ifstream in(below(root, file));
  std::string line;
  std::getline(in, line);
  return line;
}

// Returns the word in brackets of "always [madvise] never".
std::string chosen(const std::string& line) {
  const std::size_t begin = line.find('[');
  const std::size_t end = line.find(']');
  return begin == std::string::npos || end == std::string::npos ? line : line.substr(begin + 1, end - begin - 1);
}

std::vector<std::string> folders(const fs::path& root, const std::string& in) {
  std::vector<std::string> found;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(below(root, in), error)) {
    found.push_back(in + "/" + entry.path().filename().string());
  }
  std::sort(found.begin(), found.end());
  return found;
}

// Returns all cores but this one as "0-2,4".
std::string all_but(int core, const std::vector<int>& cores) {
  std::vector<int> others;
  std::copy_if(cores.begin(), cores.end(), std::back_inserter(others), [core](int one) { return one != core; });
  std::string text;
  for (std::size_t i = 0; i < others.size();) {
    std::size_t last = i;
    while (last + 1 < others.size() && others[last + 1] == others[last] + 1) {
      ++last;
    }
    text += (text.empty() ? "" : ",") +
            (last == i ? std::to_string(others[i]) : fmt::format("{}-{}", others[i], others[last]));
    i = last + 1;
  }
  return text;
}

// Returns a mask in the format of /proc: groups of eight digits, the highest first.
std::string mask_of_all_but(int core, const std::vector<int>& cores) {
  const int words = (cores.empty() ? 0 : cores.back()) / 32 + 1;
  std::vector<std::uint32_t> bits(static_cast<std::size_t>(words));
  for (const int one : cores) {
    if (one != core) {
      bits[static_cast<std::size_t>(one / 32)] |= 1U << static_cast<unsigned>(one % 32);
    }
  }
  std::string text = fmt::format("{:x}", bits.back());
  for (std::size_t i = bits.size() - 1; i-- > 0;) {
    text += fmt::format(",{:08x}", bits[i]);
  }
  return text;
}

bool same_mask(const std::string& one, const std::string& other) {
  const auto digits = [](std::string text) {
    std::erase(text, ',');
    text.erase(0, std::min(text.find_first_not_of('0'), text.size()));
    return text;
  };
  return digits(one) == digits(other);
}

class Examination {
 public:
  Examination(int core, const fs::path& root) : core_(core), root_(root), cores_(present_cores()) {}

  Tuning run() {
    for (const std::string& cpu : folders(root_, "/sys/devices/system/cpu")) {
      want(cpu + "/cpufreq/scaling_governor", "performance", "a core that slows down is late when it has to be quick");
    }
    want("/sys/kernel/mm/transparent_hugepage/enabled", "madvise",
         "making huge pages stops processes for milliseconds");
    want("/proc/sys/kernel/watchdog", "0", "it interrupts every core each few seconds");
    want("/proc/sys/vm/stat_interval", "120", "each core updates VM statistics every second");
    if (cores_.size() > 1) {
      keep_free();
    }
    check_machine();
    return std::move(tuning_);
  }

 private:
  // Cores of this machine, or of the copy of one.
  [[nodiscard]] std::vector<int> present_cores() const {
    std::vector<int> cores;
    for (const std::string& cpu : folders(root_, "/sys/devices/system/cpu")) {
      const std::string name = fs::path(cpu).filename();
      if (name.size() > 3 && name.starts_with("cpu") && name.find_first_not_of("0123456789", 3) == std::string::npos) {
        cores.push_back(std::stoi(name.substr(3)));
      }
    }
    std::sort(cores.begin(), cores.end());
    return cores;
  }

  void want(const std::string& file, const std::string& wanted, const std::string& why) {
    const std::string now = chosen(setting_in(root_, file));
    if (!now.empty() && now != wanted) {
      tuning_.settings.push_back({file, now, wanted, why});
    }
  }

  // Adds the settings that keep the node's core free of other work.
  void keep_free() {
    const std::string others = all_but(core_, cores_);
    const std::string mask = mask_of_all_but(core_, cores_);
    const auto want_mask = [&](const std::string& file, const std::string& why) {
      const std::string now = setting_in(root_, file);
      if (!now.empty() && !same_mask(now, mask)) {
        tuning_.settings.push_back({file, now, mask, why});
      }
    };
    want_mask("/proc/irq/default_smp_affinity", "new interrupts come to the other cores");
    want_mask("/sys/devices/virtual/workqueue/cpumask", "work that the kernel puts off is done on the other cores");
    for (const std::string& irq : folders(root_, "/proc/irq")) {
      const std::string file = irq + "/smp_affinity";
      const std::string now = setting_in(root_, file);
      // Only interrupts that can reach this core; those of other cores remain there.
      if (!now.empty() && reaches_core(now)) {
        tuning_.settings.push_back({file, now, mask, "device interrupts come to the other cores"});
      }
    }
    const std::string line = " " + setting_in(root_, "/proc/cmdline") + " ";
    for (const auto& [word, value] :
         {std::pair("isolcpus", fmt::format("managed_irq,domain,{}", core_)),
          std::pair("nohz_full", std::to_string(core_)), std::pair("rcu_nocbs", std::to_string(core_))}) {
      if (line.find(fmt::format(" {}=", word)) == std::string::npos) {
        tuning_.boot.push_back(fmt::format("{}={}", word, value));
      }
    }
  }

  [[nodiscard]] bool reaches_core(std::string mask) const {
    std::erase(mask, ',');
    const auto digit = static_cast<std::size_t>(core_ / 4);
    if (digit >= mask.size()) {
      return false;
    }
    const char c = mask[mask.size() - 1 - digit];
    const int value = c <= '9' ? c - '0' : (c | 0x20) - 'a' + 10;
    return (static_cast<unsigned>(value) >> static_cast<unsigned>(core_ % 4) & 1U) != 0;
  }

  void check_machine() {
    const std::string runtime = setting_in(root_, "/proc/sys/kernel/sched_rt_runtime_us");
    if (!runtime.empty() && runtime != "-1" && runtime.size() < 6) {
      tuning_.settings.push_back({"/proc/sys/kernel/sched_rt_runtime_us", runtime, "950000",
                                  "real-time threads are stopped after this many us of each second"});
    }
    std::ifstream swaps(below(root_, "/proc/swaps"));
    std::string line;
    std::getline(swaps, line);
    if (std::getline(swaps, line)) {
      tuning_.hints.emplace_back("swap is on: swapoff -a, and remove it from /etc/fstab");
    }
    if (const std::string profile = setting_in(root_, "/etc/tuned/active_profile");
        !profile.empty() && profile.find("realtime") == std::string::npos) {
      tuning_.hints.push_back(fmt::format(
          "tuned is active with profile {}, which may set things back: tuned-adm profile realtime", profile));
    }
  }

  int core_;
  const fs::path& root_;
  std::vector<int> cores_;
  Tuning tuning_;
};

// Returns why the kernel refused; empty: it accepted.
std::string write_setting(const fs::path& root, const std::string& file, const std::string& value) {
  const base::Descriptor out(::open(below(root, file).c_str(), O_WRONLY | O_CLOEXEC | O_TRUNC));
  if (out.get() < 0 || ::write(out.get(), value.data(), value.size()) != static_cast<ssize_t>(value.size())) {
    return fmt::format("{}: {}", file, std::strerror(errno));
  }
  return {};
}

std::string boot_of(const fs::path& root) {
  return setting_in(root, "/proc/sys/kernel/random/boot_id");
}

struct Kept {
  std::string file;
  std::string value;
};

// Returns the previous values recorded since this boot; empty without a record, or with one of an earlier boot.
std::vector<Kept> kept_in(const fs::path& record, const fs::path& root) {
  std::vector<Kept> kept;
  const auto text = base::read_file(record);
  const auto json = text ? base::Json::parse(*text) : std::nullopt;
  if (!json || (*json)["boot"].text() != boot_of(root)) {
    return kept;
  }
  for (const base::Json& one : (*json)["settings"].values()) {
    kept.push_back({one["file"].text().value_or(""), one["value"].text().value_or("")});
  }
  return kept;
}

}  // namespace

Tuning examine_tuning(int core, const fs::path& root) {
  return Examination(core, root).run();
}

Result<std::vector<std::string>, base::Problem> apply_tuning(const Tuning& tuning, const fs::path& record,
                                                             const fs::path& root) {
  std::vector<Kept> kept = kept_in(record, root);
  for (const Setting& setting : tuning.settings) {
    if (std::none_of(kept.begin(), kept.end(), [&](const Kept& one) { return one.file == setting.file; })) {
      kept.push_back({setting.file, setting.now});
    }
  }
  base::Json settings = base::Json::array();
  for (const Kept& one : kept) {
    settings.push_back({{"file", one.file}, {"value", one.value}});
  }
  const base::Json all{{"boot", boot_of(root)}, {"settings", settings}};
  std::error_code error;
  fs::create_directories(record.parent_path(), error);
  if (const auto saved = base::replace_file(record, all.dump(2) + "\n", base::Durable::Yes); !saved) {
    return base::Problem{base::cannot_write(record, saved.error()) + "; nothing was set"};
  }
  std::vector<std::string> refused;
  for (const Setting& setting : tuning.settings) {
    if (std::string problem = write_setting(root, setting.file, setting.wanted); !problem.empty()) {
      refused.push_back(std::move(problem));
    }
  }
  return refused;
}

Result<Undone, base::Problem> undo_tuning(const fs::path& record, const fs::path& root) {
  if (std::error_code error; !fs::exists(record, error)) {
    return base::Problem{
        fmt::format("there is no {}: nothing was set by indurop doctor tune --apply", record.string())};
  }
  const std::vector<Kept> kept = kept_in(record, root);
  Undone undone;
  for (auto one = kept.rbegin(); one != kept.rend(); ++one) {
    std::string problem = write_setting(root, one->file, one->value);
    if (problem.empty()) {
      ++undone.settings;
    } else {
      undone.refused.push_back(std::move(problem));
    }
  }
  std::error_code error;
  fs::remove(record, error);
  if (kept.empty()) {
    return base::Problem{"the machine was started since, so nothing is left of what was set"};
  }
  return undone;
}

}  // namespace indurop::tools
