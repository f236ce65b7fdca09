// SPDX-License-Identifier: Apache-2.0
// `indurop io import press.fmu`: lists the variables of an FMU, and writes what a configuration needs to run it.

#pragma once

#include "tools/cli/fieldbus/import_esi.h"

namespace indurop::tools {

// True if the request names FMUs instead of ESI files.
bool names_fmus(const ImportRequest& request);
int import_fmu(Context& context, const ImportRequest& request);

}  // namespace indurop::tools
