// SPDX-License-Identifier: Apache-2.0
// An instance of an FMU of FMI 2.0.

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "control/io/fmu/fmi2.h"
#include "control/io/fmu_instance.h"

namespace indurop::io {

namespace {

const char* name_of(fmi2Status status) noexcept {
  constexpr std::array kNames{"fmi2OK", "fmi2Warning", "fmi2Discard", "fmi2Error", "fmi2Fatal", "fmi2Pending"};
  const auto index = static_cast<std::size_t>(status);
  return index < kNames.size() ? kNames[index] : "no status of the standard";
}

bool is_done(fmi2Status status) noexcept {
  return status == fmi2OK || status == fmi2Warning;
}

// The message is a format of printf, as the standard wants it.
// NOLINTNEXTLINE(cert-dcl50-cpp)
void note2(fmi2ComponentEnvironment environment, fmi2String /*instance*/, fmi2Status status, fmi2String category,
           fmi2String message, ...) {
  constexpr std::size_t kMaxText = 2048;
  std::array<char, kMaxText> text{};
  std::va_list arguments;
  va_start(arguments, message);
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"  // it comes from the FMU
  std::vsnprintf(text.data(), text.size(), message == nullptr ? "" : message, arguments);
#pragma GCC diagnostic pop
  va_end(arguments);
  const auto kind = status == fmi2OK        ? FmuLog::Kind::Information
                    : status == fmi2Warning ? FmuLog::Kind::Warning
                                            : FmuLog::Kind::Error;
  static_cast<FmuLog*>(environment)->add(kind, category, text.data());
}

class Fmi2Instance final : public FmuInstance {
 public:
  Fmi2Instance(const fmu::Description& description, FmuLog& log) : FmuInstance(description, log) {}

  bool set(const fmu::Variable& variable, std::span<const Number> values) override {
    fmi2Status status = fmi2OK;
    if (variable.type == fmu::Type::Float64) {
      const auto value = static_cast<fmi2Real>(values.front());
      status = set_real_(instance_, &variable.reference, 1, &value);
    } else {
      const auto value = static_cast<fmi2Integer>(values.front());
      const auto set = variable.type == fmu::Type::Boolean ? set_boolean_ : set_integer_;
      status = set(instance_, &variable.reference, 1, &value);
    }
    return judge(status, "setting " + variable.name);
  }

  bool get(const fmu::Variable& variable, std::span<Number> values) override {
    fmi2Status status = fmi2OK;
    if (variable.type == fmu::Type::Float64) {
      fmi2Real value = 0;
      status = get_real_(instance_, &variable.reference, 1, &value);
      values.front() = static_cast<Number>(value);
    } else {
      fmi2Integer value = 0;
      const bool is_bool = variable.type == fmu::Type::Boolean;
      status = (is_bool ? get_boolean_ : get_integer_)(instance_, &variable.reference, 1, &value);
      values.front() = is_bool ? static_cast<Number>(value != 0) : static_cast<Number>(value);
    }
    return judge(status, "getting " + variable.name);
  }

  bool set_text(const fmu::Variable& variable, const std::string& text) override {
    const char* const value = text.c_str();
    return judge(set_string_(instance_, &variable.reference, 1, &value), "setting " + variable.name);
  }

  bool get_text(const fmu::Variable& variable, std::string& text) override {
    const char* value = nullptr;  // of the FMU, until its next call
    const fmi2Status status = get_string_(instance_, &variable.reference, 1, &value);
    text = value == nullptr ? "" : value;
    return judge(status, "getting " + variable.name);
  }

  bool enter_initialization() override {
    return judge(set_up_(instance_, fmi2False, 0, 0, fmi2False, 0), "fmi2SetupExperiment") &&
           judge(enter_initialization_(instance_), "fmi2EnterInitializationMode");
  }

  bool step(double at, double size) override {
    const fmi2Status status = step_(instance_, at, size, fmi2True);
    if (status == fmi2Discard) {
      fmi2Boolean has_ended = fmi2False;
      if (boolean_status_(instance_, fmi2Terminated, &has_ended) == fmi2OK && has_ended != fmi2False) {
        return fail("the FMU has ended the simulation");
      }
    }
    return judge(status, "fmi2DoStep");
  }

 private:
  bool finish_initialization() override { return judge(exit_initialization_(instance_), "fmi2ExitInitializationMode"); }

  void terminate() override { (void)terminate_(instance_); }
  void free() override { free_(instance_); }

  std::string start(const FmuIdentity& identity) override {
    find_functions();
    if (!missing().empty()) {
      return fmt::format("its library lacks {} of FMI 2.0", missing());
    }
    if (std::string_view(types_platform_()) != "default" || !std::string_view(version_()).starts_with("2.")) {
      return fmt::format("its library is of FMI {} for platform '{}', not of 2.0 for 'default'", version_(),
                         types_platform_());
    }
    callbacks_ = {&note2, &std::calloc, &std::free, nullptr, &log_};
    const std::vector<const char*> wanted = categories();
    instance_ = instantiate_(identity.name.c_str(), fmi2CoSimulation, description_.token.c_str(),
                             uri_of(identity.folder / "resources").c_str(), &callbacks_, fmi2False, fmi2True);
    if (instance_ == nullptr) {
      return "fmi2Instantiate failed" + reason();
    }
    if (!wanted.empty()) {
      (void)set_logging_(instance_, fmi2True, wanted.size(), wanted.data());
    }
    return {};
  }

  static std::string uri_of(const std::filesystem::path& path) {
    std::string uri = "file://";
    for (const char c : path.string()) {
      const bool is_plain = std::isalnum(static_cast<unsigned char>(c)) != 0 ||
                            std::string_view("/-_.~").find(c) != std::string_view::npos;
      uri += is_plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
    return uri;
  }

  bool judge(fmi2Status status, const std::string& call) {
    if (is_done(status)) {
      return true;
    }
    return fail_call(call, name_of(status), status == fmi2Fatal);
  }

  void find_functions() {
    find(types_platform_, "fmi2GetTypesPlatform");
    find(version_, "fmi2GetVersion");
    find(set_logging_, "fmi2SetDebugLogging");
    find(instantiate_, "fmi2Instantiate");
    find(free_, "fmi2FreeInstance");
    find(set_up_, "fmi2SetupExperiment");
    find(enter_initialization_, "fmi2EnterInitializationMode");
    find(exit_initialization_, "fmi2ExitInitializationMode");
    find(terminate_, "fmi2Terminate");
    find(get_real_, "fmi2GetReal");
    find(get_integer_, "fmi2GetInteger");
    find(get_boolean_, "fmi2GetBoolean");
    find(set_real_, "fmi2SetReal");
    find(set_integer_, "fmi2SetInteger");
    find(set_boolean_, "fmi2SetBoolean");
    find(get_string_, "fmi2GetString");
    find(set_string_, "fmi2SetString");
    find(step_, "fmi2DoStep");
    find(boolean_status_, "fmi2GetBooleanStatus");
  }

  fmi2Component instance_ = nullptr;
  fmi2CallbackFunctions callbacks_{};
  decltype(&fmi2GetTypesPlatform) types_platform_ = nullptr;
  decltype(&fmi2GetVersion) version_ = nullptr;
  decltype(&fmi2SetDebugLogging) set_logging_ = nullptr;
  decltype(&fmi2Instantiate) instantiate_ = nullptr;
  decltype(&fmi2FreeInstance) free_ = nullptr;
  decltype(&fmi2SetupExperiment) set_up_ = nullptr;
  decltype(&fmi2EnterInitializationMode) enter_initialization_ = nullptr;
  decltype(&fmi2ExitInitializationMode) exit_initialization_ = nullptr;
  decltype(&fmi2Terminate) terminate_ = nullptr;
  decltype(&fmi2GetReal) get_real_ = nullptr;
  decltype(&fmi2GetInteger) get_integer_ = nullptr;
  decltype(&fmi2GetBoolean) get_boolean_ = nullptr;
  decltype(&fmi2SetReal) set_real_ = nullptr;
  decltype(&fmi2SetInteger) set_integer_ = nullptr;
  decltype(&fmi2SetBoolean) set_boolean_ = nullptr;
  decltype(&fmi2GetString) get_string_ = nullptr;
  decltype(&fmi2SetString) set_string_ = nullptr;
  decltype(&fmi2DoStep) step_ = nullptr;
  decltype(&fmi2GetBooleanStatus) boolean_status_ = nullptr;
};

}  // namespace

std::unique_ptr<FmuInstance> new_fmi2_instance(const fmu::Description& description, FmuLog& log) {
  return std::make_unique<Fmi2Instance>(description, log);
}

}  // namespace indurop::io
