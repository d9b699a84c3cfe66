// SPDX-License-Identifier: Apache-2.0
#include "commands.h"
#include "program.h"

int main(int argc, char** argv) { return hogel::cli::run_program(hogel::cli::commands(), argc, argv); }
