// SPDX-License-Identifier: Apache-2.0
#include "fields.h"

#include <fmt/format.h>

#include "hogel/error.h"

namespace hogel::cli {
void add_field_options(Command& command, FieldOptions& options) {
    command.group("Fields of other programs");
    command.choice(
        "--values", options.values, {"amplitude", "phase"}, "amplitude|phase",
        "What real numbers are, in arrays and pictures:\nphase: radians, or whole numbers that divide a turn");
    command.text("--imaginary", options.imaginary, "P.exr", "Picture of imaginary parts; the input has the real ones");
    command.text("--variable", options.variable, "NAME", "Array of a MAT file that has several");
    command.flag("--conjugate", options.conjugate, "Its waves go as e^(+iwt)");
}

bool is_external(const std::string& name, const FieldOptions& options) {
    std::error_code status;
    if (!std::filesystem::is_regular_file(name, status)) return false;
    if (is_external_array(name)) return true;
    return (!options.values.empty() || !options.imaginary.empty()) && file_kind(name) == FileKind::picture;
}

Fields open_fields(const std::string& name, const FieldOptions& options, const Command& command, double pitch,
                   const std::vector<double>& wavelengths, RunRecord& record) {
    const bool pitch_given = command.given("--pitch"), wavelength_given = command.given("--wavelength");
    if (!is_external(name, options)) {
        for (const char* option : {"--values", "--imaginary", "--variable", "--conjugate"})
            if (command.given(option))
                throw Error(ErrorCode::usage,
                            fmt::format("{}: is for fields of other programs; {} is a hologram", option, name));
        if (pitch_given || wavelength_given)
            throw Error(ErrorCode::usage, fmt::format("{}: {} comes from the file itself", name,
                                                      pitch_given ? "--pitch" : "--wavelength"));
        return open_hologram(name);
    }
    const std::size_t colours = external_colours(name);
    if (!pitch_given || !wavelength_given || wavelengths.size() != colours)
        throw Error(ErrorCode::usage,
                    fmt::format("{}: does not say how it is sampled; give --pitch and {} --wavelength", name,
                                colours == 1 ? "one" : "three wavelengths with"));
    ExternalField what;
    what.pitch_x = what.pitch_y = pitch;
    what.values = options.values == "phase"       ? ExternalField::Values::phase
                  : options.values == "amplitude" ? ExternalField::Values::amplitude
                                                  : ExternalField::Values::complex;
    what.imaginary = options.imaginary;
    what.variable = options.variable;
    what.conjugate = options.conjugate;
    record.acted({"pitch", "wavelength", "values", "imaginary", "conjugate"});
    if (std::filesystem::path(name).extension() == ".mat") record.acted({"variable"});
    Fields fields;
    for (what.colour = 0; what.colour < colours; ++what.colour) {
        what.wavelength = wavelengths[what.colour];
        fields.push_back(open_external_field(name, what));
    }
    return fields;
}

}  // namespace hogel::cli
