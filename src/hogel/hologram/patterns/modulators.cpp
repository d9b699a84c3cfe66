// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "hogel/error.h"
#include "hogel/pattern.h"
#include "hogel/units.h"

namespace hogel {

using namespace literals;

const std::vector<Modulator>& modulators() {
    static const std::vector<Modulator> list{
        {"gaea-2", 3840, 2160, 3.74_um}, {"leto", 1920, 1080, 6.4_um},      {"luna", 1920, 1080, 4.5_um},
        {"pluto", 1920, 1080, 8.0_um},   {"ti-plm", 960, 540, 10.8_um, 16},
    };
    return list;
}

const Modulator& find_modulator(const std::string& name) {
    std::string names;
    for (const Modulator& modulator : modulators()) {
        if (modulator.name == name) return modulator;
        names += (names.empty() ? "" : ", ") + modulator.name;
    }
    throw Error(ErrorCode::usage, fmt::format("unknown modulator '{}'; known ones: {}", name, names));
}

}  // namespace hogel
