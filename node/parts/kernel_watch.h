// SPDX-License-Identifier: Apache-2.0
// A normal thread that samples the kernel's counters of the node's threads, so that a late run can be explained.

#pragma once

#include <memory>
#include <string>
#include <vector>

namespace indurop::node {

class KernelWatch {
 public:
  // Runs on these cores, if any are named. If the file cannot be created, nothing is sampled.
  KernelWatch(const std::string& node, bool realtime, std::vector<int> cores);
  ~KernelWatch();
  KernelWatch(const KernelWatch&) = delete;
  KernelWatch& operator=(const KernelWatch&) = delete;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace indurop::node
