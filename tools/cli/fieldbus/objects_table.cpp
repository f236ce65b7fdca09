// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/fieldbus/objects_table.h"

#include <fmt/format.h>

namespace indurop::tools {
namespace {

using io::ethercat::DescribedObject;
using io::ethercat::EntryDescription;

std::string access_of(const EntryDescription& entry) {
  std::string text = (entry.access & io::ethercat::kEntryReadable) != 0 ? "r" : "";
  text += (entry.access & io::ethercat::kEntryWritable) != 0 ? "w" : "";
  return text;
}

// What a point can be that has it.
std::string point_of(const EntryDescription& entry) {
  const bool output = (entry.access & io::ethercat::kEntryForOutputs) != 0;
  const bool input = (entry.access & io::ethercat::kEntryForInputs) != 0;
  if (output && input) {
    return "output, input";
  }
  return output ? "output" : std::string(input ? "input" : "");
}

}  // namespace

std::string coe_type_name(std::uint16_t type, unsigned bits) {
  switch (type) {
    case 0x01:
      return "bool";
    case 0x02:
    case 0x03:
    case 0x04:
    case 0x15:
      return fmt::format("int{}", bits);
    case 0x05:
    case 0x06:
    case 0x07:
    case 0x1B:
      return fmt::format("uint{}", bits);
    case 0x08:
    case 0x11:
      return fmt::format("float{}", bits);
    case 0x09:
      return "text";
    default:
      return fmt::format("{} bits", bits);
  }
}

void print_objects(Context& context, const std::vector<DescribedObject>& objects) {
  Table table({{"AT", "at"},
               {"TYPE", "type"},
               {"BITS", "bits", Align::Right},
               {"ACCESS", "access"},
               {"POINT", "point"},
               {"NAME", "name"}});
  for (const DescribedObject& object : objects) {
    for (const EntryDescription& entry : object.entries) {
      const bool is_first = &entry == &object.entries.front();
      const std::string name = is_first && entry.name.empty() ? object.object.name : entry.name;
      table.add({Cell(fmt::format("{:04x}:{:x}", entry.index, entry.subindex)),
                 Cell(coe_type_name(entry.type, entry.bits)),
                 {std::to_string(entry.bits), entry.bits},
                 Cell(access_of(entry)),
                 Cell(point_of(entry)),
                 Cell(name, is_first ? Style::Bold : Style::None)});
    }
  }
  print_table(context, table, JsonValue::object(), "objects");
}

}  // namespace indurop::tools
