// SPDX-License-Identifier: Apache-2.0
// indurop io: field devices, without a node.
#include <fmt/format.h>

#include "control/io/ethercat/link/wire.h"
#include "control/io/ethercat/master/foe_client.h"
#include "core/base/read_file.h"
#include "core/base/replace_file.h"
#include "core/rt/clock.h"
#include "tools/cli/fieldbus/import_esi.h"
#include "tools/cli/fieldbus/objects_table.h"
#include "tools/cli/fieldbus/scan_file.h"
#include "tools/cli/verbs/verbs.h"

namespace indurop::tools {
namespace {

using io::ethercat::FoundSlave;
using io::ethercat::Pdo;
using io::ethercat::PdoEntry;

constexpr double kMaxSlave = 1000;
constexpr double kMaxPassword = 4294967295;  // 32 bits

struct IoOptions {
  std::string interface;
  int slave = 0;
  std::string name;  // of a file of the slave
  double password = 0;
  bool boot = false;
  std::filesystem::path file;
  std::string space = "IO";
};

std::string hex(std::uint32_t number) {
  return fmt::format("0x{:x}", number);
}

struct Object {  // of the process data
  std::string at;
  std::string type;
  std::string name;
};

std::vector<Object> objects_of(const std::vector<Pdo>& pdos) {
  std::vector<Object> all;
  for (const Pdo& pdo : pdos) {
    for (const PdoEntry& entry : pdo.entries) {
      if (entry.index != 0 && pdo.sync_manager != 0xFF) {
        all.push_back({fmt::format("{:04x}:{:x}", entry.index, entry.subindex), coe_type_name(entry.type, entry.bits),
                       entry.name.empty() ? pdo.name : entry.name});
      }
    }
  }
  return all;
}

JsonValue objects_json(const std::vector<Object>& objects) {
  JsonValue all = JsonValue::array();
  for (const Object& object : objects) {
    JsonValue one = JsonValue::object();
    one["at"] = object.at;
    one["type"] = object.type;
    one["name"] = object.name;
    all.push_back(std::move(one));
  }
  return all;
}

void add_objects(Table& to, std::size_t place, const char* point, const std::vector<Object>& objects) {
  for (const Object& object : objects) {
    to.add({Cell(std::to_string(place)), Cell(point), Cell(object.at), Cell(object.type), Cell(object.name)});
  }
}

void print_slaves(Context& context, const std::vector<FoundSlave>& slaves) {
  constexpr Align kRight = Align::Right;
  Table table({{"SLAVE", "position", kRight},
               {"STATE", "state"},
               {"ALIAS", "alias", kRight},
               {"VENDOR", "vendor", kRight},
               {"PRODUCT", "product", kRight},
               {"REVISION", "revision", kRight},
               {"NAME", "name"},
               {"", "inputs"},
               {"", "outputs"}});
  Table all({{"SLAVE", "", kRight}, {"POINT", ""}, {"AT", ""}, {"TYPE", ""}, {"NAME", ""}});
  for (std::size_t place = 0; place < slaves.size(); ++place) {
    const FoundSlave& slave = slaves[place];
    const auto& identity = slave.sii.identity;
    const bool is_known = slave.problem.empty();
    const auto inputs = objects_of(slave.sii.inputs);
    const auto outputs = objects_of(slave.sii.outputs);
    table.add({{std::to_string(place), place},
               Cell(std::string(to_string(slave.state))),
               {std::to_string(slave.alias), slave.alias},
               {hex(identity.vendor), identity.vendor},
               {hex(identity.product), identity.product},
               {hex(identity.revision), identity.revision},
               Cell(is_known ? slave.sii.name : slave.problem, is_known ? Style::Bold : Style::Bad),
               {"", objects_json(inputs)},
               {"", objects_json(outputs)}});
    add_objects(all, place, "input", inputs);
    add_objects(all, place, "output", outputs);
  }
  print_table(context, table, JsonValue::object(), "slaves");
  if (context.format == Format::Table && !all.empty()) {
    context.out.line("");
    print_table(context, all, JsonValue::object(), "");
  }
}

using io::ethercat::MailboxSession;
using io::ethercat::Wire;

// Waits until a frame may have come.
io::ethercat::Clock wait_for_frame(Wire& wire) {
  wire.wait(std::chrono::milliseconds(1));
  return wire.now();
}

// Opens the interface and lists the slaves there; says why not and returns the exit code if that fails.
struct Bus {
  std::unique_ptr<Wire> wire;
  std::vector<FoundSlave> slaves;
};
Result<Bus, int> open_bus(Context& context, const std::string& interface) {
  auto wire = io::ethercat::NetworkWire::open(interface);
  if (!wire) {
    context.out.error(wire.error());
    return int{kFailed};
  }
  auto found = io::ethercat::Scan((*wire)->link(), [&wire] { return wait_for_frame(**wire); }).run();
  if (!found) {
    context.out.error(fmt::format("{}: {}", interface, found.error()));
    return int{kUnreachable};
  }
  return Bus{std::move(*wire), std::move(*found)};
}

int no_such_slave(Context& context, const IoOptions& options, const Bus& bus) {
  context.out.error(fmt::format("{} has {} slaves, numbered from 0; `indurop io scan {}` lists them", options.interface,
                                bus.slaves.size(), options.interface));
  return kFailed;
}

int slave_failed(Context& context, const IoOptions& options, const Bus& bus, const std::string& why) {
  const auto place = static_cast<std::size_t>(options.slave);
  context.out.error(fmt::format("{}: slave {} ({}): {}", options.interface, place, bus.slaves[place].sii.name, why));
  return kUnreachable;
}

int objects(Context& context, const IoOptions& options) {
  const auto bus = open_bus(context, options.interface);
  if (!bus) {
    return bus.error();
  }
  const auto place = static_cast<std::size_t>(options.slave);
  if (place >= bus->slaves.size()) {
    return no_such_slave(context, options, *bus);
  }
  const FoundSlave& slave = bus->slaves[place];
  const auto found = slave.problem.empty()
                         ? io::ethercat::DictionaryReader(
                               bus->wire->link(), [&bus] { return wait_for_frame(*bus->wire); }, place, slave)
                               .run()
                         : Result<std::vector<io::ethercat::DescribedObject>, std::string>(slave.problem);
  if (!found) {
    return slave_failed(context, options, *bus, found.error());
  }
  print_objects(context, *found);
  return kOk;
}

// A session with the chosen slave and a client of its files; says why not and returns the exit code if that fails.
struct FileAccess {
  std::unique_ptr<MailboxSession> session;
  std::unique_ptr<io::ethercat::FoeClient> client;
};
Result<FileAccess, int> open_files(Context& context, const IoOptions& options, const Bus& bus) {
  const auto place = static_cast<std::size_t>(options.slave);
  if (place >= bus.slaves.size()) {
    return no_such_slave(context, options, bus);
  }
  const FoundSlave& slave = bus.slaves[place];
  FileAccess files;
  Wire& wire = *bus.wire;
  files.session = std::make_unique<MailboxSession>(
      wire.link(), [&wire] { return wait_for_frame(wire); }, place, slave);
  const auto state = options.boot ? io::ethercat::AlState::Boot : io::ethercat::AlState::PreOp;
  const std::string wrong =
      slave.problem.empty() ? files.session->open(state, io::ethercat::kProtocolFoe) : slave.problem;
  if (!wrong.empty()) {
    return slave_failed(context, options, bus, wrong);
  }
  files.client =
      std::make_unique<io::ethercat::FoeClient>(*files.session, static_cast<std::uint32_t>(options.password));
  return files;
}

int read_slave_file(Context& context, const IoOptions& options) {
  const auto bus = open_bus(context, options.interface);
  if (!bus) {
    return bus.error();
  }
  const auto files = open_files(context, options, *bus);
  if (!files) {
    return files.error();
  }
  const auto content = files->client->read(options.name);
  if (!content) {
    return slave_failed(context, options, *bus, content.error());
  }
  const std::string_view bytes(reinterpret_cast<const char*>(content->data()), content->size());
  if (const auto written = base::replace_file(options.file, bytes, base::Durable::No); !written) {
    context.out.error(base::cannot_write(options.file, written.error()));
    return kFailed;
  }
  context.out.note(fmt::format("{}: {} bytes", options.file.string(), content->size()));
  return kOk;
}

int write_slave_file(Context& context, const IoOptions& options) {
  const auto content = base::read_file(options.file);
  if (!content) {
    context.out.error(base::cannot_read(options.file, content.error()));
    return kFailed;
  }
  const auto bus = open_bus(context, options.interface);
  if (!bus) {
    return bus.error();
  }
  const auto files = open_files(context, options, *bus);
  if (!files) {
    return files.error();
  }
  const std::vector<std::uint8_t> bytes(content->begin(), content->end());
  if (const std::string wrong = files->client->write(options.name, bytes); !wrong.empty()) {
    return slave_failed(context, options, *bus, wrong);
  }
  context.out.note(fmt::format("the slave has taken {} bytes as {}", bytes.size(), options.name));
  return kOk;
}

int scan(Context& context, const IoOptions& options) {
  const auto bus = open_bus(context, options.interface);
  if (!bus) {
    return bus.error();
  }
  const std::vector<FoundSlave>& slaves = bus->slaves;
  print_slaves(context, slaves);
  if (options.file.empty()) {
    return kOk;
  }
  const std::string text = scan_file(slaves, options.interface, options.space);
  if (const auto written = base::replace_file(options.file, text, base::Durable::No); !written) {
    context.out.error(base::cannot_write(options.file, written.error()));
    return kFailed;
  }
  context.out.note(
      fmt::format("{} is written; its variables {}::* have to be declared", options.file.string(), options.space));
  return kOk;
}

Action declare_io(base::Options& app, Context& context) {
  auto options = std::make_shared<IoOptions>();
  auto request = std::make_shared<ImportRequest>();
  auto chosen = std::make_shared<Action>();
  base::Options& scanning =
      app.command("scan", "List the slaves of an EtherCAT bus and their process data",
                  [options, chosen] { *chosen = [options](Context& c) { return scan(c, *options); }; });
  scanning.add("interface", "INTERFACE", options->interface, "Network interface of the bus; two for a ring: eth1,eth2")
      .required();
  scanning.add("--write", "FILE", options->file, "Write an ioconfig.xml for them").completes(base::Completion::File);
  scanning.add("--namespace", "NAME", options->space, "Namespace of the variables in that file (default: IO)");
  add_format_option(scanning, context, {Format::Table, Format::Json, Format::Csv});
  scanning.details(
      "Reads the EEPROM of each slave by its position. No state and no output changes. The scan still sends frames\n"
      "of its own: do not scan a bus that is moving a machine. Needs root or CAP_NET_RAW.\n");
  base::Options& describing =
      app.command("objects", "List the objects of an EtherCAT slave, as it describes them itself",
                  [options, chosen] { *chosen = [options](Context& c) { return objects(c, *options); }; });
  describing
      .add("interface", "INTERFACE", options->interface, "Network interface of the bus; two for a ring: eth1,eth2")
      .required();
  describing.add("--slave", "NUMBER", options->slave, "Position on the cable, from 0 (default 0)").range(0, kMaxSlave);
  add_format_option(describing, context, {Format::Table, Format::Json, Format::Csv});
  describing.details(
      "Takes the slave to PREOP, reads its object dictionary by SDO information, and leaves it in INIT. A slave\n"
      "that a master is using is rejected. Needs root or CAP_NET_RAW.\n");
  const auto files = [&](const char* name, const char* help, int (*act)(Context&, const IoOptions&)) {
    base::Options& made = app.command(
        name, help, [options, chosen, act] { *chosen = [options, act](Context& c) { return act(c, *options); }; });
    made.add("interface", "INTERFACE", options->interface, "Network interface of the bus; two for a ring: eth1,eth2")
        .required();
    made.add("name", "NAME", options->name, "Name of the file in the slave (see its manual)").required();
    made.add("file", "FILE", options->file, "The local file").required().completes(base::Completion::File);
    made.add("--slave", "NUMBER", options->slave, "Position on the cable, from 0 (default 0)").range(0, kMaxSlave);
    made.add("--password", "NUMBER", options->password, "Password of the slave, if it has one").range(0, kMaxPassword);
    made.flag("--boot", options->boot, "Use the state BOOT, which most slaves require for firmware");
    made.details(
        "Takes the slave to PREOP or BOOT, transfers the file (FoE), and leaves it in INIT. A slave that a master "
        "runs\n"
        "is refused. Needs root or CAP_NET_RAW.\n");
  };
  files("read-file", "Read a file from an EtherCAT slave", &read_slave_file);
  files("write-file", "Write a file or firmware to an EtherCAT slave", &write_slave_file);
  base::Options& importing = app.command(
      "import", "List the devices in manufacturers' descriptions (ESI) or the variables of an FMU, for an ioconfig.xml",
      [request, chosen] { *chosen = [request](Context& c) { return import_esi(c, *request); }; });
  add_import_options(importing, *request);
  add_format_option(importing, context, {Format::Table, Format::Json, Format::Csv});
  importing.details(
      "With --write, devices in that file for which there is a description get <sync> and <set> elements if they\n"
      "have none, and the devices of --device are added. The clock mode is the device's first one, or that of\n"
      "--mode.\n"
      "An FMU (FILE.fmu) becomes a device for simulations: --write adds it to that file with its inputs and outputs\n"
      "as shared variables and its parameters as comments; --glb writes their declarations for modules.\n");
  return [chosen](Context& c) { return (*chosen)(c); };
}

}  // namespace

const Verb kIoVerb{"io", "Before it runs",
                   "Work with field devices without a node: scan an EtherCAT bus, read ESI files and FMUs",
                   "Examples:\n"
                   "  indurop io scan eth1\n"
                   "  indurop io scan eth1 --write ioconfig.xml\n"
                   "  indurop io objects eth1 --slave 2\n"
                   "  indurop io write-file eth1 firmware.efw new.efw --slave 2 --boot\n"
                   "  indurop io import drives.xml\n"
                   "  indurop io import drives.xml --write ioconfig.xml --device AKD --device AKD\n"
                   "  indurop io import press.fmu --write ioconfig.xml --glb press.glb\n",
                   &declare_io};

}  // namespace indurop::tools
