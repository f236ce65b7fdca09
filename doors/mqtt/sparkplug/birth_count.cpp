// SPDX-License-Identifier: Apache-2.0
#include "doors/mqtt/sparkplug/birth_count.h"

#include <charconv>

#include "core/base/read_file.h"
#include "core/base/replace_file.h"

namespace indurop::mqtt {
namespace {

constexpr std::uint64_t kBirths = 256;

}  // namespace

BirthCount::BirthCount(std::filesystem::path file) : file_(std::move(file)) {
  if (const auto text = base::read_file(file_)) {
    std::from_chars(text->data(), text->data() + text->size(), next_);
    next_ %= kBirths;
  }
}

std::uint64_t BirthCount::next() {
  const std::uint64_t now = next_;
  next_ = (next_ + 1) % kBirths;
  const auto written = base::replace_file(file_, std::to_string(next_) + "\n", base::Durable::Yes);
  problem_ = written ? "" : base::cannot_write(file_, written.error());
  return now;
}

}  // namespace indurop::mqtt
