// SPDX-License-Identifier: Apache-2.0
// Fills all pools; what is in an image does not matter for its way.

#include <indurop/generated.h>
#include <indurop/indurop.h>

#include <cstring>

using namespace pooltest::Figures;

namespace {

template <class Pool>
void take_image(const Pool& pool) {
  if (auto image = pool.take()) {
    image->index = taken;
    std::memset(&image->pixels, static_cast<int>(image->index & 0xFFU), sizeof image->pixels);
    image.publish();
  }
}

}  // namespace

int main() {
  irp::initPeriodExe();
  while (irp::waitPeriod()) {
    take_image(vga);
    take_image(hd);
    take_image(colour);
    taken += 1;
  }
}
