// SPDX-License-Identifier: Apache-2.0
#include "control/io/ecsim/pcap_file.h"

namespace indurop::io::ecsim {

namespace {

constexpr std::uint32_t kMagicOfNanoseconds = 0xA1B23C4D;
constexpr std::uint32_t kVersion = 4U << 16U | 2U;
constexpr std::uint32_t kMostBytes = 65535;
constexpr std::uint32_t kEthernet = 1;

}  // namespace

PcapFile::PcapFile(const std::filesystem::path& path) : file_(path, std::ios::binary) {
  for (const std::uint32_t number : {kMagicOfNanoseconds, kVersion, 0U, 0U, kMostBytes, kEthernet}) {
    append(number);
  }
}

void PcapFile::append(std::uint32_t number) {
  for (unsigned shift = 0; shift < 32; shift += 8) {
    pending_.push_back(static_cast<char>(number >> shift));
  }
}

void PcapFile::add(std::chrono::nanoseconds time, ethercat::Bytes frame) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  append(static_cast<std::uint32_t>(time.count() / kSecond));
  append(static_cast<std::uint32_t>(time.count() % kSecond));
  append(static_cast<std::uint32_t>(frame.size()));
  append(static_cast<std::uint32_t>(frame.size()));
  pending_.insert(pending_.end(), frame.begin(), frame.end());
}

bool PcapFile::flush() {
  file_.write(pending_.data(), static_cast<std::streamsize>(pending_.size()));
  file_.flush();
  pending_.clear();
  return file_.good();
}

}  // namespace indurop::io::ecsim
