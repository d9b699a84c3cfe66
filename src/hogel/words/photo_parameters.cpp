// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <string_view>

#include "hogel/error.h"
#include "hogel/requests.h"

namespace hogel {
namespace {

[[noreturn]] void refuse(const std::string& parameter, const std::string& why) {
    throw Error(ErrorCode::usage, parameter, why);
}

constexpr const char* needs_hogels =
    "needs the hogels of a light field or a scene; of a hologram only samples are known";

}  // namespace

std::string WaveCameraParameters::name() const {
    return camera == "hogel-spectra" ? "eye"
           : camera == "samples"     ? "narrow"
           : camera == "plane-waves" ? "full"
                                     : camera;
}

std::size_t WaveCameraParameters::number_of_looks() const {
    if (is_speckle_free()) return 1;
    if (looks.empty()) return 0;
    constexpr double max_looks = 1 << 24;
    const std::optional<double> number = parse_number(looks);
    if (!number || !(*number >= 1 && *number <= max_looks) || *number != std::floor(*number))
        refuse("looks", fmt::format("'{}' is not a number of looks from 1 to {:.0f}", looks, max_looks));
    return static_cast<std::size_t>(*number);
}

CameraModel WaveCameraParameters::model() const {
    const std::string model = name();
    if (model == "full") return PlaneWaveCamera{{}, film_distance};
    if (is_speckle_free()) return SpeckleFreeCamera();
    return BandCamera{.source = model == "eye"      ? BandSource::hogel_spectra
                                : model == "narrow" ? BandSource::samples
                                                    : BandSource::automatic,
                      .vertical_diffuser = diffuser == "vertical",
                      .preview = preview};
}

// Files of earlier versions say that a photograph is speckle-free by its looks.
void WaveCameraParameters::read_looks() {
    if (looks == "expected") {
        looks.clear();
        speckle = "none";
    }
    static_cast<void>(number_of_looks());
}

void WaveCameraParameters::resolve(PhotographSource photographed) {
    source = photographed;
    camera = name();
    const bool is_full = camera == "full", is_sampled = is_full || camera == "narrow",
               has_diffuser = diffuser != "none";
    read_looks();
    if (source == PhotographSource::rays && camera != "auto")
        refuse("camera", fmt::format("{} photographs waves; give wave or a hologram", camera));
    if (source == PhotographSource::samples && camera == "eye") refuse("camera", fmt::format("eye {}", needs_hogels));
    if (is_speckle_free()) {
        if (source == PhotographSource::rays)
            refuse("speckle", "none is of waves, and rays have no speckle; give wave");
        if (source == PhotographSource::samples) refuse("speckle", fmt::format("none {}", needs_hogels));
        if (is_sampled)
            refuse("speckle", fmt::format("none needs the hogels, not samples; leave out the camera {}", camera));
        if (has_diffuser) refuse("speckle", "none is not known behind a diffuser; leave out the diffuser");
    }
    if (preview && (source != PhotographSource::hogels || is_speckle_free() || is_sampled))
        refuse("preview",
               "leaves out waves of the hogels of a light field or a scene; it is for a number of looks of waves and "
               "the camera eye");
    if (has_diffuser && is_full) refuse("diffuser", "vertical is of the narrow-band camera; leave out the camera full");
    if (film_distance != 0 && !is_full)
        refuse("film_distance", "the thin lens belongs to the full camera; add the camera full");
}

std::string WaveCameraParameters::resolve(std::span<const LightFieldGrid> faces, const HologramRequest& request,
                                          std::span<const Camera> cameras) {
    read_looks();
    const BandSourceChoice choice = choose_band_source(faces, request, cameras, model());
    const std::string asked = name(), chosen = choice.source == BandSource::hogel_spectra ? "eye" : "narrow";
    if (preview && chosen != "eye") refuse("preview", fmt::format("{}; leave it out", choice.reason));
    if (asked == "eye" && chosen != "eye") refuse("camera", fmt::format("{}; narrow would do", choice.reason));
    camera = asked == "full" ? asked : chosen;
    return choice.reason;
}

Parameter& WaveCameraParameters::declare_camera(Parameters& parameters, bool with_plane_waves) {
    std::vector<std::string> names{"auto", "eye", "narrow"}, words{"hogel-spectra", "samples"};
    std::string help =
        "Camera of photographs by waves:"
        "\nauto: eye if the hogels are known and it is cheaper, otherwise narrow"
        "\neye, hogel-spectra: light through the lens directly from hogel spectra, without samples"
        "\nnarrow, samples: light through the lens as a narrow band, from all samples, tile by tile";
    if (with_plane_waves) {
        names.emplace_back("full");
        words.emplace_back("plane-waves");
        help += "\nfull, plane-waves: plane waves to the lens and back, exact and slow";
    }
    const std::string type = fmt::format("{}", fmt::join(names, "|"));
    names.insert(names.end(), words.begin(), words.end());
    return parameters.choice("--camera", camera, names, type, help).acts_if([this] {
        return source != PhotographSource::rays;
    });
}

Parameter& WaveCameraParameters::declare_looks(Parameters& parameters, const std::string& names,
                                               const std::string& help) {
    return parameters.text(names, looks, "NUMBER", help);
}

Parameter& WaveCameraParameters::declare_speckle(Parameters& parameters) {
    return parameters.choice("--speckle", speckle, {"averaged", "none"}, "averaged|none",
                             "Speckle of photographs by waves:"
                             "\naveraged: over the looks"
                             "\nnone: the mean over infinitely many looks; also --looks expected");
}

void WaveCameraParameters::declare(Parameters& parameters) {
    declare_camera(parameters, true);
    parameters.flag("--preview", preview, "Skip waves far outside the lens: faster but less exact, for the camera eye")
        .acts_if([this] { return preview; });
    parameters
        .length(
            "--film-distance", film_distance,
            "Distance from a thin lens, with its aberrations, to the film, for the full camera; 0mm: a perfect lens")
        .acts_if([this] { return source != PhotographSource::rays && camera == "full"; });
    parameters
        .choice("--diffuser", diffuser, {"none", "vertical"}, "none|vertical",
                "Diffuser in front of a hologram with horizontal parallax only:"
                "\nvertical: spreads the light of each line to all heights")
        .acts_if([this] { return source == PhotographSource::samples && camera != "full"; });
}

void PhotoParameters::resolve(PhotographSource photographed) {
    if (bench.is_used) {  // no option of the eye's cameras acts
        if (display == "phase") refuse("display", "phase is that of the full camera; leave it out on the bench");
        view.is_bench = true;
        waves.source = PhotographSource::rays;
        geometric = wave = false;
        return;
    }
    if (geometric && photographed == PhotographSource::samples)
        refuse("geometric", "a hologram has no rays to follow; give its light field or scene");
    waves.resolve(photographed);
    if (display == "phase" && (waves.camera != "full" || waves.film_distance != 0))
        refuse("display", "phase is that of the full camera with a perfect lens; add the camera full");
    geometric = photographed == PhotographSource::rays;
    wave = !geometric;
}

void PhotoParameters::declare(Parameters& parameters) {
    view.declare(parameters);
    view.declare_motion(parameters);
    waves
        .declare_looks(parameters, "--looks,--average",
                       "Photographs averaged against speckle, unless of a hologram file")
        .acts_if(
            [this] { return waves.source == PhotographSource::hogels && waves.has_looks && !waves.is_speckle_free(); });
    waves.declare_speckle(parameters).acts_if([this] { return waves.source == PhotographSource::hogels; });
    parameters.text("--exposure", exposure, "NUMBER|auto", "Factor for linear values in PNG, or auto").acts_if([this] {
        return display == "intensity" && !is_linear;
    });
    parameters.choice("--display", display, {"intensity", "log", "phase"}, "intensity|log|phase",
                      "What a photograph by waves shows:"
                      "\nintensity: linear light"
                      "\nlog: four decades of light from black to white"
                      "\nphase: relative to the phase of light through the middle of the lens, from -pi to pi");
    waves.declare(parameters);
    const Parameter& by_rays =
        parameters.flag("--geometric", geometric, "By rays rather than waves (default for a light field)")
            .acts_if([this] { return geometric; });
    parameters.flag("--wave", wave, "By waves, through the hologram (default for a scene)")
        .excludes(by_rays)
        .acts_if([this] { return wave && waves.source != PhotographSource::samples; });
    parameters.count("--pupil-samples", pupil_samples, "Sample points of the pupil in a geometric photograph")
        .acts_if([this] { return geometric; });
    bench.declare(parameters);
}

}  // namespace hogel
