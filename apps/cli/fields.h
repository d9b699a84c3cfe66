// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "command_line.h"
#include "hogel/files.h"
#include "run_record.h"
#include "session.h"

namespace hogel::cli {

/// Options that describe a field written by another program.
struct FieldOptions {
    std::string values, imaginary, variable;
    bool conjugate = false;
};
void add_field_options(Command& command, FieldOptions& options);

/// Whether a name is that of another program's field: an array, or a picture that the options declare as one.
bool is_external(const std::string& name, const FieldOptions& options);

/// Opens a hologram, or another program's field with the --pitch and the --wavelength, one for each of its colours,
/// given to `command`. Throws Error(usage) if they are missing, or if they are given for a hologram, which has its own.
/// Records the options that acted.
Fields open_fields(const std::string& name, const FieldOptions& options, const Command& command, double pitch,
                   const std::vector<double>& wavelengths, RunRecord& record);

}  // namespace hogel::cli
