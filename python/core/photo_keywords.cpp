// SPDX-License-Identifier: Apache-2.0
// Cameras, photographs and make() from keywords, by the parameter structs of the command line.
#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "hogel/field.h"
#include "hogel/requests.h"
#include "keywords.h"

namespace hogel::python {
namespace {

using py::arg;
/// Light field and request of holograms that are computed on demand.
using Origin = std::optional<std::pair<LightField, HologramRequest>>;

// Parameters of photographs, from keywords.
struct PhotoKeywords {
    bool expected = false;  // --speckle none
    PhotoParameters values;
    Parameters table;

    explicit PhotoKeywords(const py::dict& keywords = {}) {
        values.is_linear = true;  // Picture.save() stores the exposure
        values.declare(table);
        table.flag("--expected", expected, "As speckle=\"none\"").never_acts();
        read_keywords(table, keywords);
        if (expected) values.waves.speckle = "none";
    }
    void resolve(PhotographSource source) {
        if (expected) return with_renamed_parameters({{"speckle", "expected"}}, [&] { values.resolve(source); });
        values.resolve(source);
    }
};

struct MakeKeywords {
    std::uint64_t seed = 1;
    MakeParameters values;
    Parameters table;

    explicit MakeKeywords(const py::dict& keywords = {}) {
        table.whole("--seed", seed, std::numeric_limits<std::uint64_t>::max(), "Seed of the random phases");
        table.wavelengths(values.hologram.wavelengths);
        values.declare(table, true);
        values.render.declare_hemicube(table);
        values.render.declare_directions(table);
        read_keywords(table, keywords);
        values.fit();
    }
};

// Parameters of one camera, and the given others of photographs.
py::list described_photo(const std::vector<std::string>& others) {
    const PhotoKeywords photo;
    const Keywords<CameraParameters> camera;
    return described(photo.table, [&](const Parameter& each) {
        return camera.table.look_up(each.name) != nullptr || std::ranges::count(others, each.name) > 0;
    });
}

CameraModel wave_camera(const py::dict& keywords, const Fields& fields) {
    PhotoKeywords asked(keywords);
    const bool on_demand =
        std::ranges::any_of(fields, [](const auto& field) { return field->stereogram() != nullptr; });
    asked.resolve(on_demand ? PhotographSource::hogels : PhotographSource::samples);
    return asked.values.waves.model();
}

Metadata wave_photograph_record(const py::dict& keywords, const Origin& origin, const std::vector<Camera>& cameras) {
    PhotoKeywords asked(keywords);
    WaveCameraParameters& waves = asked.values.waves;
    asked.resolve(origin ? PhotographSource::hogels : PhotographSource::samples);
    if (!origin) {
        if (waves.camera == "auto") waves.camera = "narrow";
        return asked.table.acting();
    }
    const auto& [light_field, request] = *origin;
    waves.resolve(light_field.grids(), request, cameras);
    HologramParameters hologram;
    hologram.resolve(request, light_field.grid());
    waves.has_looks = hologram.is_seeded;
    if (!waves.is_speckle_free()) waves.looks = std::to_string(request.looks);
    return asked.table.acting();
}

void add_cameras(py::module_& module) {
    module.def("camera_keywords", [] { return described(Keywords<CameraParameters>().table); });
    module.def(
        "camera",
        [](const py::dict& keywords, double width, double height) {
            return Keywords<CameraParameters>(keywords).values.cameras(width, height).front();
        },
        arg("keywords"), arg("width"), arg("height"));
}

void add_ray_photographs(py::module_& module) {
    module.def("ray_photograph_keywords", [] { return described_photo({"pupil-samples"}); });
    module.def(
        "pupil_samples", [](const py::dict& keywords) { return PhotoKeywords(keywords).values.pupil_samples; },
        arg("keywords"));
    module.def(
        "ray_photograph_record",
        [](const py::dict& keywords) {
            PhotoKeywords asked(keywords);
            asked.resolve(PhotographSource::rays);
            return asked.table.acting();
        },
        arg("keywords"));
}

}  // namespace

void add_photo_keywords(py::module_& module) {
    add_cameras(module);
    add_ray_photographs(module);
    module.def("wave_photograph_keywords", [] {
        return described_photo({"camera", "speckle", "expected", "preview", "film-distance", "diffuser"});
    });
    module.def("wave_camera", &wave_camera, arg("keywords"), arg("fields"));
    module.def("wave_photograph_record", &wave_photograph_record, arg("keywords"), arg("origin"), arg("cameras"));
    module.def("make_keywords", [] {
        return described(MakeKeywords().table,
                         [](const Parameter& each) { return each.group != "Scene" && each.name != "fit"; });
    });
    module.def(
        "make_request",
        [](const py::dict& keywords) {
            const MakeKeywords asked(keywords);
            return asked.values.request(asked.seed);
        },
        arg("keywords"));
    module.def(
        "make_note_about_pitch",
        [](const py::dict& keywords, const MakeRequest& request) {
            return MakeKeywords(keywords).values.hologram.note_about_pitch(request.hologram, request.light_field.grid);
        },
        arg("keywords"), arg("request"));
}

}  // namespace hogel::python
