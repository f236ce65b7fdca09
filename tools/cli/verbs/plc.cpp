// SPDX-License-Identifier: Apache-2.0
// indurop plc: PLC programs (IEC 61131-3).
#include "tools/cli/plc/plc_build.h"
#include "tools/cli/plc/plc_coverage.h"
#include "tools/cli/plc/plc_debug.h"
#include "tools/cli/plc/plc_export.h"
#include "tools/cli/plc/plc_print.h"
#include "tools/cli/plc/plc_watch.h"
#include "tools/cli/verbs/verbs.h"

namespace indurop::tools {
namespace {

Action declare_plc(base::Options& app, Context& context) {
  auto chosen = std::make_shared<Action>();
  add_plc_build(app, chosen);
  add_plc_coverage(app, context, chosen);
  add_plc_debug(app, chosen);
  add_plc_export(app, chosen);
  add_plc_print(app, chosen);
  add_plc_watch(app, context, chosen);
  return [chosen](Context& c) { return (*chosen)(c); };
}

}  // namespace

const Verb kPlcVerb{
    "plc", "Before it runs", "Check, build, debug, export, print and watch PLC programs; show test coverage",
    "Programs are Structured Text (.st), or PLCopen TC6 XML as exported by Beremiz, the OpenPLC editor and\n"
    "CODESYS. build prints the module entries for module.xml; each TASK becomes one module.\n"
    "Exit code 0, 4 if the program has errors, 1 if it could not be built.\n"
    "Examples:\n"
    "  indurop plc build motor.st -o build\n"
    "  indurop plc print conveyor.xml --pou main --svg conveyor.svg\n"
    "  indurop plc export motor.st -o motor.xml\n"
    "  indurop plc build conveyor.xml --watch\n"
    "  indurop plc watch conveyor.xml\n"
    "  indurop plc debug motor.st\n"
    "  indurop plc coverage coverage --lcov coverage.info\n",
    &declare_plc};

}  // namespace indurop::tools
