// SPDX-License-Identifier: Apache-2.0
#include "control/plc/emit/access_emitter.h"

#include <fmt/format.h>

#include <algorithm>

#include "control/plc/check/reach.h"
#include "control/plc/check/shared_names.h"
#include "control/plc/emit/cpp_text.h"
#include "control/plc/library/standard.h"

namespace indurop::plc {
namespace {

std::string cpp_of(const Reached::Step& step) {
  if (step.variable != nullptr) {
    return "." + cpp_name(std::string_view(step.variable->name));
  }
  if (step.field != nullptr) {
    return "." + step.field->member();
  }
  std::string out = step.pin != nullptr ? "." + step.pin->cpp : "";
  for (const std::uint64_t one : step.index) {
    out += fmt::format("[{}]", one);
  }
  return out;
}

// Returns ".eOpCode" for a global: the outer fields that contain the rest of the path.
std::string written_part(const Reached& reached) {
  std::string out;
  for (const Reached::Step& one : reached.steps) {
    if (one.field == nullptr) {
      break;
    }
    out += cpp_of(one);
  }
  return out;
}

void use(const Reached& reached, bool writes, TaskUse& use) {
  if (reached.global == nullptr) {
    return;
  }
  GlobalUse& one = use.globals[reached.global];
  one.read = true;
  if (writes && reached.global->kind != Global::Kind::Private) {
    one.writes.insert(written_part(reached));
  }
}

bool uses(const TaskPlan& task, const Global& global) {
  const auto pous = reached_by(task);
  return std::any_of(pous.begin(), pous.end(), [&](const Pou* one) { return one->globals.contains(&global); });
}

// Returns whether this task handles the access; for a global that is the first task that uses it.
bool belongs(const Program& program, const TaskPlan& task, const Reached& to) {
  if (to.global == nullptr) {
    return false;
  }
  const auto first = std::find_if(program.tasks.begin(), program.tasks.end(),
                                  [&](const TaskPlan& one) { return uses(one, *to.global); });
  return first == program.tasks.end() ? &task == &program.tasks.front() : &*first == &task;
}

bool is_meant(const TaskProgram& one, const Reached& to) {
  return one.pou == to.program && (to.instance == nullptr || to.instance == one.declared);
}

std::size_t instances_of(const Program& program, const Pou& pou) {
  std::size_t count = 0;
  for (const TaskPlan& task : program.tasks) {
    count += static_cast<std::size_t>(std::count_if(task.programs.begin(), task.programs.end(),
                                                    [&](const TaskProgram& one) { return one.pou == &pou; }));
  }
  return count;
}

}  // namespace

std::string cpp_of(const Reached& reached, const TaskPlan& task) {
  std::string out;
  if (reached.global != nullptr) {
    out = (in_image(*reached.global) ? "shared." : "plc::") + cpp_name(*reached.global);
  } else {
    const auto instance = std::find_if(task.programs.begin(), task.programs.end(),
                                       [&](const TaskProgram& one) { return is_meant(one, reached); });
    out = instance_of(*instance);
  }
  for (const Reached::Step& one : reached.steps) {
    out += cpp_of(one);
  }
  return out;
}

void find_accesses(const Program& program, const TaskPlan& task, TaskUse& use) {
  for (const AccessPath& one : program.accesses) {
    const auto add = [&](const std::string& name, const std::string& cpp) {
      use.accesses.push_back({cpp, name, program.space + "::" + name_of_shared(name), &one});
      plc::use(one.to, one.writable, use);
    };
    if (belongs(program, task, one.to)) {
      add(one.name, cpp_of(one.to, task));
    }
    for (const TaskProgram& each : task.programs) {
      if (one.to.global == nullptr && is_meant(each, one.to)) {
        Reached to = one.to;
        to.instance = each.declared;
        const bool several = one.of_each_instance && instances_of(program, *each.pou) > 1;
        add(several ? each.instance + "_" + one.name : one.name, cpp_of(to, task));
      }
    }
  }
  for (const TaskProgram& one : task.programs) {
    const auto found = program.connections.find(one.declared);
    for (const ConnectedPin& pin : found == program.connections.end() ? std::vector<ConnectedPin>{} : found->second) {
      plc::use(pin.other, pin.parameter->section == ast::Section::Output, use);
    }
  }
  if (task.single != nullptr && task.periodic) {
    use.globals[task.single].read = true;
  }
}

void declare_accesses(const TaskUse& use, TextWriter& out) {
  for (const SharedAccess& one : use.accesses) {
    out.line(fmt::format("iec::Access<{}, {}> access_{};", cpp_type(*one.path->type), one.path->writable, one.name));
  }
}

void read_accesses(const TaskUse& use, TextWriter& out) {
  for (const SharedAccess& one : use.accesses) {
    if (one.path->writable) {
      out.line(fmt::format("access_{}.read(::{}, {});", one.name, one.shared_name, one.cpp));
    }
  }
}

void write_accesses(const TaskUse& use, TextWriter& out) {
  for (const SharedAccess& one : use.accesses) {
    out.line(fmt::format("access_{}.write(::{}, {});", one.name, one.shared_name, one.cpp));
  }
}

void call_program(const Program& program, const TaskPlan& task, const TaskProgram& one, TextWriter& out) {
  const std::string instance = instance_of(one);
  const auto found = program.connections.find(one.declared);
  const std::vector<ConnectedPin> none;
  const auto& pins = found == program.connections.end() ? none : found->second;
  const auto member = [&](const ConnectedPin& pin) {
    return instance + "." + cpp_name(std::string_view(pin.parameter->name));
  };
  for (const ConnectedPin& pin : pins) {
    if (pin.value != nullptr) {
      out.line(fmt::format("{} = {};", member(pin), cpp_initial(*pin.parameter->type, pin.value)));
    } else if (pin.parameter->section == ast::Section::Input) {
      out.line(fmt::format("iec::copy_value({}, {});", member(pin), cpp_of(pin.other, task)));
    }
  }
  out.line(instance + "(scan);");
  for (const ConnectedPin& pin : pins) {
    if (pin.parameter->section == ast::Section::Output) {
      out.line(fmt::format("iec::copy_value({}, {});", cpp_of(pin.other, task), member(pin)));
    }
  }
}

}  // namespace indurop::plc
