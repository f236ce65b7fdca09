// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/fieldbus/import_esi.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "config/xml/io_reader.h"
#include "core/base/duration.h"
#include "core/base/read_file.h"
#include "core/base/replace_file.h"
#include "core/base/text.h"
#include "tools/cli/fieldbus/import_file.h"
#include "tools/cli/fieldbus/import_fmu.h"
#include "tools/console/diagnostics.h"

namespace indurop::tools {

namespace {

using EsiDevice = io::esi::Device;

std::string modes_of(const EsiDevice& device) {
  std::vector<std::string> names;
  for (const io::esi::OpMode& mode : device.modes) {
    names.push_back(fmt::format("{} 0x{:x}", mode.name, mode.assign_activate));
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string hex_of(std::uint32_t number) {
  return fmt::format("0x{:x}", number);
}

void print_devices(Context& context, const io::esi::EsiFile& all) {
  Table table({{"TYPE", "type"},
               {"VENDOR", "vendor", Align::Right},
               {"PRODUCT", "product", Align::Right},
               {"REVISION", "revision", Align::Right},
               {"PDOS", "pdos", Align::Right},
               {"CLOCK MODES", "modes"},
               {"NAME", "name"}});
  for (const EsiDevice& device : all.devices) {
    const auto& identity = device.sii.identity;
    const std::size_t pdos = device.sii.inputs.size() + device.sii.outputs.size();
    table.add({Cell(device.type, Style::Bold),
               {hex_of(identity.vendor), identity.vendor},
               {hex_of(identity.product), identity.product},
               {hex_of(identity.revision), identity.revision},
               {std::to_string(pdos), pdos},
               Cell(modes_of(device)),
               Cell(device.sii.name + (device.has_modules ? " (its modules are not read)" : ""))});
  }
  print_table(context, table, JsonValue::object(), "devices");
}

// The devices of all files. Nothing after errors.
std::optional<io::esi::EsiFile> read_all(Context& context, const std::vector<std::string>& files) {
  io::esi::EsiFile all;
  for (const std::string& file : files) {
    io::esi::EsiFile one = io::esi::read_esi(file);
    std::move(one.devices.begin(), one.devices.end(), std::back_inserter(all.devices));
    all.diagnostics.insert(all.diagnostics.end(), one.diagnostics.begin(), one.diagnostics.end());
  }
  print_diagnostics(context, all.diagnostics, false);
  return all.ok() ? std::optional(std::move(all)) : std::nullopt;
}

std::optional<ImportChoice> choice_of(Context& context, const ImportRequest& request, const io::esi::EsiFile& all) {
  ImportChoice choice;
  choice.mode = request.mode;
  choice.cycle = request.cycle;
  choice.place = {request.interface, 0, request.space.empty() ? "IO" : request.space};
  for (const std::string& type : request.devices) {
    choice.added.push_back(io::esi::find_device(all, type));
    if (choice.added.back() == nullptr) {
      context.out.error(fmt::format("the files have no device {}{}", base::in_quotes(type),
                                    base::suggestion(type, io::esi::types_of(all))));
      return std::nullopt;
    }
  }
  return choice;
}

int write(Context& context, const ImportRequest& request, const io::esi::EsiFile& all) {
  const auto choice = choice_of(context, request, all);
  if (!choice) {
    return kFailed;
  }
  std::string present;
  if (std::filesystem::exists(request.to)) {
    const config::ReadIo read = config::read_io_config(request.to);
    print_diagnostics(context, read.diagnostics, false);
    const auto text = base::read_file(request.to);
    if (!read.ok() || !text) {
      return kFailed;
    }
    present = *text;
  }
  const auto imported = import_devices(present, all.devices, *choice);
  if (!imported) {
    context.out.error(imported.error());
    return kFailed;
  }
  if (imported->added + imported->extended == 0) {
    context.out.error(
        fmt::format("nothing to write: {} has no device that the files describe and that lacks <sync> or "
                    "<set>; name new ones with --device {}",
                    request.to.string(), all.devices.empty() ? "TYPE" : all.devices.front().type));
    return kFailed;
  }
  if (const auto written = base::replace_file(request.to, imported->xml, base::Durable::No); !written) {
    context.out.error(base::cannot_write(request.to, written.error()));
    return kFailed;
  }
  context.out.note(fmt::format("{} is written: {} devices added, {} extended", request.to.string(), imported->added,
                               imported->extended));
  return kOk;
}

}  // namespace

void add_import_options(base::Options& verb, ImportRequest& request) {
  verb.add("files", "FILE", request.files, "The manufacturers' descriptions (ESI, XML), or an FMU")
      .required()
      .completes(base::Completion::File);
  verb.add("--write", "FILE", request.to, "Write or extend this ioconfig.xml").completes(base::Completion::File);
  verb.add("--device", "TYPE", request.devices,
           "Add a device of this type; repeat it for each device, in the order of the cable")
      .one_at_a_time();
  verb.add("--mode", "NAME", request.mode, "How devices use their clocks (OpMode; default: the first that they offer)");
  verb.add(
      "--cycle", "TIME",
      [&request](const std::string& text) {
        const auto cycle = base::parse_duration(text);
        request.cycle = cycle.value_or(request.cycle);
        return cycle ? std::string() : base::in_quotes(text) + " is no time; write 1ms";
      },
      "Cycle time of the bus (default: 1ms)");
  verb.add("--address", "INTERFACE", request.interface, "Network interface of new devices (default: eth1)");
  verb.add("--namespace", "NAME", request.space,
           "Namespace of the variables of new devices (default: IO, or the name of the FMU)");
  verb.add("--glb", "FILE", request.glb, "Of an FMU: write the declarations of these variables")
      .completes(base::Completion::File);
}

int import_esi(Context& context, const ImportRequest& request) {
  if (names_fmus(request)) {
    return import_fmu(context, request);
  }
  const auto all = read_all(context, request.files);
  if (!all) {
    return kFailed;
  }
  if (!request.to.empty()) {
    return write(context, request, *all);
  }
  print_devices(context, *all);
  return kOk;
}

}  // namespace indurop::tools
