// SPDX-License-Identifier: Apache-2.0
// DDS domains for tests that run at the same time: no two of one build get the same. A domain is taken by locking a
// file next to the test programs; the kernel releases it when the test ends, however it ends.

#pragma once

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

namespace indurop::test {

inline int take_dds_domain() {
  constexpr int kDomains = 200;  // further ones have no ports of their own
  std::error_code ignored;
  const auto folder = std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path() / "domains";
  std::filesystem::create_directories(folder, ignored);
  // The first one tried differs from test to test: participants of the test before may still be about to end.
  for (int i = 0; i < kDomains; ++i) {
    const int domain = 1 + static_cast<int>((::getpid() + i) % kDomains);
    const int file = ::open((folder / std::to_string(domain)).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (file >= 0 && ::flock(file, LOCK_EX | LOCK_NB) == 0) {
      return domain;  // the file stays open, and with it the lock
    }
    ::close(file);
  }
  std::fprintf(stderr, "no DDS domain is free in %s\n", folder.c_str());
  std::abort();
}

// The domain of this test; `number` for tests that need more than one.
inline int dds_domain(std::size_t number = 0) {
  static std::vector<int> taken;
  while (taken.size() <= number) {
    taken.push_back(take_dds_domain());
  }
  return taken[number];
}

}  // namespace indurop::test
