// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "command_line.h"
#include "hogel/files.h"
#include "session.h"

namespace hogel::cli {

/// Options that describe a field written by another program, and how it is looked at.
struct FieldOptions {
    std::string code_option = "--phase-code";  ///< where the command has another option of this name
    std::string values, phase_code, imaginary, phases, zero = "median", variable;
    bool conjugate = false;
    std::string order, reconstruct = "none";
    double aperture = 0, focal = 0;
    Vec3 reference_source;

    bool is_external = false;         ///< whether a field of another program is read, so that the options act
    double pitch = 0;                 ///< where the command has no --pitch of its own
    std::vector<double> wavelengths;  ///< likewise
};
/// The options of what the file holds; with `sampling` also --pitch and --wavelength. @param brief  leave the
/// explanations of their choices to the help of `photo`, where other files than fields are more usual
void add_field_options(Command& command, FieldOptions& options, bool sampling, bool brief = false);
/// The options of a lens or a reference wave between the hologram and what it shows.
void add_reconstruction_options(Command& command, FieldOptions& options);

/// Whether a name is that of another program's field: an array, a picture that the options declare as one, or a
/// pattern.
bool is_external(const std::string& name, const FieldOptions& options);

/// Whether a file is a picture that describes its field, as patterns do, and no option describes it.
bool is_pattern(const std::string& name, const FieldOptions& options);

/// Throws Error(usage) for a picture, of which options must say what its numbers are.
void require_described(const std::string& name, const FieldOptions& options);

/// What the options say of a file, without its sampling. Throws Error(usage).
ExternalField external_field(const FieldOptions& options);

/// Opens a hologram, or another program's field with the --pitch and the --wavelength, one for each of its colours,
/// that are given to the command or that the file holds. Says in a line where the file says something else than an
/// option. Throws Error(usage) if they are missing, or if they are given for a hologram, which has its own. Sets the
/// values that the file says.
Fields open_fields(const Session& session, const std::string& name, FieldOptions& options, double& pitch,
                   std::vector<double>& wavelengths);

/// As open_fields(), and then as add_reconstruction_options() say: the order of a recorded hologram, and the image
/// behind a lens. Says in a line what order was found.
Fields open_and_reconstruct(const Session& session, const std::string& name, FieldOptions& options, double& pitch,
                            std::vector<double>& wavelengths);

}  // namespace hogel::cli
