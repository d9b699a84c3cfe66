// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "hogel/error.h"
#include "hogel/requests.h"

namespace hogel {
namespace {

constexpr const char* light_field_group = "Light field of a scene";

}  // namespace

LightFieldGrid LightFieldParameters::grid() const {
    LightFieldGrid grid;
    grid.hogels_s = hogels.columns;
    grid.hogels_t = hogels.rows;
    grid.pitch = size / static_cast<double>(hogels.columns);
    grid.directions_u = directions.columns;
    grid.directions_v = directions.rows;
    // The faces of a hemicube define their ranges, except the height of a single row of directions.
    const Angles view = hemicube ? Angles{defaults.field_of_view, defaults.field_of_view} : field_of_view;
    grid.view = hogel::field_of_view(view.across, view.down, toward.across, toward.down);
    if (focal_plane_given) grid.view = FocalPlane{grid.range(), focal_plane};
    if (frequencies > 0) {
        // All frequencies j/d within the field of view.
        const double step = frequencies / grid.pitch;
        const auto max_index = [&](double angle) { return std::floor(std::sin(angle / 2) / step + 1e-9); };
        const double across = 2 * max_index(field_of_view.across) + 1, down = 2 * max_index(field_of_view.down) + 1;
        grid.directions_u = static_cast<std::size_t>(across);
        grid.directions_v = static_cast<std::size_t>(down);
        grid.view = Frequencies{{0.5 * across * step, 0.5 * down * step}};
    }
    with_renamed_parameters({{"directions", frequencies > 0 ? "frequencies" : "directions"}},
                            [&] { validate(grid, ErrorCode::usage, "light field"); });
    return grid;
}

LightFieldRequest LightFieldParameters::request(const Scene& loaded) const {
    LightFieldRequest wanted = request();
    wanted.shading.model = shading_model(loaded, wanted.shading);
    return wanted;
}

LightFieldRequest LightFieldParameters::request() const {
    renderers().find(algorithm);
    shading_models().find(shading);
    LightFieldRequest request;
    request.renderer = algorithm;
    request.shading.model = shading;
    request.shading.shadow_map = shadow_map;
    request.cache_spacing = cache_spacing;
    request.grid = grid();
    request.hemicube = hemicube;
    if (hemicube && field_of_view_given) {
        request.hemicube_across = field_of_view.across;
        request.hemicube_down = field_of_view.down;
    }
    request.samples = {samples.columns, samples.rows};
    request.cull_back_faces = fronts_only;
    if (interpolate_given) request.interpolate = interpolate;
    request.fit = !as_is;
    request.front = front;
    request.grids();
    with_renamed_parameters({{"directions", "directions, samples"}}, [&] { finer(request.grid, request.samples); });
    return request;
}

void LightFieldParameters::resolve(const Scene& placed) {
    const ShadingOptions asked = request().shading;
    shading = shading_model(placed, asked);
    has_shadow_maps = shadow_map_bytes(placed, asked) > 0;
}

void LightFieldParameters::resolve(const ShadedScene& lit) {
    is_rendered = true;
    if (hemicube && !field_of_view_given) field_of_view = {std::numbers::pi, std::numbers::pi};
    is_lit_by_samples = false;
    for (std::size_t i = 0; i < lit.triangles.size() && !is_lit_by_samples; ++i) is_lit_by_samples = lit.is_lit(i);
}

LightFieldRequest LightFieldParameters::scene_request() const {
    LightFieldRequest wanted = request();
    wanted.pose = scene.complete_pose();
    wanted.import = scene.import_options();
    if (!wanted.pose.camera.empty() && (wanted.pose.up || wanted.pose.rotation != Vec3{} || as_is))
        throw Error(ErrorCode::usage, "scene_camera",
                    "turns and fits the scene itself; leave out up, rotate and as-is");
    return wanted;
}

void LightFieldParameters::declare(Parameters& parameters) {
    const auto when_rendered = [this] { return is_rendered; };
    parameters.group(light_field_group, [this] { return scene.is_loaded; });
    std::string algorithms;
    for (const RendererInfo& renderer : renderers().rows())
        algorithms += fmt::format("\n{}: {}", renderer.name, renderer.text);
    parameters.text("--algorithm", algorithm, "NAME", "Renderer:" + algorithms)
        .acts_if(when_rendered)
        .knows(renderers().names());
    std::string shadings;
    for (const ShadingInfo& model : shading_models().rows())
        shadings += fmt::format("\n{}: {}", model.name, model.text);
    parameters.text("--shading", shading, "NAME", "Shading model, and where light is computed:" + shadings)
        .knows(shading_models().names())
        .acts_if([this] { return scene.is_lit; });
    parameters.count("--shadow-map", shadow_map, "Texels along a side of a lamp's shadow map").acts_if([this] {
        return has_shadow_maps;
    });
    parameters
        .number("--cache-spacing", cache_spacing, "F",
                "Spacing of the surface points at which light is computed (direct, shadowed), in widths of a ray "
                "there; 0: computed for each ray")
        .range(0, 16)
        .acts_if([this] { return is_lit_by_samples; });
    parameters
        .flag("--cull-back-faces", fronts_only,
              "Show only the front of triangles, where their corners are in counterclockwise order")
        .acts_if(when_rendered);
    parameters.counts("--hogels", hogels, "Hogels across and down").sets(hogels_given);
    parameters.counts("--directions", directions, "Directions across and down in each hogel")
        .sets(directions_given)
        .acts_if([this] { return is_rendered && frequencies == 0; });
    parameters
        .counts("--samples", samples,
                "Samples averaged for each ray: along a hogel's side and along a direction's; 2 is 2x2, 16 in all")
        .acts_if(when_rendered);
    parameters.positive_length("--size", size, "Width of the hologram").sets(size_given);
    parameters.angles("--fov", field_of_view, "Field of view, full angle; or across and down")
        .sets(field_of_view_given)
        .acts_if(when_rendered);
    parameters
        .angles("--toward", toward,
                "Direction of the middle of the view, behind the hologram: angles to the right and up")
        .acts_if([this] { return is_rendered && !hemicube && frequencies == 0; });
    parameters
        .number("--front", front, "F",
                "Fraction of the depth of a file's scene in front of the hologram: 0 none, 1 all; with -0.1 it "
                "begins a tenth of its depth behind it")
        .range(-100, 1)
        .acts_if([this] { return scene.is_file && !as_is; });
    const Parameter& unfitted =
        parameters
            .flag("--as-is", as_is,
                  "Do not move or scale a mesh file: its coordinates are metres, z towards the viewer")
            .acts_if([this] { return scene.is_file; });
    parameters.flag("--fit", "Scale and move a mesh file to fill the hologram (default)")
        .excludes(unfitted)
        .never_acts();
    scene.declare(parameters);
}

void LightFieldParameters::declare_hemicube(Parameters& parameters) {
    parameters.group(light_field_group);
    parameters
        .flag("--hemicube", hemicube,
              "All directions behind the hologram, in five faces: a front of 90 degrees and four half faces at the "
              "sides; --fov of more than 90 degrees shortens the sides")
        .excludes("--toward")
        .acts_if([this] { return is_rendered && frequencies == 0 && !focal_plane_given; });
}

Parameter& LightFieldParameters::declare_focal_plane(Parameters& parameters) {
    parameters.group(light_field_group);
    return parameters
        .length(
            "--focal-plane", focal_plane,
            "Depth of a fixed focal plane: the rays of all hogels pass through the same points of it. Positive behind "
            "the hologram, negative in front, as a plane of cameras. --fov and --toward are then those of the middle "
            "of the hologram (default: none, all hogels have the same directions)")
        .no_default()
        .sets(focal_plane_given);
}

void LightFieldParameters::declare_directions(Parameters& parameters) {
    declare_focal_plane(parameters).excludes("--hemicube");
    parameters
        .positive_length(
            "--frequencies", frequencies,
            "All directions within the field of view on the frequency grid of a hologram of this wavelength; with "
            "--algorithm raytrace, zbuffer or oblique")
        .no_default()
        .excludes("--hemicube")
        .excludes("--focal-plane")
        .excludes("--directions")
        .excludes("--toward");
    parameters
        .count("--interpolate", interpolate,
               "With --algorithm simplex: shade the corners of triangles as seen from the corners of blocks of N x N "
               "hogels, and interpolate (default: shade every sample)")
        .no_default()
        .sets(interpolate_given)
        .excludes("--hemicube")
        .excludes("--frequencies")
        .excludes("--focal-plane");
}

}  // namespace hogel
