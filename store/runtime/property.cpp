// SPDX-License-Identifier: Apache-2.0
// irp::property: the text of the module's properties in the run block, as numbers.

#include <indurop/files.h>
#include <indurop/irp.h>

#include <fmt/format.h>

#include <charconv>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string_view>

#include "core/base/text.h"
#include "core/base/word_values.h"
#include "store/runtime/host.h"
#include "store/runtime/process.h"

namespace irp::detail {

namespace {

namespace runtime = indurop::runtime;

struct Module {
  std::string_view name;
  std::string_view properties;  // "name\0value\0name\0value\0"
};

std::optional<Module> calling_module() {
  runtime::Process::get();  // knows INDUROP_MODULE
  const auto* run = runtime::hot.run.load(std::memory_order_acquire);
  const std::uint32_t index = runtime::current_module();
  if (run == nullptr || index >= run->module_count) {
    return {};
  }
  const auto& record = run->modules()[index];
  return Module{{record.name, strnlen(record.name, sizeof record.name)},
                {run->at<char>(record.property_offset), record.property_size}};
}

// Removes one NUL-terminated text from the front; returns an empty view without data if there is none.
std::string_view take_text(std::string_view& from) {
  const std::size_t end = from.find('\0');
  if (end == std::string_view::npos) {
    return {};
  }
  const std::string_view text = from.substr(0, end);
  from.remove_prefix(end + 1);
  return text;
}

bool complain(const char* name, std::string_view text, std::string_view expected) {
  const auto module = calling_module();
  const std::string line = fmt::format("module {}: property '{}' is \"{}\", expected {}: using the default",
                                       module ? module->name : "?", name, text, expected);
  if (runtime::Process::get().first_time(line)) {
    irp::printf("%s\n", line);
  }
  return false;
}

// Integer in C notation. The caller handles the sign.
bool parse_unsigned(std::string_view text, std::uint64_t& value) {
  const bool hex = text.starts_with("0x") || text.starts_with("0X");
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data() + (hex ? 2 : 0), end, value, hex ? 16 : 10);
  return error == std::errc{} && stop == end;
}

}  // namespace

const char* property_text(const char* name) {
  const auto module = calling_module();
  if (!module) {
    return nullptr;
  }
  std::string_view rest = module->properties;
  while (!rest.empty()) {
    const std::string_view key = take_text(rest);
    const std::string_view value = take_text(rest);
    if (value.data() == nullptr) {
      break;
    }
    if (key == name) {
      return value.data();
    }
  }
  return nullptr;
}

bool property_signed(const char* name, std::int64_t min, std::int64_t max, std::int64_t& value) {
  const char* text = property_text(name);
  if (text == nullptr) {
    return false;
  }
  std::string_view digits = indurop::base::trimmed(text);
  const bool negative = digits.starts_with('-');
  digits.remove_prefix(negative || digits.starts_with('+') ? 1 : 0);
  std::uint64_t magnitude = 0;
  const std::uint64_t limit =
      negative ? std::uint64_t{0} - static_cast<std::uint64_t>(min) : static_cast<std::uint64_t>(max);
  if (!parse_unsigned(digits, magnitude) || magnitude > limit) {
    return complain(name, text, fmt::format("a whole number from {} to {}", min, max));
  }
  value = static_cast<std::int64_t>(negative ? std::uint64_t{0} - magnitude : magnitude);
  return true;
}

bool property_unsigned(const char* name, std::uint64_t max, std::uint64_t& value) {
  const char* text = property_text(name);
  if (text == nullptr) {
    return false;
  }
  std::string_view digits = indurop::base::trimmed(text);
  digits.remove_prefix(digits.starts_with('+') ? 1 : 0);
  std::uint64_t parsed = 0;
  if (!parse_unsigned(digits, parsed) || parsed > max) {
    return complain(name, text, fmt::format("a whole number from 0 to {}", max));
  }
  value = parsed;
  return true;
}

bool property_real(const char* name, double& value) {
  const char* text = property_text(name);
  if (text == nullptr) {
    return false;
  }
  const auto parsed = indurop::base::number_in(indurop::base::trimmed(text));
  value = parsed.value_or(value);
  return parsed || complain(name, text, "a number");
}

bool property_bool(const char* name, bool& value) {
  const char* text = property_text(name);
  if (text == nullptr) {
    return false;
  }
  const auto parsed = indurop::base::flag_in(indurop::base::trimmed(text));
  value = parsed.value_or(value);
  return parsed || complain(name, text, "true or false");
}

}  // namespace irp::detail

std::string irp::file_beside_config(const std::string& name) {
  indurop::runtime::Process::get();  // knows INDUROP_NODE
  const auto* run = indurop::runtime::hot.run.load(std::memory_order_acquire);
  if (run == nullptr || name.empty()) {
    return name;
  }
  const std::filesystem::path config(std::string(run->config_file, strnlen(run->config_file, sizeof run->config_file)));
  return (config.parent_path() / name).lexically_normal().string();
}
