// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/robot/identifying.h"

#include <fmt/format.h>

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "control/robot/files/identify.h"
#include "history/recording/idl_layout.h"
#include "history/recording/mcap_reader.h"
#include "tools/console/diagnostics.h"

namespace indurop::tools {
namespace {

using base::Problem;

// Where the numbers of each axis are among the leaves of AXIS_STATE.
struct AxisPlaces {
  std::size_t position = 0, velocity = 0, acceleration = 0, torque = 0;
};

std::vector<AxisPlaces> places_of(const std::vector<recording::IdlLeaf>& layout) {
  std::map<std::string, std::size_t> places;
  for (std::size_t i = 0; i < layout.size(); ++i) {
    places.emplace(layout[i].name, i);
  }
  std::vector<AxisPlaces> axes;
  for (;;) {
    std::vector<std::size_t> found;
    for (const char* field : {"dCommand", "dVelocity", "dAcceleration", "dTorque"}) {
      const auto place = places.find(fmt::format("[{}].{}", axes.size(), field));
      if (place == places.end()) {
        return axes;
      }
      found.push_back(place->second);
    }
    axes.push_back({found[0], found[1], found[2], found[3]});
  }
}

Result<std::vector<robot::ArmSample>, Problem> samples_of(const std::string& file, const std::string& variable) {
  auto reader = recording::McapReader::open(file);
  if (!reader) {
    return std::move(reader).error();
  }
  std::vector<robot::ArmSample> samples;
  std::optional<std::uint16_t> wanted;
  std::vector<recording::IdlLeaf> layout;
  for (const auto& [id, channel] : reader->contents().channels) {
    const auto schema = reader->contents().schemas.find(channel.schema);
    if (channel.topic != variable || schema == reader->contents().schemas.end()) {
      continue;
    }
    auto read = recording::idl_layout(schema->second.data, schema->second.name);
    if (!read) {
      return std::move(read).error();
    }
    wanted = id;
    layout = std::move(read).value();
  }
  const std::vector<AxisPlaces> axes = places_of(layout);
  if (axes.empty()) {
    return Problem{fmt::format("the recording has no {}; indurop record {} records it", variable, variable)};
  }
  std::vector<double> values;
  reader->each([&](const recording::McapMessage& message) {
    if (message.channel == *wanted && recording::read_leaves(layout, message.data.view, values)) {
      robot::ArmSample sample;
      for (const AxisPlaces& axis : axes) {
        sample.push_back(
            {values[axis.position], values[axis.velocity], values[axis.acceleration], values[axis.torque]});
      }
      samples.push_back(std::move(sample));
    }
  });
  return samples;
}

void print_result(Context& context, const robot::Identified& found) {
  const auto& [x, y, z] = found.centre;
  Table table({{"AXIS", "axis", Align::Right},
               {"DRY FRICTION", "dry", Align::Right},
               {"WITHIN", "dry_within", Align::Right},
               {"DAMPING", "damping", Align::Right},
               {"WITHIN", "damping_within", Align::Right},
               {"REST", "rest", Align::Right},
               {"SAMPLES", "samples", Align::Right}});
  const auto number = [](double value, int digits) {
    return Cell(fmt::format("{:.{}f}", value, digits), JsonValue(value));
  };
  for (std::size_t i = 0; i < found.axes.size(); ++i) {
    const robot::Identified::Axis& axis = found.axes[i];
    table.add({Cell(std::to_string(i + 1), JsonValue(i + 1)), number(axis.dry.value, 2), number(axis.dry.within, 2),
               number(axis.damping.value, 2), number(axis.damping.within, 2), number(axis.rest, 2),
               Cell(std::to_string(axis.count), JsonValue(axis.count))});
  }
  if (context.format == Format::Table) {
    context.out.line(
        fmt::format("LOAD {:.3f} kg CENTRE {:.1f} {:.1f} {:.1f}", found.mass.value, x.value, y.value, z.value));
    context.out.note(
        fmt::format("within {:.3f} kg and {:.1f} {:.1f} {:.1f} mm; a tool is included. Friction in N m and "
                    "N m s/rad (N and N s/m), as in <dynamics friction damping>",
                    found.mass.within, x.within, y.within, z.within));
  }
  print_table(
      context, table,
      {{"mass", found.mass.value}, {"mass_within", found.mass.within}, {"x", x.value}, {"y", y.value}, {"z", z.value}},
      "axes");
}

}  // namespace

int identify_load(Context& context, const RobotChoice& choice, const std::string& recording) {
  const auto files = choice.config.empty() ? files_of_node(context.node, choice, false) : files_of_config(choice);
  if (!files) {
    return report(context.out, files.error());
  }
  const auto samples = samples_of(recording, choice.space + "::AXIS_STATE");
  if (!samples) {
    context.out.error(samples.error().text);
    return kFailed;
  }
  const robot::Identified found = robot::identify(files->names.urdf, files->names.rotor_inertia, *samples);
  if (!found.errors.empty()) {
    print_diagnostics(context, found.errors, false);
    return kCheckFailed;
  }
  if (!found.problem.empty()) {
    context.out.error(found.problem);
    return kFailed;
  }
  print_result(context, found);
  return kOk;
}

}  // namespace indurop::tools
