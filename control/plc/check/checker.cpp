// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/checker.h"

#include <utility>

#include "control/plc/check/access_paths.h"
#include "control/plc/check/configured.h"
#include "control/plc/check/constant_order.h"
#include "control/plc/check/enable.h"
#include "control/plc/check/foreign_types.h"
#include "control/plc/check/global_table.h"
#include "control/plc/check/identifier_checker.h"
#include "control/plc/check/instance_sizes.h"
#include "control/plc/check/instance_structs.h"
#include "control/plc/check/namespaces.h"
#include "control/plc/check/object_checker.h"
#include "control/plc/check/pou_checker.h"
#include "control/plc/check/shared_names.h"
#include "control/plc/check/stack_use.h"
#include "control/plc/check/starts.h"
#include "control/plc/check/task_checker.h"
#include "control/plc/check/type_builder.h"

namespace indurop::plc {
namespace {

// Constants that bounds of types may need are declared before the types, all others after them.
void declare_globals(Context& context, bool before_types) {
  const auto declare = [&](std::vector<ast::Variable>& variables) {
    for (ast::Variable& one : variables) {
      const bool early = one.constant && one.type.kind == ast::TypeSpec::Kind::Elementary;
      if (early == before_types) {
        declare_global(context, one);
      }
    }
  };
  Project& project = context.program.project;
  declare(project.globals);
  for (Configuration& configuration : project.configurations) {
    declare(configuration.globals);
    for (Resource& resource : configuration.resources) {
      declare(resource.globals);
    }
  }
}

}  // namespace

std::unique_ptr<Program> check(Project project, CheckOptions options, Diagnostics& diagnostics) {
  auto program = std::make_unique<Program>();
  program->project = std::move(project);
  program->foreign = std::move(options.foreign);
  program->space = std::move(options.space);
  program->library = options.library;
  program->infinite_division = options.infinite_division;
  index_foreign(*program);
  Context context{*program, diagnostics};
  resolve_namespaces(program->project, diagnostics);
  make_instance_structs(program->project, diagnostics);
  declare_enable_outputs(program->project);
  check_identifiers(context);
  declare_pous(context);
  declare_objects(context);
  order_constants(context.program.project, diagnostics);
  declare_globals(context, true);
  declare_types(context);
  declare_globals(context, false);
  apply_configured(context);
  declare_variables(context);
  if (!measure_instances(context)) {
    return program;
  }
  declare_starts(context);
  resolve_accesses(context);
  check_objects(context);
  name_types(context);
  check_bodies(context);
  use_starts(context);
  order_pous(context);
  check_stack(context);
  plan_tasks(context);
  return program;
}

}  // namespace indurop::plc
