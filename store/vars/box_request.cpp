// SPDX-License-Identifier: Apache-2.0
#include "store/vars/box_request.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <system_error>
#include <thread>

#include "core/base/read_file.h"
#include "core/base/replace_file.h"
#include "core/rt/clock.h"
#include "store/vars/retain.h"

namespace indurop::vars {
namespace {

constexpr std::size_t kLongest = 400;

std::filesystem::path file_of(const std::string& node) {
  return state_directory(node) / "keep-box";
}

std::filesystem::path refusal_of(const std::string& node) {
  return state_directory(node) / "keep-box.not-before";
}

// A time further in the future than possible is from an earlier boot.
bool refuses(const std::string& node) {
  const auto text = base::read_file(refusal_of(node), kLongest);
  std::int64_t until_ns = 0;
  if (text) {
    std::from_chars(text->data(), text->data() + text->size(), until_ns);
  }
  const std::int64_t left_ns = until_ns - rt::now_ns();
  return left_ns > 0 && left_ns <= std::chrono::nanoseconds(kBetweenBoxes).count();
}

}  // namespace

void refuse_boxes_until(const std::string& node, std::int64_t monotonic_ns) {
  const std::filesystem::path file = refusal_of(node);
  std::error_code ignored;
  if (monotonic_ns == 0) {
    std::filesystem::remove(file, ignored);
  } else {
    (void)base::replace_file(file, std::to_string(monotonic_ns), base::Durable::No);
  }
}

Status request_box(const std::string& node, const std::string& why) {
  if (refuses(node)) {
    return Error{Errc::Busy, 0, kBoxesTooClose};
  }
  const std::filesystem::path file = file_of(node);
  std::error_code error;
  std::filesystem::create_directories(file.parent_path(), error);
  const auto written = base::replace_file(file, why.substr(0, kLongest), base::Durable::No);
  return written ? Status() : Status(Error{Errc::System, written.error().sys_errno, "folder of the node"});
}

bool box_request_is_read(const std::string& node, std::chrono::nanoseconds patience) {
  constexpr std::chrono::milliseconds kPause{10};
  const rt::MonoTime end = rt::MonoClock::now() + patience;
  std::error_code error;
  while (std::filesystem::exists(file_of(node), error)) {
    if (rt::MonoClock::now() >= end) {
      return !take_box_request(node);
    }
    std::this_thread::sleep_for(kPause);
  }
  return true;
}

std::optional<std::string> take_box_request(const std::string& node) {
  const std::filesystem::path file = file_of(node);
  std::error_code error;
  if (!std::filesystem::exists(file, error)) {
    return std::nullopt;
  }
  auto text = base::read_file(file, kLongest);
  std::filesystem::remove(file, error);
  if (!text) {
    return std::nullopt;
  }
  std::replace_if(
      text->begin(), text->end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
  return std::move(text).value();
}

}  // namespace indurop::vars
