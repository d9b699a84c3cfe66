// SPDX-License-Identifier: Apache-2.0
// Requests from keywords, by the parameters that the command line has.
#include "hogel/requests.h"

#include <limits>

#include "keywords.h"

namespace hogel::python {
namespace {

// The parameters of Scene.render(), with the values of keywords.
struct LightFieldKeywords {
    LightFieldParameters values;
    Parameters table;

    explicit LightFieldKeywords(const py::dict& keywords) {
        values.declare(table);
        values.declare_hemicube(table);
        values.declare_directions(table);
        read_keywords(table, keywords);
    }
};

struct HologramKeywords {
    std::uint64_t seed = 1;
    HologramParameters values;
    Parameters table;

    explicit HologramKeywords(const py::dict& keywords) {
        table.whole("--seed", seed, std::numeric_limits<std::uint64_t>::max(), "");
        values.declare(table);
        read_keywords(table, keywords);
    }
};

Metadata light_field_record(const py::dict& keywords, const Scene& placed, bool is_file, const ShadedScene& lit) {
    LightFieldKeywords asked(keywords);
    asked.values.scene.resolve(placed, is_file);
    asked.values.resolve(placed);
    asked.values.resolve(lit);
    return asked.table.acting();
}

}  // namespace

void add_keywords(py::module_& module) {
    using py::arg;
    module.def("parse_light", parse_light, arg("text"));
    module.def("light_text", light_text, arg("light"));
    module.def("scene_keywords", [] { return described(Keywords<SceneParameters>().table); });
    module.def(
        "scene_pose",
        [](const py::dict& keywords) { return Keywords<SceneParameters>(keywords).values.complete_pose(); },
        arg("keywords"));
    module.def("light_field_keywords", [] {
        const LightFieldKeywords none{py::dict()};
        return described(none.table, [](const Parameter& each) { return each.group != "Scene" && each.name != "fit"; });
    });
    module.def(
        "light_field_request", [](const py::dict& keywords) { return LightFieldKeywords(keywords).values.request(); },
        arg("keywords"));
    module.def(
        "light_field_record",
        [](const py::dict& keywords, const Scene& placed, bool is_file, const std::shared_ptr<ShadedScene>& shaded) {
            return light_field_record(keywords, placed, is_file, *shaded);
        },
        arg("keywords"), arg("placed"), arg("is_file"), arg("shaded"));
    module.def("hologram_keywords", [] {
        const HologramKeywords none{py::dict()};
        return described(none.table, [](const Parameter&) { return true; });
    });
    module.def(
        "hologram_request",
        [](const py::dict& keywords, std::size_t looks, const LightField* light_field) {
            const HologramKeywords asked(keywords);
            return light_field == nullptr ? asked.values.request(asked.seed, looks)
                                          : asked.values.request(light_field->grids(), asked.seed, looks);
        },
        arg("keywords"), arg("looks"), arg("light_field") = nullptr);
    module.def(
        "note_about_pitch",
        [](const py::dict& keywords, const HologramRequest& request) {
            return HologramKeywords(keywords).values.note_about_pitch(request);
        },
        arg("keywords"), arg("request"));
    module.def(
        "hologram_record",
        [](const py::dict& keywords, const HologramRequest& request, const LightFieldGrid& front) {
            HologramKeywords asked(keywords);
            asked.values.resolve(request, front);
            return asked.table.acting();
        },
        arg("keywords"), arg("request"), arg("front"));
}

}  // namespace hogel::python
