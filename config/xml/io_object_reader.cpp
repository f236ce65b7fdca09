// SPDX-License-Identifier: Apache-2.0
#include "config/xml/io_object_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "config/xml/element_rules.h"
#include "config/xml/values.h"
#include "core/base/text.h"

namespace indurop::config {
namespace {

// The types of whole numbers in a device, by their bytes.
struct NumberType {
  const char* name;
  unsigned bytes;
  std::int64_t low;
  std::int64_t high;
};
constexpr std::array<NumberType, 6> kNumberTypes{{{"int8", 1, -0x80, 0x7F},
                                                  {"uint8", 1, 0, 0xFF},
                                                  {"int16", 2, -0x8000, 0x7FFF},
                                                  {"uint16", 2, 0, 0xFFFF},
                                                  {"int32", 4, -0x80000000LL, 0x7FFFFFFF},
                                                  {"uint32", 4, 0, 0xFFFFFFFF}}};

std::vector<std::string> type_names() {
  std::vector<std::string> names;
  for (const NumberType& type : kNumberTypes) {
    names.emplace_back(type.name);
  }
  return names;
}

}  // namespace

bool read_io_object(const std::string& text, IoObject& object) {
  constexpr std::uint32_t kMaxIndex = 0xFFFF;
  constexpr std::uint32_t kMaxSubindex = 0xFF;
  const std::size_t colon = text.find(':');
  const auto index = read_hex(text.substr(0, colon), kMaxIndex);
  const auto subindex = colon == std::string::npos ? std::optional(0U) : read_hex(text.substr(colon + 1), kMaxSubindex);
  object = {static_cast<std::uint16_t>(index.value_or(0)), static_cast<std::uint8_t>(subindex.value_or(0))};
  for (const AxisObject& known : kAxisObjects) {
    object = known.object.index == object.index && object.subindex == 0 ? known.object : object;
  }
  return index && *index != 0 && subindex;
}

bool read_io_object_name(const std::string& text, bool output, IoObject& object) {
  const auto* const known = std::find_if(kAxisObjects.begin(), kAxisObjects.end(), [&](const AxisObject& axis) {
    return axis.output == output && axis.object.index != 0 && axis.name == text;
  });
  if (known == kAxisObjects.end()) {
    return read_io_object(text, object);
  }
  object = known->object;
  return true;
}

void read_io_type(Attributes& attributes, IoObject& object) {
  if (const auto type = attributes.choose("type", type_names())) {
    const NumberType& number = kNumberTypes.at(*type);
    object.bytes = static_cast<std::uint8_t>(number.bytes);
    object.is_signed = number.low < 0;
  }
}

void read_io_value(const base::Element& element, IoDevice& device, base::Diagnostics& report) {
  Attributes attributes(element, report);
  IoObjectValue read;
  base::SourcePlace place;
  const auto at = attributes.need("at", "at=\"6060\"", &place);
  if (at && !read_io_object(*at, read.object)) {
    report.error(place, fmt::format("at: {} is no object; write its index, 6060, or with a subindex, 1c12:1",
                                    base::in_quotes(*at)));
  }
  const bool has_type = attributes.need("type", "type=\"int8\"").has_value();
  const auto type = has_type ? attributes.choose("type", type_names()) : std::nullopt;
  const bool has_value = attributes.need("value", "value=\"8\"").has_value();
  if (type && has_value) {
    const NumberType& number = kNumberTypes.at(*type);
    const auto value = attributes.integer("value", number.low, number.high).value_or(0);
    for (unsigned i = 0; i < number.bytes; ++i) {
      read.bytes.push_back(static_cast<std::uint8_t>(static_cast<std::uint64_t>(value) >> (8 * i)));
    }
  }
  if (is_leaf(element, report)) {
    check_no_text(element, report);
  }
  attributes.finish("<set> of an ethercat device");
  device.slave.values.push_back(std::move(read));
}

void read_io_sync(const base::Element& element, IoDevice& device, base::Diagnostics& report) {
  constexpr std::uint32_t kMaxActivate = 0xFFFF;
  constexpr base::Nanos kMinCycle{10'000};
  constexpr base::Nanos kMaxCycle{1'000'000'000};
  Attributes attributes(element, report);
  IoSync& sync = device.slave.sync;
  if (sync.activate != 0) {
    report.error(element.place, "the device has a <sync> already; remove one");
  }
  base::SourcePlace place;
  if (const auto text = attributes.need("activate", "activate=\"0x300\"", &place)) {
    const auto activate = read_hex(std::string_view(*text).substr(text->starts_with("0x") ? 2 : 0), kMaxActivate);
    if (!activate || *activate == 0) {
      report.error(place, fmt::format("activate: {} is not what starts pulses; write AssignActivate of the device's "
                                      "description, 0x300 for SYNC0 alone",
                                      base::in_quotes(*text)));
    }
    sync.activate = static_cast<std::uint16_t>(activate.value_or(1));
  }
  if (attributes.need("cycle", "cycle=\"1ms\"")) {
    sync.cycle = attributes.duration("cycle", kMinCycle, kMaxCycle).value_or(kMaxCycle);
  }
  sync.shift = attributes.duration("shift", base::Nanos{0}, kMaxCycle).value_or(sync.cycle / 2);
  sync.sync1 = attributes.duration("sync1", base::Nanos{0}, kMaxCycle).value_or(sync.sync1);
  if (is_leaf(element, report)) {
    check_no_text(element, report);
  }
  attributes.finish("<sync> of an ethercat device");
}

void check_io_slave(const IoDevice& device, const IoConfig& config, base::Diagnostics& report) {
  for (const IoDevice& other : config.devices) {
    if (device.driver == IoDriver::Ethercat && other.driver == IoDriver::Ethercat && device.address == other.address &&
        device.slave.alias == other.slave.alias && device.slave.position == other.slave.position) {
      report.error(device.place, fmt::format("{} of {} has the device in line {} already; move its points there",
                                             describe(device.slave), device.address, other.place.line));
    }
    if (device.slave.sync.activate != 0 && other.slave.sync.activate != 0 && device.address != other.address) {
      report.error(device.place,
                   fmt::format("<sync>: the tick follows the clocks of {} already, as the device in line {} "
                               "says, and can follow one bus only; remove <sync> here",
                               other.address, other.place.line));
    }
  }
}

}  // namespace indurop::config
