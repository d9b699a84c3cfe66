// SPDX-License-Identifier: Apache-2.0
#include "hogel/requests.h"

namespace hogel {

PrinterImageOptions PrintParameters::options() const {
    PrinterImageOptions asked = images;
    asked.serpentine = order == "serpentine";
    return asked;
}

void PrintParameters::declare(Parameters& parameters) {
    parameters.flag("--strips", images.rows, "One picture per row of hogels, side by side, instead of one per hogel");
    parameters.choice(
        "--order", order, {"serpentine", "rows"}, "NAME",
        "Order of the hogels:\nserpentine: every second row from the right\nrows: all rows from the left");
    parameters.number("--exposure", images.exposure, "NUMBER", "Factor for linear values, the same in all pictures")
        .positive();
}

}  // namespace hogel
