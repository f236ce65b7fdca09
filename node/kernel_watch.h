// SPDX-License-Identifier: Apache-2.0
// A normal thread that looks at what the kernel counts for the node's threads, so that a late run can be explained.

#pragma once

#include <memory>
#include <string>
#include <vector>

namespace indurop::node {

class KernelWatch {
 public:
  // On these cores, if any are named. Where the file cannot be made nothing is looked at.
  KernelWatch(const std::string& node, bool realtime, std::vector<int> cores);
  ~KernelWatch();
  KernelWatch(const KernelWatch&) = delete;
  KernelWatch& operator=(const KernelWatch&) = delete;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace indurop::node
