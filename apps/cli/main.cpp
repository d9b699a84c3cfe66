// SPDX-License-Identifier: Apache-2.0
#include <cstdint>

#include "commands.h"
#include "hogel/resources.h"
#include "program.h"

int main(int argc, char** argv) {
    hogel::set_max_kept_memory(SIZE_MAX);  // the program ends with its command
    return hogel::cli::run_program(hogel::cli::commands(), argc, argv);
}
