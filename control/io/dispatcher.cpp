// SPDX-License-Identifier: Apache-2.0
#include "control/io/dispatcher.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "config/xml/io_reader.h"

namespace indurop::io {

namespace {

base::Diagnostic cannot_be_split(const config::IoDevice& device, const std::filesystem::path& file) {
  return {base::Diagnostic::Severity::Error, file.string(), device.place,
          fmt::format("the inputs and outputs of {} device {} cannot be split among two modules; give the module that "
                      "runs it a file of its own, without phase",
                      config::name_of(device.driver), device.name)};
}

}  // namespace

Dispatcher::Made Dispatcher::make(const std::filesystem::path& file, const schema::Schema& schema, Phase phase,
                                  const MakeWires& simulated) {
  config::ReadIo read = config::read_io_config(file);
  const auto bound = config::bind_io(read.config, schema, read.diagnostics);
  Made made{nullptr, std::move(read.diagnostics)};
  if (base::has_error(made.diagnostics)) {
    return made;
  }
  for (const config::IoDevice& device : read.config.devices) {
    if (!simulated && device.driver == config::IoDriver::Fmu) {
      made.diagnostics.push_back(
          {base::Diagnostic::Severity::Error, file.string(), device.place,
           fmt::format("device {} is an FMU, which may wait and allocate: it runs in simulations "
                       "only (indurop run --sim). For real time, name the real device",
                       device.name)});
    }
  }
  if (base::has_error(made.diagnostics)) {
    return made;
  }
  std::unique_ptr<Dispatcher> dispatcher(new Dispatcher);  // NOLINT: the constructor is private
  if (simulated) {
    auto wires = simulated(read.config);
    if (!wires) {
      made.diagnostics.insert(made.diagnostics.end(), wires.error().begin(), wires.error().end());
      return made;
    }
    dispatcher->buses_.wires = std::move(*wires);
  }
  for (const config::BoundDevice& device : bound) {
    std::vector<base::Diagnostic> wrong = dispatcher->add(device, phase, file);
    std::move(wrong.begin(), wrong.end(), std::back_inserter(made.diagnostics));
  }
  if (!base::has_error(made.diagnostics)) {
    made.dispatcher = std::move(dispatcher);
  }
  return made;
}

Dispatcher::~Dispatcher() {
  stop();
}

std::optional<Dispatcher::Report> Dispatcher::report_to(const std::optional<schema::Place>& variable) {
  if (!variable) {
    return std::nullopt;
  }
  return Report{variables_.add_write(*variable), variable->type.base};
}

void Dispatcher::add_texts(Line& line, std::span<const config::BoundPoint> texts) {
  std::vector<config::IoPoint> points;
  for (const config::BoundPoint& b : texts) {
    points.push_back(b.point);
    line.texts.push_back({variables_.add_text(b.variable), b.point.output, report_to(b.quality)});
  }
  line.driver->add_texts(points);
}

std::vector<base::Diagnostic> Dispatcher::add(const config::BoundDevice& bound, Phase phase,
                                              const std::filesystem::path& file) {
  std::vector<config::BoundPoint> inputs;
  std::vector<config::BoundPoint> outputs;
  std::vector<config::IoPoint> input_points;
  std::vector<config::IoPoint> output_points;
  std::vector<config::BoundPoint> texts;
  for (const config::BoundPoint& b : bound.points) {
    if (phase == (b.point.output ? Phase::Inputs : Phase::Outputs)) {
      continue;  // belongs to the other module
    }
    if (b.point.is_text) {
      texts.push_back(b);
      continue;
    }
    (b.point.output ? outputs : inputs).push_back(b);
    (b.point.output ? output_points : input_points).push_back(b.point);
  }
  const config::IoSlave& slave = bound.device.slave;
  const bool copies = !slave.copies.empty() || !slave.copied.empty();
  if (inputs.empty() && outputs.empty() && texts.empty() && !copies) {
    return {};
  }
  const bool shareable = bound.device.driver == config::IoDriver::ModbusTcp;
  const bool is_split =
      outputs.size() + inputs.size() + texts.size() != bound.points.size() || (copies && phase != Phase::Both);
  if (!shareable && is_split) {
    return {cannot_be_split(bound.device, file)};
  }
  auto driver = make_driver(bound.device, output_points, input_points, buses_);
  if (!driver) {
    return std::move(driver).error();
  }
  Line& line = lines_.emplace_back();
  line.device = bound.device;
  line.driver = std::move(driver).value();
  add_texts(line, texts);
  for (const config::BoundPoint& b : inputs) {
    line.to.push_back(variables_.add_write(b.variable));
    line.input_qualities.push_back(report_to(b.quality));
  }
  for (const config::BoundPoint& b : outputs) {
    line.from.push_back(variables_.add_read(b.variable));
    line.output_qualities.push_back(report_to(b.quality));
  }
  // If two modules share a device, the one with the inputs reports its quality.
  if (phase != Phase::Outputs || output_points.size() == bound.points.size()) {
    line.quality = report_to(bound.quality);
    line.errors = report_to(bound.errors);
    line.cut = report_to(bound.cut);
    line.cable_errors = report_to(bound.cable_errors);
  }
  if (line.driver->in_tick()) {
    line.in_tick.emplace(inputs, outputs);
    line.outputs.resize(outputs.size());
  } else {
    line.thread = std::make_unique<ExchangeThread>(line.device, *line.driver, DeviceImage(inputs, outputs));
  }
  return {};
}

Status Dispatcher::start(std::uint32_t module) {
  variables_.bind();
  for (const Line& line : lines_) {
    const bool is_open = line.thread != nullptr || line.driver->open();
    const Status status = line.thread != nullptr ? line.thread->start(module) : Status();
    if (!is_open || !status) {
      problem_ = is_open ? "" : line.driver->problem();
      stop();
      return is_open ? status : Status(Error{Errc::NoSpace, 0});
    }
  }
  return {};
}

void Dispatcher::stop() {
  for (const Line& line : lines_) {
    if (line.thread != nullptr) {
      line.thread->stop();
    } else {
      line.driver->close();
    }
  }
  variables_.unbind();
}

void Dispatcher::take(Line& line, OutputImage& into) noexcept {
  for (std::size_t i = 0; i < line.from.size(); ++i) {
    into[i] = variables_.read(line.from[i]);
  }
}

void Dispatcher::take_texts(const Line& line) {
  for (std::size_t i = 0; i < line.texts.size(); ++i) {
    if (line.texts[i].output) {
      variables_.read_text(line.texts[i].part, line.driver->texts()[i]);
    }
  }
}

void Dispatcher::give_texts(const Line& line) {
  for (std::size_t i = 0; i < line.texts.size(); ++i) {
    const Text& text = line.texts[i];
    const bool fits = text.output || variables_.write_text(text.part, line.driver->texts()[i]);
    write_quality(text.quality, fits ? Quality::Good : Quality::OutOfRange);
  }
}

void Dispatcher::write_quality(const std::optional<Report>& to, Quality quality) noexcept {
  if (!to) {
    return;
  }
  const bool is_bool = to->base == schema::Base::Bool;
  std::uint64_t bits = 0;
  (void)to_variable(to->base, is_bool ? quality == Quality::Good : static_cast<int>(quality), bits);
  variables_.set(to->part, bits);
}

void Dispatcher::write_count(const std::optional<Report>& to, std::uint64_t count) noexcept {
  if (to) {
    std::uint64_t bits = 0;
    (void)to_variable(to->base, static_cast<Number>(count), bits);
    variables_.set(to->part, bits);
  }
}

void Dispatcher::give(const Line& line, const InputImage& image) noexcept {
  for (std::size_t i = 0; i < line.to.size(); ++i) {
    if (image.inputs[i].is_set) {
      variables_.set(line.to[i], image.inputs[i].bits);
    }
    write_quality(line.input_qualities[i], image.inputs[i].quality);
  }
  for (std::size_t i = 0; i < line.from.size(); ++i) {
    write_quality(line.output_qualities[i], image.outputs[i]);
  }
  write_quality(line.quality, image.device);
  write_count(line.errors, image.errors);
  write_count(line.cut, line.driver->cut());
  write_count(line.cable_errors, line.driver->cable_errors());
}

bool Dispatcher::run(std::chrono::nanoseconds elapsed) {
  for (Line& line : lines_) {
    if (line.thread != nullptr) {
      take(line, line.thread->next_outputs());
      line.thread->send();
      give(line, line.thread->receive());
    } else {
      take(line, line.outputs);
      if (!line.texts.empty()) [[unlikely]] {  // of FMUs only
        take_texts(line);
      }
      const auto outcome = line.in_tick->exchange(*line.driver, line.outputs, DeviceImage::Outputs::Fresh, elapsed);
      if (outcome == Driver::Outcome::Failed) [[unlikely]] {
        problem_ = line.driver->problem();
        return false;
      }
      give(line, line.in_tick->current());
      if (!line.texts.empty()) [[unlikely]] {
        give_texts(line);
      }
    }
  }
  variables_.commit();
  return true;
}

}  // namespace indurop::io
