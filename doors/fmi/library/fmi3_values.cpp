// SPDX-License-Identifier: Apache-2.0
// The functions of FMI 3.0 that read and write variables.
#include "control/io/fmu/fmi3.h"
#include "doors/fmi/library/border.h"

namespace indurop::fmi {
namespace {

// Calls `act` with the value references, if no pointer is null and each variable has one value.
template <class Act>
fmi3Status with_values3(fmi3Instance c, const char* function, const fmi3ValueReference* refs, std::size_t count,
                        const void* values, std::size_t value_count, Act act) noexcept {
  return static_cast<fmi3Status>(at_border(c, function, [&](Instance& instance) {
    if (value_count != count) {
      return refused("each variable has one value: nValues has to be nValueReferences");
    }
    return with_arrays(refs, count, values, [&](auto references) { return act(instance, references); });
  }));
}

template <class T>
fmi3Status get3(fmi3Instance c, const char* function, std::uint32_t allowed, const fmi3ValueReference* refs,
                std::size_t count, T* values, std::size_t value_count) noexcept {
  return with_values3(c, function, refs, count, values, value_count,
                      [=](Instance& instance, auto references) { return instance.get(allowed, references, values); });
}

template <class T>
fmi3Status set3(fmi3Instance c, const char* function, std::uint32_t allowed, const fmi3ValueReference* refs,
                std::size_t count, const T* values, std::size_t value_count) noexcept {
  return with_values3(c, function, refs, count, values, value_count,
                      [=](Instance& instance, auto references) { return instance.set(allowed, references, values); });
}

}  // namespace
}  // namespace indurop::fmi

using namespace indurop::fmi;  // NOLINT(google-build-using-namespace): C has no namespaces
namespace schema = indurop::schema;

// Value reference 0 is the time, the independent variable.
fmi3Status fmi3GetFloat64(fmi3Instance c, const fmi3ValueReference refs[], size_t count, fmi3Float64 values[],
                          size_t value_count) {
  return with_values3(
      c, "fmi3GetFloat64", refs, count, values, value_count,
      [=](Instance& instance, std::span<const std::uint32_t> references) -> Done {
        for (std::size_t i = 0; i < references.size(); ++i) {
          if (references[i] == 0) {
            values[i] = instance.time();
          } else if (auto done = instance.get(set_of(schema::Base::Double), references.subspan(i, 1), &values[i]);
                     !done) {
            return done;
          }
        }
        return {};
      });
}

fmi3Status fmi3GetString(fmi3Instance c, const fmi3ValueReference refs[], size_t count, fmi3String values[],
                         size_t value_count) {
  return with_values3(c, "fmi3GetString", refs, count, values, value_count,
                      [=](Instance& instance, auto references) { return instance.get_texts(references, values); });
}

fmi3Status fmi3SetString(fmi3Instance c, const fmi3ValueReference refs[], size_t count, const fmi3String values[],
                         size_t value_count) {
  return with_values3(c, "fmi3SetString", refs, count, values, value_count,
                      [=](Instance& instance, auto references) { return instance.set_texts(references, values); });
}

fmi3Status fmi3GetFloat32(fmi3Instance c, const fmi3ValueReference refs[], size_t count, fmi3Float32 values[],
                          size_t value_count) {
  return get3(c, "fmi3GetFloat32", set_of(schema::Base::Float), refs, count, values, value_count);
}

fmi3Status fmi3SetFloat32(fmi3Instance c, const fmi3ValueReference refs[], size_t count, const fmi3Float32 values[],
                          size_t value_count) {
  return set3(c, "fmi3SetFloat32", set_of(schema::Base::Float), refs, count, values, value_count);
}

fmi3Status fmi3SetFloat64(fmi3Instance c, const fmi3ValueReference refs[], size_t count, const fmi3Float64 values[],
                          size_t value_count) {
  return set3(c, "fmi3SetFloat64", set_of(schema::Base::Double), refs, count, values, value_count);
}

fmi3Status fmi3GetInt8(fmi3Instance c, const fmi3ValueReference refs[], size_t count, fmi3Int8 values[],
                       size_t value_count) {
  return get3(c, "fmi3GetInt8", set_of(schema::Base::Int8), refs, count, values, value_count);
}

fmi3Status fmi3SetInt8(fmi3Instance c, const fmi3ValueReference refs[], size_t count, const fmi3Int8 values[],
                       size_t value_count) {
  return set3(c, "fmi3SetInt8", set_of(schema::Base::Int8), refs, count, values, value_count);
}

fmi3Status fmi3GetUInt8(fmi3Instance c, const fmi3ValueReference refs[], size_t count, fmi3UInt8 values[],
                        size_t value_count) {
  return get3(c, "fmi3GetUInt8", kUInt8s, refs, count, values, value_count);
}

fmi3Status fmi3SetUInt8(fmi3Instance c, const fmi3ValueReference refs[], size_t count, const fmi3UInt8 values[],
                        size_t value_count) {
  return set3(c, "fmi3SetUInt8", kUInt8s, refs, count, values, value_count);
}

fmi3Status fmi3GetInt16(fmi3Instance c, const fmi3ValueReference refs[], size_t count, fmi3Int16 values[],
                        size_t value_count) {
  return get3(c, "fmi3GetInt16", set_of(schema::Base::Int16), refs, count, values, value_count);
}

fmi3Status fmi3SetInt16(fmi3Instance c, const fmi3ValueReference refs[], size_t count, const fmi3Int16 values[],
                        size_t value_count) {
  return set3(c, "fmi3SetInt16", set_of(schema::Base::Int16), refs, count, values, value_count);
}

fmi3Status fmi3GetUInt16(fmi3Instance c, const fmi3ValueReference refs[], size_t count, fmi3UInt16 values[],
                         size_t value_count) {
  return get3(c, "fmi3GetUInt16", set_of(schema::Base::UInt16), refs, count, values, value_count);
}

fmi3Status fmi3SetUInt16(fmi3Instance c, const fmi3ValueReference refs[], size_t count, const fmi3UInt16 values[],
                         size_t value_count) {
  return set3(c, "fmi3SetUInt16", set_of(schema::Base::UInt16), refs, count, values, value_count);
}

fmi3Status fmi3GetInt32(fmi3Instance c, const fmi3ValueReference refs[], size_t count, fmi3Int32 values[],
                        size_t value_count) {
  return get3(c, "fmi3GetInt32", set_of(schema::Base::Int32), refs, count, values, value_count);
}

fmi3Status fmi3SetInt32(fmi3Instance c, const fmi3ValueReference refs[], size_t count, const fmi3Int32 values[],
                        size_t value_count) {
  return set3(c, "fmi3SetInt32", set_of(schema::Base::Int32), refs, count, values, value_count);
}

fmi3Status fmi3GetUInt32(fmi3Instance c, const fmi3ValueReference refs[], size_t count, fmi3UInt32 values[],
                         size_t value_count) {
  return get3(c, "fmi3GetUInt32", set_of(schema::Base::UInt32), refs, count, values, value_count);
}

fmi3Status fmi3SetUInt32(fmi3Instance c, const fmi3ValueReference refs[], size_t count, const fmi3UInt32 values[],
                         size_t value_count) {
  return set3(c, "fmi3SetUInt32", set_of(schema::Base::UInt32), refs, count, values, value_count);
}

fmi3Status fmi3GetInt64(fmi3Instance c, const fmi3ValueReference refs[], size_t count, fmi3Int64 values[],
                        size_t value_count) {
  return get3(c, "fmi3GetInt64", kInt64s, refs, count, values, value_count);
}

fmi3Status fmi3SetInt64(fmi3Instance c, const fmi3ValueReference refs[], size_t count, const fmi3Int64 values[],
                        size_t value_count) {
  return set3(c, "fmi3SetInt64", kInt64s, refs, count, values, value_count);
}

fmi3Status fmi3GetUInt64(fmi3Instance c, const fmi3ValueReference refs[], size_t count, fmi3UInt64 values[],
                         size_t value_count) {
  return get3(c, "fmi3GetUInt64", set_of(schema::Base::UInt64), refs, count, values, value_count);
}

fmi3Status fmi3SetUInt64(fmi3Instance c, const fmi3ValueReference refs[], size_t count, const fmi3UInt64 values[],
                         size_t value_count) {
  return set3(c, "fmi3SetUInt64", set_of(schema::Base::UInt64), refs, count, values, value_count);
}

fmi3Status fmi3GetBoolean(fmi3Instance c, const fmi3ValueReference refs[], size_t count, fmi3Boolean values[],
                          size_t value_count) {
  return get3(c, "fmi3GetBoolean", kBooleans, refs, count, values, value_count);
}

fmi3Status fmi3SetBoolean(fmi3Instance c, const fmi3ValueReference refs[], size_t count, const fmi3Boolean values[],
                          size_t value_count) {
  return set3(c, "fmi3SetBoolean", kBooleans, refs, count, values, value_count);
}
