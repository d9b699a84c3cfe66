// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "hogel/error.h"
#include "hogel/light_field.h"
#include "hogel/requests.h"
#include "hogel/scene_hologram.h"
#include "hogel/table.h"
#include "hogel/units.h"

namespace hogel {
namespace {

const std::vector<std::string> average_names{"radiance", "amplitude"};
const std::vector<std::string> phase_names{"random", "fixed", "designed"};

void declare_hologram(Parameters& parameters, HologramParameters& options, const std::vector<std::string>& names,
                      const std::string& help) {
    parameters.group("Hologram");
    const auto is_sampled = [&options] { return options.is_made || options.is_sampled; };
    const auto is_made = [&options] { return options.is_made; };
    const auto has_lobes = [&options] {
        return options.made_by &&
               (std::holds_alternative<Fourier>(*options.made_by) || std::holds_alternative<Lines>(*options.made_by));
    };
    const auto is_basis = [&options] { return options.made_by && std::holds_alternative<Basis>(*options.made_by); };
    const auto has_phases = [&options] {
        return options.made_by && !std::holds_alternative<PhaseAdded>(*options.made_by) &&
               !std::holds_alternative<OwnMethod>(*options.made_by);
    };
    parameters.wavelengths(options.wavelengths).acts_if(is_sampled);
    options.declare_pitch(parameters).acts_if(is_sampled);
    parameters
        .positive_length("--line-pitch", options.lines,
                         "Pitch of the lines of --method lines or basis-lines (default: the sample pitch)")
        .no_default()
        .acts_if([&options] { return options.made_by && line_pitch(*options.made_by).has_value(); });
    parameters.choice("--method", options.method, names, "NAME", help).sets(options.method_given).acts_if(is_made);
    parameters
        .choice("--phase", options.phase, phase_names, "NAME",
                "Phases of the directions of each hogel:\n"
                "random: independent everywhere (default)\n"
                "fixed: the same in all hogels (default of basis); with olas zero, as of a smooth surface\n"
                "designed: the same in all hogels, for a fringe of uniform modulus")
        .acts_if(has_phases);
    parameters
        .choice("--lobes", options.average, average_names, "radiance|amplitude",
                "Strength of a hogel's lobe: the mean radiance of the directions that it covers, or "
                "(always with basis) their mean amplitude")
        .acts_if(has_lobes);
    parameters
        .text("--basis", options.basis, "NAME",
              fmt::format("Transform of the directions that defines the basis fringes: pieces (one fringe per "
                          "direction), {} (default: the file's, or {})",
                          fmt::join(transform_names(), ", "), defaults.basis))
        .acts_if(is_basis);
    parameters
        .number("--tolerance", options.tolerance, "0..1",
                "Maximum fraction of a hogel's amplitude in basis fringes that are left out")
        .range(0, 1)
        .acts_if(is_basis);
    if (Parameter* const seed = parameters.look_up("seed")) seed->acts_if([&options] { return options.is_seeded; });
}

// Returns the number of samples across a hogel. It is whole, so the pitch may differ slightly from the requested one.
double samples_across(const LightFieldGrid& front, double pitch) {
    return std::max(1.0, std::round(front.pitch / pitch));
}

// Returns the help of --method, one line per method of the table.
std::string help_of_methods() {
    std::string help = "Method that computes the hologram from the light field:";
    for (const HologramMethodInfo& method : hologram_methods().rows())
        help += fmt::format("\n{}: {}{}", method.name, method.text, method.needs_depth ? "; needs depth" : "");
    return help;
}

// Sets the options of a method; refuses options that it does not support.
struct Adjust {
    const HologramParameters& choices;

    void operator()(Fourier& method) const {
        method.phases = phases(Phases::random);
        method.average = average();
    }
    void operator()(Lines& method) const {
        method.line_pitch = choices.lines;
        method.phases = phases(Phases::random);
        method.average = average();
    }
    void operator()(Basis& method) const {
        const Phases chosen = phases(Phases::fixed);
        if (chosen == Phases::random)
            refuse("basis fringes have the same phases in all hogels: fixed or designed, not random");
        method.phases = chosen == Phases::designed ? SharedPhases::designed : SharedPhases::fixed;
        method.transform = choices.basis.empty() ? std::string(defaults.basis) : choices.basis;
        method.tolerance = choices.tolerance;
        if (method.line_pitch) method.line_pitch = choices.lines;
    }
    void operator()(PhaseAdded&) const {
        if (!choices.phase.empty())
            refuse("does not apply to the method phase-added, which uses the phases of the points");
    }
    void operator()(OverlapAdd& method) const {
        const Phases chosen = phases(Phases::random);
        if (chosen == Phases::designed) refuse("the method olas supports random or fixed phases, not designed");
        method.phases = chosen == Phases::fixed ? PointPhases::fixed : PointPhases::random;
    }
    void operator()(OwnMethod&) const {}

  private:
    Phases phases(Phases otherwise) const {
        return choices.phase == "random"     ? Phases::random
               : choices.phase == "fixed"    ? Phases::fixed
               : choices.phase == "designed" ? Phases::designed
                                             : otherwise;
    }
    LobeAverage average() const {
        return choices.average == "amplitude" ? LobeAverage::amplitude : LobeAverage::radiance;
    }
    void refuse(const char* expected) const { throw Error(ErrorCode::usage, "phase", expected); }
};

// Returns the part of a modulator's band that holograms for it use. Double-phase encoding shows a quarter. Other light
// needs a margin of half a lobe of eight pixels on each side.
double share_of_band(bool smooth) { return smooth ? 1.0 / 4 : 7.0 / 8; }

// Returns the largest sine of an angle from the axis that this part of a modulator's band diffracts to.
double max_sine(const Modulator& modulator, std::span<const double> wavelengths, bool smooth) {
    return std::min(1.0, share_of_band(smooth) * *std::ranges::min_element(wavelengths) / (2 * modulator.pitch));
}

}  // namespace

LightField HologramParameters::fitted(const LightField& light_field, const Modulator& modulator, bool smooth) const {
    const LightFieldGrid& grid = light_field.grid();
    const std::size_t most = std::min(modulator.width / grid.hogels_s, modulator.height / grid.hogels_t);
    if (most == 0 || light_field.has_sides()) return light_field;
    const double pixels = grid.pitch / modulator.pitch;
    const bool is_whole = std::abs(pixels - std::round(pixels)) < 1e-3 && std::round(pixels) >= 1 &&
                          std::round(pixels) <= static_cast<double>(most);
    const double new_pitch = is_whole ? grid.pitch : static_cast<double>(most) * modulator.pitch;
    const LightFieldGrid common = common_directions(grid);
    const double reach =
        std::max(std::abs(common.center_u()) + common.half_u(), std::abs(common.center_v()) + common.half_v());
    const double sine = grid.has_frequencies() ? reach : reach / std::hypot(1.0, reach);
    if (sine <= max_sine(modulator, wavelengths, false) * (1 + 1e-6))
        return is_whole ? light_field : with_scale(light_field, new_pitch, 1);
    const double wanted = max_sine(modulator, wavelengths, smooth);
    const double own = std::max(std::abs(grid.center_u()) + grid.half_u(), std::abs(grid.center_v()) + grid.half_v());
    return with_scale(light_field, new_pitch,
                      (grid.has_frequencies() ? wanted : wanted / std::sqrt(1 - wanted * wanted)) / own);
}

void HologramParameters::fit(const Modulator& modulator, LightFieldParameters& light_field, bool smooth) {
    const std::size_t side = smooth ? 2 : 4, directions = smooth ? 5 : 9;
    if (!pitch_given) pitch = modulator.pitch;
    pitch_given = true;
    Counts& hogels = light_field.hogels;
    if (!light_field.hogels_given)
        hogels = {std::max<std::size_t>(1, modulator.width / side), std::max<std::size_t>(1, modulator.height / side)};
    const std::size_t pixels = std::max<std::size_t>(1, modulator.width / hogels.columns);
    if (!light_field.size_given) light_field.size = static_cast<double>(hogels.columns * pixels) * modulator.pitch;
    if (!light_field.directions_given) light_field.directions = {directions, directions};
    if (light_field.field_of_view_given) return;
    const double angle = 2 * std::asin(max_sine(modulator, wavelengths, smooth));
    light_field.field_of_view = {angle, angle};
}

HologramMethod HologramParameters::hologram_method() const {
    const std::vector<std::string> known = transform_names();
    if (!basis.empty() && basis != "pieces" && !std::ranges::count(known, basis))
        throw_unknown("transform", basis, known, "basis");
    HologramMethod chosen = hologram_methods().find(method).method;
    if (lines > 0 && !line_pitch(chosen))
        throw Error(ErrorCode::usage, "line_pitch",
                    fmt::format("belongs to the methods lines and basis-lines, not {}", method));
    std::visit(Adjust{*this}, chosen);
    return chosen;
}

HologramRequest HologramParameters::request(std::uint64_t seed, std::size_t looks) const {
    HologramRequest request;
    request.channels.clear();
    for (const double wavelength : wavelengths) request.channels.push_back({wavelength, channel_of(wavelength)});
    request.pitch = pitch;
    request.method = hologram_method();
    request.looks = looks;
    request.seed = seed;
    return request;
}

HologramRequest HologramParameters::request(std::span<const LightFieldGrid> faces, std::uint64_t seed,
                                            std::size_t looks) const {
    HologramRequest made = request(seed, looks);
    if (!pitch_given) made.pitch = diffracting_pitch(faces, made);
    return made;
}

std::string HologramParameters::note_about_pitch(const HologramRequest& request) const {
    if (request.pitch == pitch) return "";
    return fmt::format("pitch: {}, as the field of view needs; the default, {}, is too coarse",
                       format_length(request.pitch), format_length(pitch));
}

std::string HologramParameters::note_about_pitch(const HologramRequest& request, const LightFieldGrid& front) const {
    const double samples = samples_across(front, pitch), effective = front.pitch / samples, exact = samples * pitch;
    if (!pitch_given || std::abs(effective - pitch) <= 1e-3 * pitch) return note_about_pitch(request);
    return fmt::format(
        "pitch: {} became {} because a hogel of {} holds {} samples; hogels of {} (--size {:.6g}mm) keep the pitch",
        format_length(pitch), format_length(effective), format_length(front.pitch), samples, format_length(exact),
        1e3 * exact * static_cast<double>(front.hogels_s));
}

void HologramParameters::resolve(const HologramRequest& request, const LightFieldGrid& front) {
    is_made = true;
    made_by = request.method;
    const double effective = front.pitch / samples_across(front, request.pitch);
    if (std::abs(effective - pitch) > 1e-9 * pitch) pitch = effective;
    if (const std::optional<double> apart = line_pitch(request.method)) lines = *apart > 0 ? *apart : effective;
    if (const auto* fringes = std::get_if<Basis>(&request.method)) basis = fringes->transform;
    if (phase.empty()) phase = std::holds_alternative<Basis>(request.method) ? "fixed" : "random";
    const auto* windows = std::get_if<OverlapAdd>(&request.method);
    is_seeded = windows == nullptr || windows->phases == PointPhases::random;
}

void HologramParameters::resolve(const FieldParameters& field) {
    is_sampled = field.is_opened;
    pitch = field.pitch;
    wavelengths = field.wavelengths;
}

Parameter& HologramParameters::declare_pitch(Parameters& parameters) {
    return parameters
        .positive_length("--pitch", pitch,
                         "Sample pitch, rounded to divide a hogel; the default is reduced if the field of view "
                         "needs it")
        .sets(pitch_given);
}

SceneHologramRequest HologramParameters::scene_request(std::uint64_t seed, const LightFieldParameters& place) const {
    const SceneHologramMethod& direct = scene_hologram_methods().find(method);
    if (place.fronts_only)
        throw Error(ErrorCode::usage, "cull_back_faces", fmt::format("is not supported by the method {}", direct.name));
    const double width = place.size;
    const double height = width * static_cast<double>(place.hogels.rows) / static_cast<double>(place.hogels.columns);
    if (!(width >= pitch && height >= pitch))
        throw Error(ErrorCode::usage, "size, pitch", "the hologram must have at least one sample");
    const Grid plane{static_cast<std::size_t>(std::lround(width / pitch)),
                     static_cast<std::size_t>(std::lround(height / pitch)),
                     pitch,
                     pitch,
                     0,
                     0};
    SceneHologramRequest request{direct.name, {}, {}};
    for (const double wavelength : wavelengths) {
        request.grids.push_back({plane, wavelength});
        request.options.push_back(
            {.channel = channel_of(wavelength), .seed = seed, .spacing = spacing, .planes = planes});
        validate(request.grids.back(), ErrorCode::usage, "hologram");
    }
    return request;
}

void HologramParameters::resolve(const SceneHologramMethod& direct) {
    is_made = is_seeded = true;
    has_spacing = direct.uses_spacing;
    has_planes = direct.uses_planes;
}

void check_holograms(std::span<const LightFieldGrid> faces, const HologramRequest& request, bool rendered,
                     std::span<const Camera> cameras) {
    const auto check = [&] { require_holograms(faces, request, cameras); };
    if (rendered) return check();
    with_renamed_parameters({{"fov", ""}, {"toward", ""}, {"size", ""}, {"hogels", ""}, {"directions", ""}}, check);
}

void HologramParameters::declare(Parameters& parameters) {
    declare_hologram(parameters, *this, hologram_methods().names(), help_of_methods());
}

void HologramParameters::declare_with_scene_methods(Parameters& parameters) {
    std::vector<std::string> names = hologram_methods().names();
    std::string help = help_of_methods() + "\nDirectly from a scene, without a light field:";
    for (const SceneHologramMethod& direct : scene_hologram_methods().rows()) {
        names.emplace_back(direct.name);
        help += fmt::format("\n{}: {}", direct.name, direct.text);
    }
    declare_hologram(parameters, *this, names, help);
    parameters
        .positive_length("--spacing", spacing,
                         "Spacing of points on surfaces and along edges, and of the lines of points-hpo")
        .acts_if([this] { return has_spacing; });
    parameters.count("--planes", planes, "Number of depth planes of the methods fresnel and planes").acts_if([this] {
        return has_planes;
    });
}

}  // namespace hogel
