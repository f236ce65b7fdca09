// SPDX-License-Identifier: Apache-2.0
// Frames in a file that Wireshark reads: pcap with nanoseconds. Frames are kept until flush() writes them.

#pragma once

#include <chrono>
#include <filesystem>
#include <fstream>
#include <vector>

#include "control/io/ethercat/bytes.h"

namespace indurop::io::ecsim {

class PcapFile {
 public:
  explicit PcapFile(const std::filesystem::path& path);
  // `time`: since 1970.
  void add(std::chrono::nanoseconds time, ethercat::Bytes frame);
  // Returns false once something could not be written.
  bool flush();

 private:
  void append(std::uint32_t number);

  std::ofstream file_;
  std::vector<char> pending_;
};

}  // namespace indurop::io::ecsim
