// SPDX-License-Identifier: Apache-2.0
#include "hogel/requests.h"

namespace hogel {

PrinterImageOptions PrintParameters::options() const {
    PrinterImageOptions asked = images;
    asked.serpentine = order == "serpentine";
    return asked;
}

void PrintParameters::declare(Parameters& parameters) {
    parameters.flag("--strips", images.rows, "One picture a row of hogels, side by side, instead of one a hogel");
    parameters.choice("--order", order, {"serpentine", "rows"}, "NAME",
                      "serpentine: every second row from the right\nrows: all rows from the left");
    parameters
        .number("--exposure", images.exposure, "NUMBER",
                "What linear values are multiplied by, the same in all pictures")
        .positive();
}

}  // namespace hogel
