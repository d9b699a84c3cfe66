// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "hogel/error.h"
#include "hogel/reconstruct.h"
#include "hogel/requests.h"
#include "hogel/units.h"

namespace hogel {
namespace {

std::string name_in_errors(std::string option) {
    option.erase(0, option.find_first_not_of('-'));
    std::ranges::replace(option, '-', '_');
    return option;
}

// Returns whether parameters give the meaning of a file's numbers.
bool are_described(const FieldParameters& field) {
    return !field.values.empty() || !field.phase_code.empty() || !field.imaginary.empty() || !field.phases.empty();
}

// Throws if the input is not a hologram, or if parameters describe it.
void require_hologram(const std::string& name, const FieldParameters& field, const Parameters& table) {
    field.require_described(name);
    std::error_code status;
    if (std::filesystem::is_regular_file(name, status) && file_kind(name) == FileKind::unknown)
        throw Error(ErrorCode::bad_input,
                    fmt::format("{}: is neither a hologram nor a field in a supported format: .npy, .npz, .mat of "
                                "MATLAB 5 to 7.3 (save -v7), .ohc, .exr and pictures",
                                name));
    if (input_kind(name) != InputKind::hologram)
        throw Error(ErrorCode::bad_input, fmt::format("{}: is not a hologram", name));
    for (const char* each : {"--values", field.code_option.c_str(), "--imaginary", "--phases", "--zero", "--variable",
                             "--conjugate", "--pitch", "--wavelength"})
        if (table.given(each))
            throw Error(ErrorCode::usage, name_in_errors(each),
                        fmt::format("{} is a hologram, which contains this; leave it out", name));
}

std::string short_lengths(const std::vector<double>& lengths) {
    std::vector<std::string> texts;
    for (const double length : lengths) std::erase(texts.emplace_back(format_length(length)), ' ');
    return fmt::format("{}", fmt::join(texts, ","));
}

// Returns notes on given parameters that contradict the file.
std::vector<std::string> contradictions(const std::string& name, const FieldParameters& field, const Parameters& table,
                                        const ExternalFacts& facts, const ExternalField& external) {
    std::vector<std::string> notes;
    const auto compare = [&](const std::string& option, const std::string& used, const std::string& stored) {
        if (table.given(option) && !stored.empty() && stored != used)
            notes.push_back(fmt::format("{}: {} {} is used, but the file says {}", name, option, used, stored));
    };
    if (facts.pitch_x > 0 && (facts.pitch_x != external.pitch_x || facts.pitch_y != external.pitch_y))
        compare("--pitch", short_lengths({external.pitch_x}),
                short_lengths(facts.pitch_x == facts.pitch_y ? std::vector{facts.pitch_x}
                                                             : std::vector{facts.pitch_x, facts.pitch_y}));
    compare("--wavelength", short_lengths(field.wavelengths), short_lengths(facts.wavelengths));
    compare("--values", field.values, facts.values);
    if (!facts.phase_code.empty() && external.phase_code && *external.phase_code != parse_phase_code(facts.phase_code))
        compare(field.code_option, field.phase_code, facts.phase_code);
    return notes;
}

// Sets parameters that are not given and describe the numbers to the values in the file.
void complete_values(FieldParameters& field, const Parameters& table, const ExternalFacts& facts,
                     const ExternalField& external) {
    const bool phases = field.values.empty() || field.values == "phase";
    if (!table.given(field.code_option)) {
        if (phases && !facts.phase_code.empty())
            field.phase_code = facts.phase_code;
        else if (!table.given("values"))
            field.values = facts.values;
    }
    // The default of `zero` is 0 for floating-point numbers.
    const bool is_whole = facts.numbers.starts_with("whole");
    if (!external.imaginary.empty() && !is_whole && !table.given("zero")) field.zero = "0";
}

// Sets the pitch and the wavelengths from the file, unless they are given.
void complete_sampling(FieldParameters& field, const std::string& name, const Parameters& table,
                       const ExternalFacts& facts, ExternalField& external) {
    const std::string why = facts.complaint.empty() ? "" : fmt::format(": {}", facts.complaint);
    if (table.given("pitch")) {
        external.pitch_x = external.pitch_y = field.pitch;
    } else if (facts.pitch_x > 0 && facts.pitch_y > 0) {
        external.pitch_x = facts.pitch_x;
        external.pitch_y = facts.pitch_y;
        field.pitch = facts.pitch_x == facts.pitch_y ? facts.pitch_x : 0;
    } else if (field.device_pitch > 0) {
        external.pitch_x = external.pitch_y = field.pitch = field.device_pitch;
    } else {
        throw Error(ErrorCode::usage, "pitch",
                    fmt::format("{} does not contain the pitch of its samples{}", name, why));
    }
    if (!table.given("wavelength")) {
        if (facts.wavelengths.empty())
            throw Error(ErrorCode::usage, "wavelength",
                        fmt::format("{} does not contain its wavelengths{}", name, why));
        field.wavelengths = facts.wavelengths;
    }
    const std::size_t count = field.wavelengths.size();
    if (count != facts.colours)
        throw Error(ErrorCode::usage, "wavelength",
                    fmt::format("{} holds {}, but {} given ({})", name,
                                facts.colours == 1 ? "one field" : fmt::format("{} fields", facts.colours),
                                count == 1 ? "one wavelength is" : fmt::format("{} wavelengths are", count),
                                facts.colours == 1 ? "one is needed" : "e.g. 638nm,520nm,450nm"));
}

// Selects the diffraction order of opened fields and computes the image behind a lens, as the parameters specify.
void make_images(const FieldParameters& field, OpenedFields& opened, const Progress& progress) {
    const bool image = field.reconstruct != "none";
    if (image != field.focal.has_value())
        throw Error(ErrorCode::usage, "focal",
                    image ? fmt::format("reconstruct {} needs a focal length or distance", field.reconstruct)
                          : "needs a reconstruction; add reconstruct");
    const OrderSelection selection = field.selection();
    const bool select =
        !field.order.empty() || field.aperture > 0 || selection.without_mean || selection.reference_source;
    for (std::size_t c = 0; c < opened.fields.size(); ++c) {
        std::shared_ptr<const FieldSource>& source = opened.fields[c];
        if (select) {
            SelectedOrder order = select_order(*source, selection, progress.part(c, opened.fields.size()));
            opened.notes.push_back(fmt::format("{}: the order at {:.4f}, {:.4f} cycles per sample, within {:.4f}",
                                               format_length(source->grid().wavelength), order.frequency_x,
                                               order.frequency_y, order.radius));
            source = std::make_shared<Field>(std::move(order.field));
        }
        if (image)
            source = with_parameter("focal", [&] {
                return std::make_shared<Field>(field.reconstruct == "fourier" ? fourier_image(*source, *field.focal)
                                                                              : fresnel_image(*source, *field.focal));
            });
    }
}

std::string help_of_values(bool brief) {
    if (brief) return ": amplitude, phase, intensity; for pairs real-imaginary, amplitude-phase";
    return " in arrays and pictures:\namplitude, phase: phases in radians, or as whole numbers in a phase code\n"
           "intensity: recorded by a camera; its mean is subtracted\n"
           "real-imaginary, amplitude-phase: for arrays with two numbers per sample";
}

std::string help_of_codes(bool brief) {
    if (brief) return fmt::format(": {}, or a description", fmt::join(phase_codes().names(), ", "));
    std::string help = ":";
    for (const PhaseCodeInfo& code : phase_codes().rows()) help += fmt::format("\n{}: {}", code.name, code.text);
    return help + "\nany other: range=ANGLE,offset=ANGLE,invert, in deg, rad or pi (2pi)";
}

}  // namespace

void FieldParameters::declare(Parameters& parameters, bool sampling, bool brief) {
    parameters.group(brief ? "Fields of other programs (see 'hogel help photo')" : "Fields of other programs",
                     [this] { return is_opened; });
    if (sampling) {
        parameters.positive_length("--pitch", pitch, "Pitch of the samples of another program's field")
            .default_text("from the file")
            .acts_if([this] { return pitch > 0; });  // not if the two pitches differ
        parameters.wavelengths(wavelengths).default_text("from the file");
    }
    parameters.choice("--values", values, {"amplitude", "phase", "intensity", "real-imaginary", "amplitude-phase"},
                      "KIND", "Meaning of real numbers" + help_of_values(brief));
    parameters.text(code_option, phase_code, "CODE", "Encoding of phases as numbers" + help_of_codes(brief));
    parameters.text("--imaginary", imaginary, "P", "Picture of the imaginary parts; the input has the real parts");
    parameters.text("--phases", phases, "P", "Picture of the phases; the input has the amplitudes");
    parameters
        .text("--zero", zero, "LEVEL|median",
              "Level that stands for 0 in pictures of real and imaginary parts; median: the median of each picture")
        .acts_if([this] { return !imaginary.empty(); });
    parameters.text("--variable", variable, "NAME", "Name of an array in a file with several; two names: re,im");
    parameters.flag("--conjugate", conjugate, "The field has the time dependence e^(+iwt)");
}

void FieldParameters::declare_reconstruction(Parameters& parameters, bool with_bench) {
    parameters.group("Reconstruction");
    parameters.text("--order", order, "0|+1|-1|FX,FY",
                    "Diffraction order of the object, cut out and moved to the middle of the spectrum:\n"
                    "+1, -1: the brightest to the right or left of frequency zero\n"
                    "FX,FY: the order at this frequency, cycles per sample to the right and upwards");
    parameters
        .number("--aperture", aperture, "CYCLES",
                "Radius of the aperture around the order, cycles per sample (default: half its distance from 0)")
        .no_default();
    parameters.point("--reference-source", reference_source,
                     "Source of the spherical reference wave; with z > 0, in front of the hologram: its focus");
    parameters
        .choice("--reconstruct", reconstruct, {"none", "fourier", "fresnel"}, "none|fourier|fresnel",
                "Optics between the hologram and its image, which is then in the plane of depth 0:\n"
                "fourier: a lens of focal length --focal, at that distance from both\n"
                "fresnel: free space of length --focal, by one Fourier transform")
        .no_default();
    parameters.length("--focal", focal,
                      with_bench ? "Focal length of the lens (fourier), or distance (fresnel); of both lenses of the "
                                   "bench, if there is no reconstruction"
                                 : "Focal length of the lens (fourier), or distance (fresnel)");
}

bool FieldParameters::is_external(const std::string& name) const {
    std::error_code status;
    if (!std::filesystem::is_regular_file(name, status)) return false;
    const bool described = are_described(*this);
    // An array of four axes is a light field or a field of several colours: the latter if parameters describe it.
    if (!described && is_view_set(name)) return false;
    return is_external_field(name) || (described && file_kind(name) == FileKind::picture);
}

bool FieldParameters::is_pattern(const std::string& name) const {
    return !are_described(*this) && is_external(name) && external_facts(name).format == "picture";
}

void FieldParameters::require_described(const std::string& name) const {
    std::error_code status;
    if (!is_external(name) && std::filesystem::is_regular_file(name, status) && file_kind(name) == FileKind::picture)
        throw Error(ErrorCode::usage, name_in_errors(code_option) + ", values, imaginary, phases",
                    fmt::format("{} is a picture; give the meaning of its numbers by one of these", name));
}

ExternalField FieldParameters::external_field() const {
    using Values = ExternalField::Values;
    ExternalField external;
    external.values = values == "phase"             ? Values::phase
                      : values == "real-imaginary"  ? Values::real_imaginary
                      : values == "amplitude-phase" ? Values::amplitude_phase
                      : values.empty()              ? Values::complex
                                                    : Values::amplitude;
    external.phase_code = own_code;
    if (!own_code && !phase_code.empty()) external.phase_code = parse_phase_code(phase_code);
    if (external.phase_code && values.empty() && phases.empty()) external.values = Values::phase;
    external.imaginary = imaginary;
    external.phases = phases;
    if (zero != "median") {
        external.zero = parse_number(zero);
        if (!external.zero)
            throw Error(ErrorCode::usage, "zero", fmt::format("'{}' is neither median nor a number", zero));
    }
    external.variable = variable;
    external.conjugate = conjugate;
    external.reflectance = is_reflectance;
    return external;
}

OrderSelection FieldParameters::selection() const {
    using Which = OrderSelection::Which;
    if (aperture < 0) throw Error(ErrorCode::usage, "aperture", "expected a positive radius");
    OrderSelection found;
    found.without_mean = values == "intensity";
    found.reference_source = reference_source;
    found.radius = aperture;
    if (order.empty() || order == "0") return found;
    const std::size_t comma = order.find(',');
    const auto x = parse_number(order.substr(0, comma));
    const auto y = comma == std::string::npos ? std::nullopt : parse_number(order.substr(comma + 1));
    if (order == "+1") {
        found.which = Which::right;
    } else if (order == "-1") {
        found.which = Which::left;
    } else if (x && y) {
        found.which = Which::at;
        found.frequency_x = *x;
        found.frequency_y = *y;
    } else {
        throw Error(ErrorCode::usage, "order",
                    fmt::format("'{}' is none of +1, -1, 0 and FX,FY in cycles per sample, e.g. 0.25,0", order));
    }
    return found;
}

OpenedFields FieldParameters::open(const std::string& name, const Parameters& table) {
    if (!is_external(name)) {
        require_hologram(name, *this, table);
        return {open_hologram(name), {}};
    }
    return with_renamed_parameters({{"phase_code", name_in_errors(code_option)}}, [&] {
        ExternalField external = external_field();
        const ExternalFacts facts = external_facts(name, external);
        if (!external.variable.empty() && facts.format != "npz" && facts.format != "mat" && facts.format != "exr")
            throw Error(ErrorCode::usage, "variable", fmt::format("{} has no variables with names", name));
        is_opened = true;
        complete_sampling(*this, name, table, facts, external);
        OpenedFields opened{{}, contradictions(name, *this, table, facts, external)};
        complete_values(*this, table, facts, external);
        if (!facts.panel.correction.empty())
            opened.notes.push_back(fmt::format("{}: contains the wavefront correction {}, which is not subtracted",
                                               name, facts.panel.correction));
        for (external.colour = 0; external.colour < facts.colours; ++external.colour) {
            external.wavelength = wavelengths[external.colour];
            opened.fields.push_back(open_external_field(name, external));
        }
        return opened;
    });
}

OpenedFields FieldParameters::open_and_reconstruct(const std::string& name, const Parameters& table,
                                                   const Progress& progress) {
    OpenedFields opened = open(name, table);
    make_images(*this, opened, progress);
    return opened;
}

}  // namespace hogel
