// SPDX-License-Identifier: Apache-2.0
#include "config/xml/io_copy_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "config/xml/attributes.h"
#include "config/xml/element_rules.h"
#include "config/xml/io_object_reader.h"
#include "core/base/text.h"

namespace indurop::config {
namespace {

constexpr const char* kForms =
    "write an object, 6000:1, all that a PDO has from one object to another, 6000:1-6000:b, or a PDO";

constexpr base::Nanos kMaxHold{1'000'000'000};

// Indices of what describes PDOs, so that they are of no object that a slave exchanges.
struct PdoIndices {
  std::uint16_t first;
  std::uint16_t last;
};
constexpr PdoIndices pdos_of(bool output) noexcept {
  return output ? PdoIndices{0x1600, 0x17FF} : PdoIndices{0x1A00, 0x1BFF};
}
constexpr bool has(const PdoIndices& pdos, const IoObject& object) noexcept {
  return object.index >= pdos.first && object.index <= pdos.last;
}

// Reads one end of a copy: an output of its device, or an input of the other one.
IoBlock read_block(Attributes& attributes, bool output, base::Diagnostics& report) {
  const char* const name = output ? "to" : "at";
  IoBlock block;
  const auto text = attributes.need(name, output ? "to=\"7000:1\"" : "at=\"6000:1\"", &block.place);
  if (!text) {
    return block;
  }
  block.at = *text;
  const std::size_t dash = text->find('-');
  const PdoIndices own = pdos_of(output);
  const PdoIndices others = pdos_of(!output);
  bool is_known = false;
  if (dash != std::string::npos) {
    block.kind = IoBlock::Kind::Range;
    is_known = read_io_object(text->substr(0, dash), block.first) &&
               read_io_object(text->substr(dash + 1), block.last) && !has(own, block.first) && !has(own, block.last);
  } else {
    is_known = read_io_object_name(*text, output, block.first);
    block.kind = has(own, block.first) ? IoBlock::Kind::Pdo : IoBlock::Kind::Object;
  }
  if (has(others, block.first)) {
    report.error(block.place,
                 fmt::format("{}: {} is a PDO of {}; those of {} are {:x} to {:x}", name, base::in_quotes(*text),
                             output ? "inputs" : "outputs", output ? "outputs" : "inputs", own.first, own.last));
  } else if (!is_known) {
    report.error(block.place, fmt::format("{}: {} is nothing that a slave exchanges; {}, {:x}", name,
                                          base::in_quotes(*text), kForms, own.first));
  }
  return block;
}

// Two copies to the same outputs of a device; more about PDOs only their slave knows.
void check_targets(const IoDevice& device, base::Diagnostics& report) {
  const auto& copies = device.slave.copies;
  for (auto copy = copies.begin(); copy != copies.end(); ++copy) {
    const auto first = std::find_if(copies.begin(), copy, [copy](const IoCopy& other) {
      return is_same(other.target.first, copy->target.first) && other.target.first.index != 0;
    });
    if (first != copy) {
      report.error(copy->target.place, fmt::format("to: {} is written by the copy in line {} already; remove one",
                                                   base::in_quotes(copy->target.at), first->place.line));
    }
  }
}

// Returns what is wrong with the source of a copy; empty: nothing.
std::string problem_of(const IoCopy& copy, const IoDevice& target, const IoDevice& source) {
  if (source.driver != IoDriver::Ethercat) {
    return fmt::format("from: {} is a {} device; bytes are copied between slaves of an EtherCAT bus",
                       base::in_quotes(copy.from), name_of(source.driver));
  }
  if (source.name == target.name) {
    return "from: this is the device itself; name the slave whose inputs are copied to it";
  }
  if (source.address != target.address) {
    return fmt::format("from: {} is on {}, this device on {}; bytes are copied between slaves of one bus",
                       base::in_quotes(copy.from), source.address, target.address);
  }
  return {};
}

// Both devices are exchanged at the same time again and again, so that what is copied always has the same age.
void check_cycles(const IoCopy& copy, const IoDevice& target, const IoDevice& source, base::Diagnostics& report) {
  constexpr base::Nanos kMicrosecond{1000};
  const base::Nanos slow = std::max(target.slave.cycle, source.slave.cycle);
  const base::Nanos fast = std::min(target.slave.cycle, source.slave.cycle);
  if (fast.count() != 0 && (slow % fast).count() != 0) {
    report.error(
        copy.from_place,
        fmt::format("from: {} is exchanged each {} us, this device each {} us; the cycle of one has to be a "
                    "multiple of the other's",
                    base::in_quotes(copy.from), source.slave.cycle / kMicrosecond, target.slave.cycle / kMicrosecond));
  }
}

// As far as the names of objects say how long they are.
void check_sizes(const IoCopy& copy, base::Diagnostics& report) {
  const unsigned source = copy.source.first.bytes;
  const unsigned target = copy.target.first.bytes;
  const bool are_objects = copy.source.kind == IoBlock::Kind::Object && copy.target.kind == IoBlock::Kind::Object;
  if (are_objects && source != 0 && target != 0 && source != target) {
    report.error(copy.place, fmt::format("{} of {} has {} bytes, and {} has {}; name objects of one size",
                                         copy.source.at, copy.from, source, copy.target.at, target));
  }
}

}  // namespace

void read_io_copy(const base::Element& element, IoDevice& device, base::Diagnostics& report) {
  Attributes attributes(element, report);
  IoCopy copy;
  copy.place = element.place;
  copy.from =
      attributes.need("from", "from=\"safety\", the device whose inputs are copied", &copy.from_place).value_or("");
  copy.source = read_block(attributes, false, report);
  copy.target = read_block(attributes, true, report);
  if (copy.source.kind == IoBlock::Kind::Object && copy.target.kind == IoBlock::Kind::Object) {
    read_io_type(attributes, copy.source.first);
    read_io_type(attributes, copy.target.first);
  }
  copy.hold = attributes.duration("hold", base::Nanos{0}, kMaxHold).value_or(copy.hold);
  if (is_leaf(element, report)) {
    check_no_text(element, report);
  }
  attributes.finish("<copy> of an ethercat device");
  device.slave.copies.push_back(std::move(copy));
}

void link_io_copies(IoConfig& config, base::Diagnostics& report) {
  std::vector<std::string> names;
  for (const IoDevice& device : config.devices) {
    names.push_back(device.name);
  }
  for (const IoDevice& device : config.devices) {
    check_targets(device, report);
    for (const IoCopy& copy : device.slave.copies) {
      const auto source = std::find_if(config.devices.begin(), config.devices.end(),
                                       [&copy](const IoDevice& other) { return other.name == copy.from; });
      if (source == config.devices.end()) {
        if (!copy.from.empty()) {
          report.error(copy.from_place, fmt::format("from: there is no device {}{}", base::in_quotes(copy.from),
                                                    base::suggestion(copy.from, names)));
        }
        continue;
      }
      const std::string problem = problem_of(copy, device, *source);
      if (!problem.empty()) {
        report.error(copy.from_place, problem);
        continue;
      }
      check_cycles(copy, device, *source, report);
      check_sizes(copy, report);
      source->slave.copied.push_back(copy.source);
    }
  }
}

}  // namespace indurop::config
