// SPDX-License-Identifier: Apache-2.0
// Any bytes as module.xml, as manifest of a plant and as ioconfig.xml: read, checked, adjusted, planned in every form.
// Besides not crashing: what is wrong has a place inside the text, a diagnostic is one line, and an adjusted schedule
// keeps the minimum period.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "config/check/check_plant.h"
#include "config/check/io_binding.h"
#include "config/plan/plan.h"
#include "config/xml/io_reader.h"
#include "config/xml/plant_reader.h"
#include "config/xml/reader.h"

namespace {

using namespace indurop::config;  // NOLINT(google-build-using-namespace)

void require(bool condition) {
  if (!condition) {
    std::abort();
  }
}

void check_diagnostics(const std::vector<indurop::base::Diagnostic>& diagnostics, std::string_view text) {
  const auto lines = std::count(text.begin(), text.end(), '\n') + 1;
  for (const indurop::base::Diagnostic& d : diagnostics) {
    require(d.place.line >= 0 && d.place.line <= lines);
    require(d.place.column >= 0 && d.place.column <= static_cast<long>(text.size()) + 1);
    require(!d.text.empty() && to_string(d).find('\n') == std::string::npos);
  }
}

// Tables of thousands of basic periods only cost time.
bool is_small(const CheckResult& check) {
  return check.table.slot_count < 500;
}

void plan(const Config& config, const CheckResult& check) {
  if (is_small(check)) {
    require(!plan_table(config, check).empty());
    require(!plan_csv(config, check).empty());
    require(!plan_json(config, check).empty());
    require(!plan_svg(config, check).empty());
  }
}

void fuzz_config(std::string_view text) {
  ReadResult read = read_config_text(text, "in.xml");
  check_diagnostics(read.diagnostics, text);
  if (!read.ok()) {
    return;
  }
  const CheckResult check = check_config(read.config, {.files = false, .adjust = false});
  check_diagnostics(check.diagnostics, text);
  plan(read.config, check);
  const CheckResult adjusted = check_config(read.config, {.files = false, .adjust = true});
  require(adjusted.periodic.empty() || adjusted.table.slots.empty() ||
          adjusted.table.basic_period >= read.config.minimum_period.value_or(kDefaultMinimumPeriod));
  plan(read.config, adjusted);
}

// Module files are looked for too: there are none of these names.
void fuzz_plant(std::string_view text) {
  ReadPlant read = read_plant_text(text, "/nowhere/in.xml");
  check_diagnostics(read.diagnostics, text);
  if (!read.ok()) {
    return;
  }
  require(!read.plant.name.empty() && !read.plant.boards.empty());
  require(read.plant.types.size() == read.plant.type_places.size());
  const PlantCheck schedules = check_plant(read.plant, {.files = false, .adjust = true});
  check_diagnostics(schedules.diagnostics, text);
  const PlantCheck check = check_plant(read.plant, {});
  check_diagnostics(check.diagnostics, text);
  require(check.boards.size() == read.plant.boards.size() && check.routes.empty());
  if (std::all_of(schedules.boards.begin(), schedules.boards.end(), is_small)) {
    require(!plan_table(read.plant, schedules).empty());
    require(!plan_csv(read.plant, schedules).empty());
    require(!plan_json(read.plant, schedules).empty());
    require(!plan_svg(read.plant, schedules).empty());
  }
}

// There are no variables, so every name is a wrong one.
void fuzz_io(std::string_view text) {
  ReadIo read = read_io_config_text(text, "in.xml");
  const auto bound = bind_io(read.config, {}, read.diagnostics);
  check_diagnostics(read.diagnostics, text);
  require(bound.size() == read.config.devices.size());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  fuzz_config(text);
  fuzz_plant(text);
  fuzz_io(text);
  return 0;
}
