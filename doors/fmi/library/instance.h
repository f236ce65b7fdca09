// SPDX-License-Identifier: Apache-2.0
// An instance of an FMU: the states that FMI 2 and FMI 3 have in common, and its variables. It knows neither of the two
// C interfaces.

#pragma once

#include <indurop/result.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "doors/fmi/contents/types.h"
#include "doors/fmi/library/number.h"
#include "doors/fmi/library/resources.h"
#include "doors/fmi/library/simulation.h"
#include "doors/fmi/library/steps.h"

namespace indurop::fmi {

// The numbers are those of fmi2Status and fmi3Status.
enum class Outcome : int { Ok = 0, Warning = 1, Discard = 2, Error = 3 };

// What is wrong, and how bad it is. After Discard and Error nothing was changed, unless the node has ended.
struct Trouble {
  Outcome outcome = Outcome::Error;
  std::string text;
};
using Done = Result<void, Trouble>;

// Receives a message of a category, with its severity.
using Logger = std::function<void(Outcome severity, const char* category, const std::string& text)>;
inline constexpr const char* kNodeCategory = "node";  // what node and modules print
const char* category_of(Outcome outcome);             // of FMI: "logStatusError"

enum class Mode { Instantiated, Initialization, Step, Terminated, Failed };

// Used by one thread at a time. Nothing is thrown. Errors: Trouble with a text for the user.
class Instance {
 public:
  // Starts the configuration, which is then before its first tick. `token`: as the master knows it.
  static Result<std::unique_ptr<Instance>, Trouble> make(const std::filesystem::path& resources,
                                                         const std::string& token, Logger logger);

  // Chooses whether debug messages are logged, of these categories (empty: of all). Errors: an unknown category.
  Done set_logging(bool on, const std::vector<std::string_view>& categories);
  void log(Outcome severity, const char* category, const std::string& text) const { logger_(severity, category, text); }

  Done set_up(double start, std::optional<double> stop);
  Done enter_initialization();
  Done exit_initialization();
  // Runs the ticks that lie in the step from `at` of `size`, in seconds. Outcome Warning: modules faulted.
  Done step(double at, double size);
  Done terminate();
  Done reset();

  [[nodiscard]] Mode mode() const noexcept { return mode_; }
  [[nodiscard]] double time() const { return steps_.now(); }

  // Reads and writes numbers of the types in `allowed`; `references` are value references. The first trouble ends it;
  // the values before it were read or written.
  template <class T>
  Done get(std::uint32_t allowed, std::span<const std::uint32_t> references, T* values);
  template <class T>
  Done set(std::uint32_t allowed, std::span<const std::uint32_t> references, const T* values);
  // The texts that `values` get are valid until the next call.
  Done get_texts(std::span<const std::uint32_t> references, const char** values);
  Done set_texts(std::span<const std::uint32_t> references, const char* const* values);

 private:
  Instance(Resources resources, Logger logger);

  // Calls `act`, which may throw. What it throws means that the simulation is at its end.
  Done guarded(const std::function<void()>& act);
  void start();
  void forward_output();
  [[nodiscard]] Done must_be(std::initializer_list<Mode> modes, const char* what) const;
  [[nodiscard]] Done may_read() const;
  // Returns the index of a variable whose type is allowed.
  [[nodiscard]] Result<std::size_t, Trouble> find(std::uint32_t reference, std::uint32_t allowed) const;
  [[nodiscard]] Result<std::size_t, Trouble> find_writable(std::uint32_t reference, std::uint32_t allowed) const;
  Done read(std::size_t variable, std::span<std::uint8_t> to);
  Done write(std::size_t variable, std::span<const std::uint8_t> from);
  // Writes a number, if it is in its range; nothing: its type cannot hold it.
  Done write_number(std::size_t variable, const std::optional<Bytes>& bytes);
  [[nodiscard]] const FmuVariable& about(std::size_t variable) const { return resources_.contents.variables[variable]; }

  Resources resources_;
  Logger logger_;
  bool logging_ = false;
  Mode mode_ = Mode::Instantiated;
  std::string failure_;  // of Mode::Failed
  std::unique_ptr<Simulation> simulation_;
  double start_ = 0;
  std::optional<double> stop_;
  Steps steps_;
  std::map<std::size_t, std::string> texts_;
};

template <class T>
Done Instance::get(std::uint32_t allowed, std::span<const std::uint32_t> references, T* values) {
  if (auto may = may_read(); !may) {
    return may;
  }
  for (std::size_t i = 0; i < references.size(); ++i) {
    const auto variable = find(references[i], allowed);
    if (!variable) {
      return variable.error();
    }
    const schema::Type& type = simulation_->type(*variable);
    Bytes bytes{};
    if (auto done = read(*variable, std::span(bytes).first(type.size())); !done) {
      return done;
    }
    values[i] = from_bytes<T>(type.base, bytes);
  }
  return {};
}

template <class T>
Done Instance::set(std::uint32_t allowed, std::span<const std::uint32_t> references, const T* values) {
  for (std::size_t i = 0; i < references.size(); ++i) {
    const auto variable = find_writable(references[i], allowed);
    if (!variable) {
      return variable.error();
    }
    if (auto done = write_number(*variable, to_bytes(simulation_->type(*variable).base, values[i])); !done) {
      return done;
    }
  }
  return {};
}

}  // namespace indurop::fmi
