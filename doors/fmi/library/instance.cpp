// SPDX-License-Identifier: Apache-2.0
#include "doors/fmi/library/instance.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <utility>

namespace indurop::fmi {
namespace {

constexpr std::array<const char*, 4> kCategories{"logEvents", "logStatusWarning", "logStatusDiscard", "logStatusError"};
constexpr std::array<const char*, 5> kModes{"instantiated", "in initialization mode", "in step mode", "terminated",
                                            "at an error"};
constexpr std::chrono::nanoseconds kNotKnown{1};  // basic period before a node was started

}  // namespace

const char* category_of(Outcome outcome) {
  return kCategories[static_cast<std::size_t>(outcome)];
}

Instance::Instance(Resources resources, Logger logger)
    : resources_(std::move(resources)), logger_(std::move(logger)), steps_(kNotKnown, 0, std::nullopt) {}

Result<std::unique_ptr<Instance>, Trouble> Instance::make(const std::filesystem::path& resources,
                                                          const std::string& token, Logger logger) {
  auto opened = open_resources(resources);
  if (!opened) {
    return Trouble{Outcome::Error, std::move(opened).error().text};
  }
  if (token != opened->contents.token) {
    return Trouble{Outcome::Error,
                   fmt::format("its files are not those of one FMU: modelDescription.xml says {}, its resources {}",
                               token, opened->contents.token)};
  }
  std::unique_ptr<Instance> instance(new Instance(std::move(*opened), std::move(logger)));
  if (auto started = instance->reset(); !started) {
    return std::move(started).error();
  }
  return instance;
}

Done Instance::guarded(const std::function<void()>& act) {
  try {
    act();
    return {};
  } catch (const std::exception& error) {
    failure_ = error.what();
  } catch (...) {
    failure_ = "unknown error";
  }
  mode_ = Mode::Failed;
  return Trouble{Outcome::Error, failure_};
}

Done Instance::set_logging(bool on, const std::vector<std::string_view>& categories) {
  const auto is_known = [](std::string_view category) {
    return category == kNodeCategory || category == "logAll" ||
           std::find(kCategories.begin(), kCategories.end(), category) != kCategories.end();
  };
  bool node = categories.empty();
  for (const std::string_view category : categories) {
    if (!is_known(category)) {
      return Trouble{Outcome::Error, fmt::format("there is no category '{}'; there is {}, logAll and {}", category,
                                                 kNodeCategory, fmt::join(kCategories, ", "))};
    }
    node = node || category == kNodeCategory || category == "logAll";
  }
  logging_ = on && node;
  return {};
}

Done Instance::must_be(std::initializer_list<Mode> modes, const char* what) const {
  if (std::find(modes.begin(), modes.end(), mode_) != modes.end()) {
    return {};
  }
  return Trouble{Outcome::Error,
                 mode_ == Mode::Failed
                     ? fmt::format("the simulation has ended, reset or free the instance: {}", failure_)
                     : fmt::format("{} while the instance is {}", what, kModes[static_cast<std::size_t>(mode_)])};
}

Done Instance::set_up(double start, std::optional<double> stop) {
  if (auto may = must_be({Mode::Instantiated}, "the experiment cannot be set up"); !may) {
    return may;
  }
  if (!std::isfinite(start) || (stop && !(*stop >= start))) {
    return Trouble{Outcome::Error,
                   fmt::format("a simulation from {} s to {} s is not possible", start, stop.value_or(start))};
  }
  steps_ = Steps(simulation_->basic_period(), start, stop);
  return {};
}

Done Instance::enter_initialization() {
  if (auto may = must_be({Mode::Instantiated}, "initialization cannot begin"); !may) {
    return may;
  }
  mode_ = Mode::Initialization;
  return {};
}

Done Instance::exit_initialization() {
  if (auto may = must_be({Mode::Initialization}, "initialization cannot end"); !may) {
    return may;
  }
  mode_ = Mode::Step;
  return {};
}

Done Instance::step(double at, double size) {
  if (auto may = must_be({Mode::Step}, "no step is possible"); !may) {
    return may;
  }
  if (std::string problem = steps_.problem_of(at, size); !problem.empty()) {
    return Trouble{Outcome::Error, std::move(problem)};
  }
  std::string faults;
  auto done = guarded([&] {
    simulation_->run_to(steps_.ticks_at_end(at, size));
    faults = simulation_->new_faults();
  });
  forward_output();
  if (!done) {
    return done;
  }
  steps_.end_at(at + size);
  return faults.empty() ? Done() : Trouble{Outcome::Warning, std::move(faults)};
}

Done Instance::terminate() {
  if (auto may = must_be({Mode::Step}, "the simulation cannot end"); !may) {
    return may;
  }
  mode_ = Mode::Terminated;
  return {};
}

Done Instance::reset() {
  simulation_.reset();
  texts_.clear();
  mode_ = Mode::Instantiated;
  auto done = guarded([this] {
    simulation_ = std::make_unique<Simulation>(resources_);
    steps_ = Steps(simulation_->basic_period(), 0, std::nullopt);
  });
  if (done) {
    forward_output();
  }
  return done;
}

void Instance::forward_output() {
  const std::string text = logging_ ? simulation_->new_output() : std::string();
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at);
    log(Outcome::Ok, kNodeCategory, text.substr(at, end - at));
    at = end + 1;
  }
}

Done Instance::may_read() const {
  return must_be({Mode::Initialization, Mode::Step, Mode::Terminated}, "variables cannot be read");
}

Result<std::size_t, Trouble> Instance::find(std::uint32_t reference, std::uint32_t allowed) const {
  if (reference == 0 || reference > resources_.contents.variables.size()) {
    return Trouble{Outcome::Error, fmt::format("there is no variable with value reference {}", reference)};
  }
  const std::size_t variable = reference - 1;
  const schema::Type& type = simulation_->type(variable);
  if (!contains(allowed, type.base)) {
    return Trouble{Outcome::Error,
                   fmt::format("{} (value reference {}) is a {}, which another function reads and writes",
                               about(variable).name, reference, schema::display_name(type))};
  }
  return variable;
}

Result<std::size_t, Trouble> Instance::find_writable(std::uint32_t reference, std::uint32_t allowed) const {
  if (auto may = must_be({Mode::Instantiated, Mode::Initialization, Mode::Step}, "variables cannot be set"); !may) {
    return std::move(may).error();
  }
  auto variable = find(reference, allowed);
  if (variable && !about(*variable).input) {
    return Trouble{Outcome::Error,
                   fmt::format("{} (value reference {}) is an output, which a module of the configuration writes",
                               about(*variable).name, reference)};
  }
  return variable;
}

Done Instance::read(std::size_t variable, std::span<std::uint8_t> to) {
  return guarded([&] { simulation_->read(variable, to); });
}

Done Instance::write(std::size_t variable, std::span<const std::uint8_t> from) {
  return guarded([&] { simulation_->write(variable, from); });
}

Done Instance::write_number(std::size_t variable, const std::optional<Bytes>& bytes) {
  const schema::Type& type = simulation_->type(variable);
  if (!bytes) {
    return Trouble{Outcome::Discard, fmt::format("{} is a {}, which cannot hold the value", about(variable).name,
                                                 schema::display_name(type))};
  }
  const auto value = std::span(*bytes).first(type.size());
  if (const auto& range = simulation_->range(variable)) {
    if (const auto inside = schema::check_range(*range, type, value); !inside) {
      return Trouble{Outcome::Discard, fmt::format("{}: {}", about(variable).name, inside.error().message)};
    }
  }
  if (type.base == schema::Base::Enum &&
      std::none_of(type.enumerators.begin(), type.enumerators.end(),
                   [number = schema::load<std::int32_t>(bytes->data())](const schema::Enumerator& one) {
                     return one.value == number;
                   })) {
    return Trouble{Outcome::Discard,
                   fmt::format("{} has no item {}", about(variable).name, schema::load<std::int32_t>(bytes->data()))};
  }
  return write(variable, value);
}

Done Instance::get_texts(std::span<const std::uint32_t> references, const char** values) {
  if (auto may = may_read(); !may) {
    return may;
  }
  for (std::size_t i = 0; i < references.size(); ++i) {
    const auto variable = find(references[i], kTexts);
    if (!variable) {
      return variable.error();
    }
    std::vector<std::uint8_t> bytes(simulation_->type(*variable).size());
    if (auto done = read(*variable, bytes); !done) {
      return done;
    }
    std::string& text = texts_[*variable];
    text.assign(bytes.begin(), std::find(bytes.begin(), bytes.end(), 0));
    values[i] = text.c_str();
  }
  return {};
}

Done Instance::set_texts(std::span<const std::uint32_t> references, const char* const* values) {
  for (std::size_t i = 0; i < references.size(); ++i) {
    const auto variable = find_writable(references[i], kTexts);
    if (!variable) {
      return variable.error();
    }
    if (values[i] == nullptr) {
      return Trouble{Outcome::Error, fmt::format("{} is set to a null pointer", about(*variable).name)};
    }
    std::vector<std::uint8_t> bytes(simulation_->type(*variable).size());
    const std::size_t length = std::strlen(values[i]);
    if (length >= bytes.size()) {
      return Trouble{Outcome::Discard,
                     fmt::format("{} holds {} bytes of text, not {}", about(*variable).name, bytes.size() - 1, length)};
    }
    std::copy_n(values[i], length, bytes.begin());
    if (auto done = write(*variable, bytes); !done) {
      return done;
    }
  }
  return {};
}

}  // namespace indurop::fmi
