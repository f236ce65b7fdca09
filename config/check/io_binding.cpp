// SPDX-License-Identifier: Apache-2.0
// Binds the points of ioconfig.xml to variables of the node: the variable must exist and be able to hold the value.

#include "config/check/io_binding.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "config/check/io_fmu.h"
#include "core/base/diagnostics.h"
#include "core/base/text.h"
#include "core/schema/place_index.h"

namespace indurop::config {
namespace {

bool is_number(const schema::Type& type) {
  return type.dims.empty() && type.base != schema::Base::Text && type.base != schema::Base::Struct;
}
bool is_whole(const schema::Type& type) {
  return is_number(type) && type.base != schema::Base::Float && type.base != schema::Base::Double;
}

class Binder {
 public:
  Binder(const schema::Schema& schema, base::Diagnostics& report, std::vector<base::Diagnostic>& all)
      : index_(schema), report_(report), all_(all) {}

  BoundDevice bind(const IoDevice& device) {
    BoundDevice bound;
    bound.device = device;
    bound.quality = whole(device.quality, device.quality_place, "quality");
    bound.errors = whole(device.errors, device.errors_place, "errors");
    bound.cut = whole(device.cut, device.cut_place, "cut");
    bound.cable_errors = whole(device.cable_errors, device.cable_errors_place, "cable_errors");
    for (const IoPoint& point : device.driver == IoDriver::Fmu ? fmu_points(device) : device.points) {
      add(point, bound);
    }
    if (has_objects(device.driver)) {
      add_struct(device.axis.in, device.axis.in_place, false, bound);
      add_struct(device.axis.out, device.axis.out_place, true, bound);
    }
    check_copies(bound);
    return bound;
  }

 private:
  std::vector<IoPoint> fmu_points(const IoDevice& device) {
    FmuPoints read = read_fmu_points(device, report_);
    all_.insert(all_.end(), read.diagnostics.begin(), read.diagnostics.end());
    return std::move(read.points);
  }

  std::optional<schema::Place> find(const std::string& name, base::SourcePlace place) {
    auto found = index_.find(name, report_.full() ? schema::NearestName::Skip : schema::NearestName::Search);
    if (!found) {
      report_.error(place, found.error().message);
      return std::nullopt;
    }
    return std::move(found).value();
  }

  // Reserves a variable for the I/O module as its writer; an error if two points write the same part.
  void claim(const schema::Place& part, const std::string& as_written, base::SourcePlace place) {
    const auto [first, is_new] = claimed_.try_emplace({part.variable->name, part.offset}, place);
    if (!is_new) {
      report_.error(place, fmt::format("{} is written by line {} already; one variable has one input",
                                       base::in_quotes(as_written), first->second.line));
    }
  }

  std::optional<schema::Place> whole(const std::string& name, base::SourcePlace place, const char* what) {
    if (name.empty()) {
      return std::nullopt;
    }
    auto found = find(name, place);
    if (found && !is_whole(found->type)) {
      report_.error(place, fmt::format("{}: {} is {}; it must be a whole number", what, base::in_quotes(name),
                                       schema::display_name(found->type)));
      return std::nullopt;
    }
    if (found) {
      claim(*found, name, place);
    }
    return found;
  }

  void add(const IoPoint& point, BoundDevice& into) {
    if (point.variable.empty()) {
      return;
    }
    auto variable = find(point.variable, point.variable_place);
    auto quality = whole(point.quality, point.quality_place, "quality");
    if (!variable) {
      return;
    }
    if (point.is_text && (variable->type.base != schema::Base::Text || !variable->type.dims.empty())) {
      report_.error(point.variable_place,
                    fmt::format("{} is {}; for a text it must be one, char[80] for example",
                                base::in_quotes(point.variable), schema::display_name(variable->type)));
      return;
    }
    if (!point.is_text && !is_number(variable->type)) {
      report_.error(point.variable_place,
                    fmt::format("{} is {}, a point is one number; name a part of it{}", base::in_quotes(point.variable),
                                schema::display_name(variable->type), example_part(point.variable, variable->type)));
      return;
    }
    if (!point.output) {
      claim(*variable, point.variable, point.variable_place);
    }
    into.points.push_back({point, std::move(*variable), std::move(quality)});
  }

  static std::string example_part(const std::string& name, const schema::Type& type) {
    if (!type.dims.empty()) {
      return ", " + base::in_quotes(name + "[0]");
    }
    return type.fields.empty() ? "" : ", " + base::in_quotes(name + "." + type.fields.front().name);
  }

  // in="AXIS1_IN": adds one point for each object for which the struct has a field.
  void add_struct(const std::string& name, base::SourcePlace place, bool output, BoundDevice& into) {
    if (name.empty()) {
      return;
    }
    const auto whole = find(name, place);
    if (!whole) {
      return;
    }
    std::vector<std::string> objects;
    std::size_t found = 0;
    for (const AxisObject& object : kAxisObjects) {
      if (object.output != output || (object.object.index == 0 && into.device.driver == IoDriver::Ethercat)) {
        continue;
      }
      objects.emplace_back(object.name);
      const auto field = std::find_if(whole->type.fields.begin(), whole->type.fields.end(),
                                      [&](const schema::Field& f) { return f.name == object.name; });
      if (!whole->type.dims.empty() || field == whole->type.fields.end()) {
        continue;
      }
      ++found;
      IoPoint point;
      point.output = output;
      point.variable = name + "." + object.name;
      point.at = object.name;
      point.object = object.object;
      point.type = WireType::Int32;
      point.place = point.variable_place = point.at_place = place;
      add(point, into);
    }
    if (found == 0) {
      report_.error(place, fmt::format("{} is {}; it must be a struct with fields named {}", base::in_quotes(name),
                                       schema::display_name(whole->type), base::enumerate(objects)));
    }
  }

  // An output that a <copy> writes, too. What ranges and PDOs contain only their slave knows.
  void check_copies(const BoundDevice& bound) {
    for (const IoCopy& copy : bound.device.slave.copies) {
      const auto point = std::find_if(bound.points.begin(), bound.points.end(), [&copy](const BoundPoint& other) {
        return other.point.output && is_same(other.point.object, copy.target.first);
      });
      if (point != bound.points.end()) {
        report_.error(copy.target.place, fmt::format("to: {} is written by the output in line {} already; remove one",
                                                     base::in_quotes(copy.target.at), point->point.place.line));
      }
    }
  }

  schema::PlaceIndex index_;
  base::Diagnostics& report_;
  std::vector<base::Diagnostic>& all_;                                          // of other files, too
  std::map<std::pair<std::string, std::uint32_t>, base::SourcePlace> claimed_;  // parts of variables that are written
};

}  // namespace

std::vector<BoundDevice> bind_io(const IoConfig& config, const schema::Schema& schema,
                                 std::vector<base::Diagnostic>& diagnostics) {
  base::Diagnostics report(config.file.string(), diagnostics);
  Binder binder(schema, report, diagnostics);
  std::vector<BoundDevice> bound;
  for (const IoDevice& device : config.devices) {
    bound.push_back(binder.bind(device));
  }
  report.add_summary(diagnostics);
  return bound;
}

}  // namespace indurop::config
