// SPDX-License-Identifier: Apache-2.0
// Writes the age of each image to a file for each pool, in ns, as soon as it is there: ages-POOL-PROGRAM, so a
// copy of the program is another reader.

#include <indurop/generated.h>
#include <indurop/indurop.h>

#include <cerrno>
#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <string>

using namespace pooltest::Figures;

namespace {

std::FILE* file_of(const char* pool) {
  const char* const folder = std::getenv("POOLS_TEST_FOLDER");
  return std::fopen(
      (std::string(folder == nullptr ? "/tmp" : folder) + "/ages-" + pool + "-" + program_invocation_short_name)
          .c_str(),
      "w");
}

template <class Pool>
void read_new(const Pool& pool, std::FILE* file) {
  while (const auto image = pool.next()) {
    (void)std::fprintf(file, "%" PRId64 "\n", static_cast<std::int64_t>(image.age().count()));
    (void)std::fflush(file);
  }
}

}  // namespace

int main() {
  std::FILE* const vga_file = file_of("vga");
  std::FILE* const hd_file = file_of("hd");
  std::FILE* const colour_file = file_of("colour");
  irp::initPeriodExe();
  while (irp::waitPeriod()) {
    read_new(vga, vga_file);
    read_new(hd, hd_file);
    read_new(colour, colour_file);
  }
}
