// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/doctor/doctor_checks.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <ctime>
#include <fstream>
#include <map>

#include "core/rt/machine.h"
#include "core/rt/thread.h"
#include "store/vars/retain.h"
#include "store/vars/shm_file.h"
#include "tools/cli/doctor/first_line.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

namespace fs = std::filesystem;

Finding kernel() {
  utsname name{};
  uname(&name);
  const std::string release = fmt::format("Linux {}", name.release);
  if (rt::kernel_is_preempt_rt()) {
    return {"kernel", Grade::Ok, release + " with PREEMPT_RT", ""};
  }
  return {"kernel", Grade::Warn, release + " without PREEMPT_RT",
          "the kernel may delay a tick by milliseconds; install linux-image-rt-amd64 (or -arm64) and boot it"};
}

Finding clock_source(const fs::path& root) {
  const std::string name = first_line(root / "sys/devices/system/clocksource/clocksource0/current_clocksource");
  if (name.empty()) {
    return {"clock-source", Grade::Warn, "unknown", "cannot read /sys/devices/system/clocksource"};
  }
  const bool slow = name == "hpet" || name == "acpi_pm" || name == "jiffies" || name == "refined-jiffies";
  return {"clock-source", slow ? Grade::Warn : Grade::Ok, name,
          slow ? "reading the time takes a microsecond or more; boot with clocksource=tsc tsc=reliable if the "
                 "processor has a steady TSC"
               : ""};
}

Finding timer_resolution() {
  timespec resolution{};
  clock_getres(CLOCK_MONOTONIC, &resolution);
  const bool fine = resolution.tv_sec == 0 && resolution.tv_nsec <= 1000;
  return {"timers", fine ? Grade::Ok : Grade::Fail,
          fmt::format("resolution {}", human_ns(resolution.tv_sec * 1'000'000'000 + resolution.tv_nsec)),
          fine ? "" : "the kernel has no high-resolution timers (CONFIG_HIGH_RES_TIMERS, or booted with highres=off)"};
}

Finding cores(const fs::path& root) {
  const auto allowed = rt::allowed_cores();
  const std::string isolated = first_line(root / "sys/devices/system/cpu/isolated");
  const std::string tickless = first_line(root / "sys/devices/system/cpu/nohz_full");
  std::string found = fmt::format("{} usable", allowed.size());
  found += isolated.empty() ? ", none isolated" : ", isolated: " + isolated;
  if (!tickless.empty() && tickless != "(null)") {
    found += ", without scheduler tick: " + tickless;
  }
  if (allowed.size() < 2) {
    return {"cores", Grade::Warn, found,
            "with one core everything else runs between the ticks; use a machine with two or more"};
  }
  return {"cores", isolated.empty() ? Grade::Warn : Grade::Ok, found,
          isolated.empty()
              ? fmt::format("keep other work off one core: boot with isolcpus={0} nohz_full={0} rcu_nocbs={0}",
                            allowed.back())
              : ""};
}

/// Podman and docker leave these marks. That of docker also stays in images from which machines are made, on which,
/// unlike in a container, the threads of the kernel are seen.
bool in_container(const fs::path& root) {
  std::error_code error;
  return fs::exists(root / "run/.containerenv", error) ||
         (fs::exists(root / ".dockerenv", error) && first_line(root / "proc/2/comm") != "kthreadd");
}

Finding container(bool contained) {
  return {"container", Grade::Ok, contained ? "yes: its options of podman or docker run give it rights" : "no", ""};
}

Finding fifo(bool contained) {
  constexpr int kTickPriority = 90;
  const int before = rt::fifo_priority();
  const bool allowed = rt::set_fifo(kTickPriority).ok();
  static_cast<void>(rt::set_fifo(before));
  if (allowed) {
    return {"fifo", Grade::Ok, fmt::format("SCHED_FIFO {} allowed", kTickPriority), ""};
  }
  return {"fifo", Grade::Fail, "SCHED_FIFO refused",
          contained ? "modules run, but other programs can delay them: run the container with --ulimit rtprio=99"
                    : "modules run, but other programs can delay them: put '@realtime - rtprio 95' and '@realtime - "
                      "memlock unlimited' into /etc/security/limits.d/realtime.conf, add the user to group realtime "
                      "and log in again"};
}

Finding locked_memory(bool contained) {
  rlimit limit{};
  getrlimit(RLIMIT_MEMLOCK, &limit);
  const std::string text = limit.rlim_cur == RLIM_INFINITY ? "unlimited" : human_bytes(limit.rlim_cur);
  const bool allowed = rt::lock_memory().ok();
  munlockall();
  // A node needs up to 20 MiB; this program needs less.
  constexpr rlim_t kEnough = 64U << 20U;
  if (allowed && (limit.rlim_cur == RLIM_INFINITY || limit.rlim_cur >= kEnough || geteuid() == 0)) {
    return {"locked-memory", Grade::Ok, "mlockall works, limit " + text, ""};
  }
  return {"locked-memory", Grade::Warn, "limit " + text,
          contained ? "pages may be fetched in the middle of a run; run the container with --ulimit memlock=-1"
                    : "pages may be fetched in the middle of a run; put '@realtime - memlock unlimited' into "
                      "/etc/security/limits.d/realtime.conf"};
}

Finding idle_states(const fs::path& root, bool contained) {
  const fs::path file = root / "dev/cpu_dma_latency";
  if (contained && access(file.c_str(), R_OK | W_OK) != 0) {
    return {"idle-states", Grade::Warn, "no right to /dev/cpu_dma_latency of the machine",
            "waking up from deep idle states costs up to 100 us; run the container with --device /dev/cpu_dma_latency "
            "and as a user who may write to it"};
  }
  if (access(file.c_str(), F_OK) != 0) {
    return {"idle-states", Grade::Ok, "no /dev/cpu_dma_latency: nothing to hold short", ""};
  }
  if (access(file.c_str(), R_OK | W_OK) == 0) {
    return {"idle-states", Grade::Ok, "/dev/cpu_dma_latency can be held", ""};
  }
  return {"idle-states", Grade::Warn, "no right to /dev/cpu_dma_latency",
          "waking up from deep idle states costs up to 100 us; let group realtime write it: udev rule "
          "KERNEL==\"cpu_dma_latency\", GROUP=\"realtime\", MODE=\"0660\""};
}

Finding throttling() {
  const int permille = rt::throttle_permille();
  if (permille >= 1000) {
    return {"throttling", Grade::Ok, "off: real-time threads may use a whole core", ""};
  }
  constexpr int kUsual = 900;
  return {"throttling", permille >= kUsual ? Grade::Ok : Grade::Warn,
          fmt::format("real-time threads may use {:.1f} % of a core", permille / 10.0),
          permille >= kUsual ? "" : "sysctl kernel.sched_rt_runtime_us=950000"};
}

Finding swap(const fs::path& root) {
  std::ifstream in(root / "proc/swaps");
  std::size_t lines = 0;
  for (std::string line; std::getline(in, line);) {
    ++lines;
  }
  return lines > 1 ? Finding{"swap", Grade::Warn, "in use",
                             "only programs with locked memory are safe from it; sudo swapoff -a, or take it out of "
                             "/etc/fstab"}
                   : Finding{"swap", Grade::Ok, "none", ""};
}

Finding governor(const fs::path& root) {
  std::map<std::string, int> found;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(root / "sys/devices/system/cpu", error)) {
    const std::string name = first_line(entry.path() / "cpufreq/scaling_governor");
    if (!name.empty()) {
      ++found[name];
    }
  }
  if (found.empty()) {
    return {"cpu-frequency", Grade::Ok, "not controlled by this system", ""};
  }
  std::string text;
  for (const auto& [name, count] : found) {
    text += fmt::format("{}{} on {} cores", text.empty() ? "" : ", ", name, count);
  }
  const bool steady = found.size() == 1 && found.begin()->first == "performance";
  return {"cpu-frequency", steady ? Grade::Ok : Grade::Warn, text,
          steady ? "" : "run times change with the frequency; sudo cpupower frequency-set -g performance"};
}

Finding virtual_machine(const fs::path& root) {
  std::ifstream in(root / "proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("flags") && line.find(" hypervisor") != std::string::npos) {
      const std::string vendor = first_line(root / "sys/class/dmi/id/sys_vendor");
      return {"virtual-machine", Grade::Warn, vendor.empty() ? "yes" : printable(vendor),
              "the host may stop this machine for milliseconds; good for development, not for control"};
    }
  }
  return {"virtual-machine", Grade::Ok, "no", ""};
}

Finding shared_memory(bool contained) {
  struct statvfs info {};
  if (statvfs(vars::kShmDirectory, &info) != 0) {
    return {"shared-memory", Grade::Fail, "no /dev/shm", "mount a tmpfs there: sudo mount -t tmpfs tmpfs /dev/shm"};
  }
  const std::uint64_t free_bytes = static_cast<std::uint64_t>(info.f_bavail) * info.f_frsize;
  constexpr std::uint64_t kNeeded = 8U << 20U;
  constexpr std::uint64_t kComfortable = 64U << 20U;
  const std::string text = fmt::format("{} free in /dev/shm", human_bytes(free_bytes));
  if (access(vars::kShmDirectory, W_OK | X_OK) != 0) {
    return {"shared-memory", Grade::Fail, "no right to write to /dev/shm", "sudo chmod 1777 /dev/shm"};
  }
  if (free_bytes < kComfortable) {
    return {"shared-memory", free_bytes < kNeeded ? Grade::Fail : Grade::Warn, text,
            contained ? "remove what is left over (indurop clean --all), or run the container with --shm-size 256m"
                      : "remove what is left over (indurop clean --all), or enlarge it: sudo mount -o "
                        "remount,size=256M /dev/shm"};
  }
  return {"shared-memory", Grade::Ok, text, ""};
}

/// Whether a folder is in another file system than the root.
bool is_mounted(const fs::path& folder, const fs::path& root) {
  struct stat own {};
  struct stat top {};
  return stat(folder.c_str(), &own) == 0 && stat(root.c_str(), &top) == 0 && own.st_dev != top.st_dev;
}

Finding state_folder(const fs::path& root, bool contained) {
  constexpr const char* kNode = "local";
  const fs::path folder = vars::state_directory(kNode).parent_path();
  fs::path there = folder;
  std::error_code error;
  while (!there.empty() && !fs::exists(there, error) && there != there.parent_path()) {
    there = there.parent_path();
  }
  if (contained && !is_mounted(there, root)) {
    return {
        "state-folder", Grade::Warn, fmt::format("{} ends with the container", folder.string()),
        fmt::format("deployments and retained variables would be lost with it; run the container with -v indurop:{}",
                    folder.string())};
  }
  if (fs::is_directory(there, error) && access(there.c_str(), W_OK | X_OK) == 0) {
    return {"state-folder", Grade::Ok, folder.string(), ""};
  }
  return {"state-folder", Grade::Warn, fmt::format("{} cannot be written", folder.string()),
          "retained variables would be lost at a power failure; set INDUROP_STATE_DIR to a folder of yours"};
}

}  // namespace

std::vector<Finding> examine_machine(const fs::path& root) {
  const bool contained = in_container(root);
  return {kernel(),
          clock_source(root),
          timer_resolution(),
          cores(root),
          container(contained),
          fifo(contained),
          locked_memory(contained),
          idle_states(root, contained),
          throttling(),
          swap(root),
          governor(root),
          virtual_machine(root),
          shared_memory(contained),
          state_folder(root, contained)};
}

Finding grade_latency(std::int64_t p50_ns, std::int64_t p99_ns, std::int64_t max_ns, std::uint64_t wakeups,
                      bool real_time) {
  constexpr std::int64_t kGoodNs = 100'000;
  constexpr std::int64_t kBadNs = 1'000'000;
  Finding finding{"wake-up", Grade::Ok,
                  fmt::format("late by p50 {}, p99 {}, max {} ({} wake-ups{})", human_ns(p50_ns), human_ns(p99_ns),
                              human_ns(max_ns), wakeups, real_time ? "" : ", without real-time priority"),
                  ""};
  if (p99_ns > kGoodNs) {
    finding.grade = p99_ns > kBadNs ? Grade::Fail : Grade::Warn;
    finding.advice =
        "periods well above that are safe; fix what is marked above, then measure again under load (indurop doctor "
        "--duration 60)";
  }
  return finding;
}

const char* to_text(Grade grade) noexcept {
  switch (grade) {
    case Grade::Ok:
      return "OK";
    case Grade::Warn:
      return "WARN";
    case Grade::Fail:
      return "FAIL";
  }
  return "FAIL";
}

}  // namespace indurop::tools
