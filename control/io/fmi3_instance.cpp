// SPDX-License-Identifier: Apache-2.0
// An instance of an FMU of FMI 3.0, without its event mode and early return.

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <memory>
#include <string_view>

#include "control/io/fmu/fmi3.h"
#include "control/io/fmu_instance.h"

namespace indurop::io {

namespace {

const char* name_of(fmi3Status status) noexcept {
  constexpr std::array kNames{"fmi3OK", "fmi3Warning", "fmi3Discard", "fmi3Error", "fmi3Fatal"};
  const auto index = static_cast<std::size_t>(status);
  return index < kNames.size() ? kNames[index] : "no status of the standard";
}

void note3(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category, fmi3String message) {
  const auto kind = status == fmi3OK        ? FmuLog::Kind::Information
                    : status == fmi3Warning ? FmuLog::Kind::Warning
                                            : FmuLog::Kind::Error;
  static_cast<FmuLog*>(environment)->add(kind, category, message);
}

// The functions for values of one type.
template <class T>
struct Access {
  fmi3Status (*set)(fmi3Instance, const fmi3ValueReference*, std::size_t, const T*, std::size_t) = nullptr;
  fmi3Status (*get)(fmi3Instance, const fmi3ValueReference*, std::size_t, T*, std::size_t) = nullptr;
};

class Fmi3Instance final : public FmuInstance {
 public:
  Fmi3Instance(const fmu::Description& description, FmuLog& log) : FmuInstance(description, log) {}

  bool set(const fmu::Variable& variable, std::span<const Number> values) override {
    const auto set = [&]<class T>(const Access<T>& access) {
      const std::unique_ptr<T[]> converted(new T[values.size()]);  // NOLINT: a vector of bool is no array
      for (std::size_t i = 0; i < values.size(); ++i) {
        converted[i] = static_cast<T>(values[i]);
      }
      return access.set(instance_, &variable.reference, 1, converted.get(), values.size());
    };
    return judge(with_access(variable.type, set), "setting " + variable.name);
  }

  bool get(const fmu::Variable& variable, std::span<Number> values) override {
    const auto get = [&]<class T>(const Access<T>& access) {
      const std::unique_ptr<T[]> read(new T[values.size()]());  // NOLINT: a vector of bool is no array
      const fmi3Status status = access.get(instance_, &variable.reference, 1, read.get(), values.size());
      for (std::size_t i = 0; i < values.size(); ++i) {
        values[i] = static_cast<Number>(read[i]);
      }
      return status;
    };
    return judge(with_access(variable.type, get), "getting " + variable.name);
  }

  bool set_text(const fmu::Variable& variable, const std::string& text) override {
    const char* const value = text.c_str();
    return judge(set_string_(instance_, &variable.reference, 1, &value, 1), "setting " + variable.name);
  }

  bool get_text(const fmu::Variable& variable, std::string& text) override {
    const char* value = nullptr;  // of the FMU, until its next call
    const fmi3Status status = get_string_(instance_, &variable.reference, 1, &value, 1);
    text = value == nullptr ? "" : value;
    return judge(status, "getting " + variable.name);
  }

  bool enter_initialization() override {
    return judge(enter_initialization_(instance_, false, 0, 0, false, 0), "fmi3EnterInitializationMode");
  }

  bool step(double at, double size) override {
    bool needs_event = false;
    bool has_ended = false;
    bool is_early = false;
    double last = at + size;
    if (!judge(step_(instance_, at, size, true, &needs_event, &has_ended, &is_early, &last), "fmi3DoStep")) {
      return false;
    }
    if (has_ended) {
      return fail("the FMU has ended the simulation");
    }
    return !is_early || fail(fmt::format("fmi3DoStep returned at {} s, although it must not return early", last));
  }

 private:
  bool finish_initialization() override { return judge(exit_initialization_(instance_), "fmi3ExitInitializationMode"); }

  void terminate() override { (void)terminate_(instance_); }
  void free() override { free_(instance_); }

  std::string start(const FmuIdentity& identity) override {
    find_functions();
    if (!missing().empty()) {
      return fmt::format("its library lacks {} of FMI 3.0", missing());
    }
    if (!std::string_view(version_()).starts_with("3.")) {
      return fmt::format("its library is of FMI {}, not of 3.0", version_());
    }
    const std::vector<const char*> wanted = categories();
    instance_ =
        instantiate_(identity.name.c_str(), description_.token.c_str(), (identity.folder / "resources" / "").c_str(),
                     false, true, false, false, nullptr, 0, &log_, &note3, nullptr);
    if (instance_ == nullptr) {
      return "fmi3InstantiateCoSimulation failed" + reason();
    }
    if (!wanted.empty()) {
      (void)set_logging_(instance_, true, wanted.size(), wanted.data());
    }
    return {};
  }

  bool judge(fmi3Status status, const std::string& call) {
    if (status == fmi3OK || status == fmi3Warning) {
      return true;
    }
    return fail_call(call, name_of(status), status == fmi3Fatal);
  }

  template <class Use>
  fmi3Status with_access(fmu::Type type, const Use& use) {
    switch (type) {
      case fmu::Type::Float32:
        return use(float32_);
      case fmu::Type::Float64:
        return use(float64_);
      case fmu::Type::Int8:
        return use(int8_);
      case fmu::Type::UInt8:
        return use(uint8_);
      case fmu::Type::Int16:
        return use(int16_);
      case fmu::Type::UInt16:
        return use(uint16_);
      case fmu::Type::Int32:
        return use(int32_);
      case fmu::Type::UInt32:
        return use(uint32_);
      case fmu::Type::Int64:
      case fmu::Type::Enumeration:
        return use(int64_);
      case fmu::Type::UInt64:
        return use(uint64_);
      case fmu::Type::Boolean:
        return use(boolean_);
      case fmu::Type::String:
      case fmu::Type::Binary:
      case fmu::Type::Clock:
        break;
    }
    return fmi3Error;
  }

  template <class T>
  void find_access(Access<T>& access, const std::string& type) {
    find(access.set, ("fmi3Set" + type).c_str());
    find(access.get, ("fmi3Get" + type).c_str());
  }

  void find_functions() {
    find(version_, "fmi3GetVersion");
    find(set_logging_, "fmi3SetDebugLogging");
    find(instantiate_, "fmi3InstantiateCoSimulation");
    find(free_, "fmi3FreeInstance");
    find(enter_initialization_, "fmi3EnterInitializationMode");
    find(exit_initialization_, "fmi3ExitInitializationMode");
    find(terminate_, "fmi3Terminate");
    find_access(float32_, "Float32");
    find_access(float64_, "Float64");
    find_access(int8_, "Int8");
    find_access(uint8_, "UInt8");
    find_access(int16_, "Int16");
    find_access(uint16_, "UInt16");
    find_access(int32_, "Int32");
    find_access(uint32_, "UInt32");
    find_access(int64_, "Int64");
    find_access(uint64_, "UInt64");
    find_access(boolean_, "Boolean");
    find(get_string_, "fmi3GetString");
    find(set_string_, "fmi3SetString");
    find(step_, "fmi3DoStep");
  }

  fmi3Instance instance_ = nullptr;
  decltype(&fmi3GetVersion) version_ = nullptr;
  decltype(&fmi3SetDebugLogging) set_logging_ = nullptr;
  decltype(&fmi3InstantiateCoSimulation) instantiate_ = nullptr;
  decltype(&fmi3FreeInstance) free_ = nullptr;
  decltype(&fmi3EnterInitializationMode) enter_initialization_ = nullptr;
  decltype(&fmi3ExitInitializationMode) exit_initialization_ = nullptr;
  decltype(&fmi3Terminate) terminate_ = nullptr;
  Access<float> float32_;
  Access<double> float64_;
  Access<std::int8_t> int8_;
  Access<std::uint8_t> uint8_;
  Access<std::int16_t> int16_;
  Access<std::uint16_t> uint16_;
  Access<std::int32_t> int32_;
  Access<std::uint32_t> uint32_;
  Access<std::int64_t> int64_;
  Access<std::uint64_t> uint64_;
  Access<bool> boolean_;
  decltype(&fmi3GetString) get_string_ = nullptr;
  decltype(&fmi3SetString) set_string_ = nullptr;
  decltype(&fmi3DoStep) step_ = nullptr;
};

}  // namespace

std::unique_ptr<FmuInstance> new_fmi3_instance(const fmu::Description& description, FmuLog& log) {
  return std::make_unique<Fmi3Instance>(description, log);
}

}  // namespace indurop::io
