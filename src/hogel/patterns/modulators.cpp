// SPDX-License-Identifier: Apache-2.0
#include "hogel/pattern.h"
#include "hogel/units.h"

namespace hogel {

using namespace literals;

Table<Modulator>& modulators() {
    static Table<Modulator> table("modulator",
                                  {
                                      {"gaea-2", 3840, 2160, 3.74_um},
                                      {"leto", 1920, 1080, 6.4_um},
                                      {"luna", 1920, 1080, 4.5_um},
                                      {"pluto", 1920, 1080, 8.0_um},
                                      {"ti-plm", 960, 540, 10.8_um, 16},
                                  },
                                  "device");
    return table;
}

}  // namespace hogel
