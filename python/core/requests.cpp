// SPDX-License-Identifier: Apache-2.0
// Requests from keywords, by the parameter structs of the command line.
#include "hogel/requests.h"

#include <initializer_list>
#include <limits>
#include <utility>
#include <vector>

#include "keywords.h"

namespace hogel::python {
namespace {

void declare_light_field(LightFieldParameters& light_field, Parameters& table) {
    light_field.declare(table);
    light_field.declare_hemicube(table);
    light_field.declare_directions(table);
}

// Declares the parameters of commands that use a single face.
void declare_one_face(LightFieldParameters& light_field, Parameters& table) {
    light_field.declare(table);
    light_field.declare_focal_plane(table);
}

// Parameters of Scene.render(), from keywords.
struct LightFieldKeywords {
    LightFieldParameters values;
    Parameters table;

    explicit LightFieldKeywords(const py::dict& keywords) {
        declare_light_field(values, table);
        read_keywords(table, keywords);
    }
};

struct HologramKeywords {
    std::uint64_t seed = 1;
    std::size_t looks = 1;
    HologramParameters values;
    Parameters table;

    explicit HologramKeywords(const py::dict& keywords) {
        table.whole("--seed", seed, std::numeric_limits<std::uint64_t>::max(), "Of random phases");
        table.count("--looks", looks, "Statistically independent holograms of the same object").never_acts();
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

// Names of the parameters of a command: its operands and output options first, then groups.
class Order {
  public:
    Order(std::initializer_list<const char*> first) : names_{"seed"} {
        names_.insert(names_.end(), first.begin(), first.end());
    }
    /// @param declare  declares parameters of the group in a table
    template <class Group>
    Order& of(const std::function<void(Group&, Parameters&)>& declare) {
        Group group;
        Parameters table;
        declare(group, table);
        for (const Parameter& each : table.all()) names_.push_back(each.name);
        return *this;
    }
    template <class Group>
    Order& of() {
        return of<Group>([](Group& group, Parameters& table) { group.declare(table); });
    }
    operator std::vector<std::string>() const { return names_; }

  private:
    std::vector<std::string> names_;
};

void declare_field(FieldParameters& field, Parameters& table) {
    field.declare(table);
    field.declare_reconstruction(table);
}

// Returns the parameters of each command whose files store their options, in the order of the command line.
std::vector<std::pair<std::string, std::vector<std::string>>> command_parameters() {
    return {{"render", Order{"scene", "depth", "float", "sqnr"}.of<LightFieldParameters>(declare_light_field)},
            {"compress", Order{"input"}.of<CompressionParameters>()},
            {"decompress", Order{"input", "layers", "float", "half"}},
            {"hologram", Order{"input", "half"}
                             .of<HologramParameters>(
                                 [](auto& hologram, auto& table) { hologram.declare_with_scene_methods(table); })
                             .of<LightFieldParameters>(declare_light_field)},
            {"photo", Order{"input"}
                          .of<PhotoParameters>()
                          .of<HologramParameters>()
                          .of<LightFieldParameters>(declare_light_field)
                          .of<FieldParameters>(declare_field)},
            {"propagate", Order{"input"}.of<PropagateParameters>().of<FieldParameters>(declare_field)},
            {"slm", Order{"input"}
                        .of<PatternParameters>()
                        .of<HologramParameters>()
                        .of<LightFieldParameters>(declare_light_field)
                        .of<FieldParameters>([](auto& field, auto& table) {
                            field.code_option = "--input-phase-code";
                            declare_field(field, table);
                        })},
            {"print", Order{"input"}.of<PrintParameters>().of<LightFieldParameters>(declare_one_face)},
            {"bake", Order{"scene"}.of<BakeParameters>()},
            {"export", Order{"input"}.of<ExportParameters>().of<LightFieldParameters>(declare_one_face)},
            {"import", Order{"source", "depth", "float", "sqnr"}.of<ImportParameters>()}};
}

}  // namespace

void add_keywords(py::module_& module) {
    using py::arg;
    module.def("command_parameters", [] {
        py::dict all;
        for (const auto& [command, names] : command_parameters()) all[command.c_str()] = names;
        return all;
    });
    module.def("parse_light", parse_light, arg("text"));
    module.def("light_text", light_text, arg("light"));
    module.def("scene_keywords", [] { return described(Keywords<SceneParameters>().table); });
    module.def(
        "scene_pose",
        [](const py::dict& keywords) { return Keywords<SceneParameters>(keywords).values.complete_pose(); },
        arg("keywords"));
    module.def(
        "scene_import_options",
        [](const py::dict& keywords) { return Keywords<SceneParameters>(keywords).values.import_options(); },
        arg("keywords"));
    module.def("light_field_keywords", [] {
        const LightFieldKeywords none{py::dict()};
        return described(none.table, [](const Parameter& each) { return each.group != "Scene" && each.name != "fit"; });
    });
    module.def(
        "light_field_request", [](const py::dict& keywords) { return LightFieldKeywords(keywords).values.request(); },
        arg("keywords"));
    module.def(
        "export_cameras",
        [](const std::filesystem::path& target, const py::dict& of_views, const py::dict& of_scene) {
            Keywords<ExportParameters> views(of_views);
            LightFieldKeywords scene(of_scene);
            views.values.resolve(target);
            py::dict options;
            if (!views.values.is_quilt()) return py::make_tuple(options, views.values.device);
            views.values.set_cameras(scene.values, target, scene.table);
            for (const Parameter& each : scene.table.all())
                for (const char* name : {"hogels", "directions", "fov", "focal-plane"})
                    if (each.name == name) options[each.keyword().c_str()] = each.value();
            return py::make_tuple(options, views.values.device);
        },
        arg("target"), arg("of_views"), arg("of_scene"));
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
        [](const py::dict& keywords, const LightField* light_field) {
            const HologramKeywords asked(keywords);
            return light_field == nullptr ? asked.values.request(asked.seed, asked.looks)
                                          : asked.values.request(light_field->grids(), asked.seed, asked.looks);
        },
        arg("keywords"), arg("light_field") = nullptr);
    module.def(
        "note_about_pitch",
        [](const py::dict& keywords, const HologramRequest& request, const LightFieldGrid& front) {
            return Keywords<HologramParameters>(keywords).values.note_about_pitch(request, front);
        },
        arg("keywords"), arg("request"), arg("front"));
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
