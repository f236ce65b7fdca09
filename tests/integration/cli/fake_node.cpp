// SPDX-License-Identifier: Apache-2.0
// Stands for a node in tests of the tools: has its lock, store and run block and moves numbers, but runs no modules.
// fake_node NAME [ignore-term] [config FILE] [many COUNT] [robot]   with `many` it has COUNT numbers more, many::v0 on,
// with `robot` arm::ROBOT_JOG; prints "ready" when everything is there; ends at SIGTERM.

#include <sys/prctl.h>
#include <unistd.h>
#include <csignal>

#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "core/rt/clock.h"
#include "core/schema/schema.h"
#include "scheduler/run_block_setup.h"
#include "scheduler/statistics.h"
#include "store/runtime/message_ring.h"
#include "store/vars/custody.h"
#include "store/vars/node_lock.h"
#include "store/vars/process.h"
#include "store/vars/run_file.h"
#include "store/vars/store.h"

namespace {

using namespace indurop;

volatile sig_atomic_t stop_asked = 0;
void on_term(int /*signal*/) {
  stop_asked = 1;
}

schema::Type scalar(schema::Base base) {
  schema::Type type;
  type.base = base;
  type.element_size = schema::size_of(base);
  type.align = type.element_size;
  return type;
}

schema::Variable variable(const std::string& name, schema::Type type) {
  schema::Variable out;
  out.name = name;
  const bool small = type.dims.empty() && type.base != schema::Base::Struct && type.base != schema::Base::Text;
  out.kind = small ? abi::Kind::Scalar : abi::Kind::Ring;
  out.type = std::move(type);
  out.type_hash = schema::hash_of(out.type);
  return out;
}

template <class T>
void set_initial(schema::Variable& to, T value) {
  to.initial.resize(sizeof value);
  std::memcpy(to.initial.data(), &value, sizeof value);
}

// What robots have to be moved by hand with (examples/robot_cell/plc_robot.glb).
schema::Variable switch_of_a_robot() {
  schema::Type jog;
  jog.base = schema::Base::Struct;
  jog.name = "arm::ROBOT_JOG_t";
  jog.element_size = 96;
  jog.align = 8;
  const auto add = [&jog](const char* name, schema::Base base, std::uint32_t offset) -> schema::Field& {
    schema::Field field;
    field.name = name;
    field.type = scalar(base);
    field.offset = offset;
    jog.fields.push_back(field);
    return jog.fields.back();
  };
  add("bEnable", schema::Base::Int16, 0);
  add("eFrame", schema::Base::Int16, 2);
  add("dSpeed", schema::Base::Double, 8).type.dims = {6};
  add("nBeat", schema::Base::UInt32, 56);
  schema::Type& frame = add("frame", schema::Base::Text, 60).type;
  frame.text_size = frame.element_size = 32;
  frame.align = 1;
  return variable("arm::ROBOT_JOG", jog);
}

schema::Schema make_schema(int many, bool robot) {
  schema::Schema schema;
  schema::Type joint;
  joint.base = schema::Base::Struct;
  joint.name = "knu::Robot::joints_t";
  joint.element_size = 24;
  joint.align = 8;
  for (const char* name : {"x", "y", "z"}) {
    schema::Field field;
    field.name = name;
    field.type = scalar(schema::Base::Double);
    field.offset = static_cast<std::uint32_t>(joint.fields.size() * 8);
    field.unit = "deg";
    joint.fields.push_back(field);
  }
  joint.fields[1].range = schema::Range{-180, 180};
  joint.dims = {10};
  schema.variables.push_back(variable("knu::Robot::tick", scalar(schema::Base::UInt32)));
  schema.variables.push_back(variable("knu::Robot::joints", joint));

  auto gain = variable("knu::Robot::gain", scalar(schema::Base::Double));
  gain.range = schema::Range{0, 10};
  gain.unit = "mm";
  gain.description = "amplitude";
  set_initial(gain, 1.0);
  gain.given = true;
  schema.variables.push_back(gain);

  schema::Type mode = scalar(schema::Base::Enum);
  mode.name = "knu::Robot::mode_t";
  mode.enumerators = {{"OFF", 0}, {"AUTO", 1}, {"MANUAL", 2}};
  schema.variables.push_back(variable("knu::Robot::mode", mode));

  schema::Type text;
  text.base = schema::Base::Text;
  text.text_size = 16;
  text.element_size = 16;
  schema.variables.push_back(variable("station::name", text));

  auto oil = variable("press::oil", scalar(schema::Base::Double));
  oil.unit = "degC";
  oil.alarms.push_back({"the oil is too hot", schema::Priority::High, schema::Comparison::Greater, 80, 5, 0});
  schema.variables.push_back(oil);
  auto door = variable("press::door_open", scalar(schema::Base::Bool));
  door.alarms.push_back({"the door is open", schema::Priority::Medium, schema::Comparison::Equal, 1, 0, 0});
  schema.variables.push_back(door);

  auto starts = variable("station::starts", scalar(schema::Base::Int32));
  starts.retain = true;
  set_initial(starts, std::int32_t{5});
  schema.variables.push_back(starts);
  if (robot) {
    schema.variables.push_back(switch_of_a_robot());
  }
  for (int i = 0; i < many; ++i) {
    schema.variables.push_back(variable("many::v" + std::to_string(i), scalar(schema::Base::Double)));
  }
  return schema;
}

scheduler::RunBlockSetup make_setup(const std::string& node, const std::string& config) {
  scheduler::RunBlockSetup setup;
  setup.node_name = node;
  setup.config_file = config;
  setup.basic_period_ns = 1'000'000;
  setup.macro_period_ns = 2'000'000;
  setup.slot_count = 2;
  setup.modules.resize(3);
  setup.modules[0].name = "modify";
  setup.modules[0].period_ns = 1'000'000;
  setup.modules[0].priority = 1;
  setup.modules[1].name = "output";
  setup.modules[1].type = scheduler::ModuleType::Process;
  setup.modules[1].period_ns = 2'000'000;
  setup.modules[1].priority = 2;
  setup.modules[2].name = "show";
  setup.modules[2].type = scheduler::ModuleType::Process;
  setup.modules[2].operation = scheduler::Operation::NonReal;
  return setup;
}

void fill(scheduler::RunBlock& block) {
  block.obtained.tick_core = -1;
  std::strcpy(block.obtained.why, "SCHED_FIFO refused: see indurop doctor");
  for (std::uint32_t i = 0; i < 3; ++i) {
    block.modules()[i].state.store(scheduler::ModuleState::Running);
  }
  auto& output = block.modules()[1];
  std::strcpy(output.last_fault, "SIGSEGV at address 0x0");
  output.fault_tick.store(42);
  output.faults.store(1);
  output.restarts.store(1);
  output.fault_kind.store(static_cast<std::uint32_t>(scheduler::FaultKind::Signal));
  output.overruns.store(1);
  scheduler::log_overrun(block, {41, 1, 1'200'000, 30'000, 0, 2'500'000, true});
}

// One round of 1 ms: both modules "run", tick and joints move.
void step(scheduler::RunBlock& block, vars::Store& store, std::uint64_t tick, std::int64_t grid_ns,
          std::vector<scheduler::JitterReference>& jitter) {
  const std::int64_t late = 1'000 + static_cast<std::int64_t>(tick * 37 % 400);
  for (std::uint32_t i = 0; i < 2; ++i) {
    if (tick % (i + 1) == 0) {
      const scheduler::RunTimes times{grid_ns, grid_ns + late * (i + 1), grid_ns + late * (i + 1) + 20'000};
      scheduler::account_run(block.modules()[i], jitter[i], times);
      scheduler::log_slot(block, {tick, i, times});
    }
  }
  if (tick == 43) {
    static_cast<void>(runtime::push_message(block, 0, "the gripper \x1b[31mis open\n", rt::mono_time(grid_ns)));
  }
  scheduler::add_sample(block.tick_lateness, late);
  const auto put = [&store](const char* name, std::uint32_t offset, const auto& value) {
    const auto* entry = store.find(abi::fnv1a64(name, std::strlen(name)));
    std::uint8_t bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    return store.write(*entry, offset, bytes).ok();
  };
  static_cast<void>(put("knu::Robot::tick", 0, static_cast<std::uint32_t>(tick)));
  static_cast<void>(put("knu::Robot::joints", 0, static_cast<double>(tick) * 0.5));
  constexpr std::uint64_t kTicksPerMany = 20;  // each 20 ms
  for (const auto& entry : tick % kTicksPerMany == 0 ? store.directory() : std::span<const vars::DirectoryEntry>()) {
    const std::string& name = store.schema().variables[entry.schema_index].name;
    if (name.starts_with("many::")) {
      static_cast<void>(put(name.c_str(), 0, static_cast<double>(tick)));
    }
  }
  store.beat(rt::MonoClock::now());
  block.tick.store(tick + 1);
}

int run(const std::string& node, const std::string& config, int many, bool robot) {
  pid_t holder = 0;
  const auto lock = vars::NodeLock::acquire(node, holder);
  auto store = vars::Store::create(node, make_schema(many, robot));
  const auto setup = make_setup(node, config);
  auto file = vars::RunFile::create(node, scheduler::run_block_size(setup));
  if (!lock.ok() || !store.ok() || !file.ok() || !vars::Custody::create(node).ok()) {
    std::fprintf(stderr, "fake_node: cannot set up\n");
    return 1;
  }
  auto& block = *static_cast<scheduler::RunBlock*>(file.value().data());
  block.node_pid.store(getpid());
  block.node_start_time = vars::process_start_time(getpid());
  block.state.store(scheduler::NodeState::Running);
  block.epoch_ns = rt::now_ns();
  scheduler::init_run_block(block, setup);
  fill(block);
  std::vector<scheduler::JitterReference> jitter(2);
  const std::int64_t begin = rt::now_ns();
  for (std::uint64_t tick = 0; stop_asked == 0; ++tick) {
    const std::int64_t grid = begin + static_cast<std::int64_t>(tick) * setup.basic_period_ns;
    rt::sleep_until(grid);
    step(block, store.value(), tick, grid, jitter);
    if (tick == 20) {
      std::puts("ready");
      std::fflush(stdout);
    }
  }
  block.state.store(scheduler::NodeState::Stopped);
  std::strcpy(block.stop_reason, "SIGTERM");
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  std::string config = "module.xml";
  bool ignore = false;
  int many = 0;
  bool robot = false;
  for (int i = 2; i < argc; ++i) {
    ignore = ignore || std::string(argv[i]) == "ignore-term";
    robot = robot || std::string(argv[i]) == "robot";
    if (std::string(argv[i]) == "config" && i + 1 < argc) {
      config = argv[i + 1];
    }
    if (std::string(argv[i]) == "many" && i + 1 < argc) {
      many = std::stoi(argv[i + 1]);
    }
  }
  signal(SIGTERM, ignore ? SIG_IGN : &on_term);
  return argc > 1 ? run(argv[1], config, many, robot) : 2;
}
