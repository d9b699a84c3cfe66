// SPDX-License-Identifier: Apache-2.0
#include "fields.h"

#include <fmt/format.h>

#include "hogel/error.h"

namespace hogel::cli {
namespace {

constexpr const char* group = "Fields of other programs";

}  // namespace

void add_field_options(CLI::App* command, FieldOptions& options) {
    command
        ->add_option(
            "--values", options.values,
            "What real numbers are, in arrays and pictures:\nphase: radians, or whole numbers that divide a turn")
        ->type_name("amplitude|phase")
        ->check(CLI::IsMember({"amplitude", "phase"}).description(""))
        ->group(group);
    command->add_option("--imaginary", options.imaginary, "Picture of imaginary parts; the input has the real ones")
        ->type_name("P.exr")
        ->group(group);
    command->add_option("--variable", options.variable, "Array of a MAT file that has several")
        ->type_name("NAME")
        ->group(group);
    command->add_flag("--conjugate", options.conjugate, "Its waves go as e^(+iwt)")->group(group);
}

bool is_external(const std::string& name, const FieldOptions& options) {
    std::error_code status;
    if (!std::filesystem::is_regular_file(name, status)) return false;
    if (is_external_array(name)) return true;
    return (!options.values.empty() || !options.imaginary.empty()) && file_kind(name) == FileKind::picture;
}

HologramFile open_fields(const std::string& name, const FieldOptions& options, const CLI::App* command, double pitch,
                         const std::vector<double>& wavelengths) {
    const bool pitch_given = command->get_option("--pitch")->count() > 0,
               wavelength_given = command->get_option("--wavelength")->count() > 0;
    if (!is_external(name, options)) {
        if (pitch_given || wavelength_given)
            throw Error(ErrorCode::usage, fmt::format("{}: {} comes from the file itself", name,
                                                      pitch_given ? "--pitch" : "--wavelength"));
        return open_hologram(name);
    }
    if (!pitch_given || !wavelength_given || wavelengths.size() != 1)
        throw Error(ErrorCode::usage,
                    fmt::format("{}: does not say how it is sampled; give --pitch and one --wavelength", name));
    ExternalField what;
    what.pitch_x = what.pitch_y = pitch;
    what.wavelength = wavelengths.front();
    what.values = options.values == "phase"       ? ExternalField::Values::phase
                  : options.values == "amplitude" ? ExternalField::Values::amplitude
                                                  : ExternalField::Values::complex;
    what.imaginary = options.imaginary;
    what.variable = options.variable;
    what.conjugate = options.conjugate;
    HologramFile file;
    file.fields.push_back(open_external_field(name, what));
    return file;
}

}  // namespace hogel::cli
