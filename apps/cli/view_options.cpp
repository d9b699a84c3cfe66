// SPDX-License-Identifier: Apache-2.0
#include "view_options.h"

namespace hogel::cli {

void add_view_options(Command& command, ViewerParameters& options) {
    command.examples(
        "  hogel view pumpkin.h5\n"
        "  hogel view bunny.ply --hogels 200 --size 30mm\n"
        "  hogel view pumpkin.hgl --port 8080 --no-browser\n"
        "  hogel view hologram.h5\n"
        "  hogel view phase.png --phase-code slmsuite --pitch 8um --wavelength 532nm");
    command.basics(
        {"port", "no-browser", "hogels", "directions", "size", "rotate", "light", "memory", "pitch", "wavelength"});
    options.declare(command);
}

}  // namespace hogel::cli
