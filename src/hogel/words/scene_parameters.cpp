// SPDX-License-Identifier: Apache-2.0
#include "hogel/requests.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "hogel/error.h"
#include "hogel/image.h"

namespace hogel {
namespace {

// Default irradiance of a light of the command line: that of the first default light (add_default_lights()).
constexpr double usual_strength = 2.2;

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts;
    for (std::size_t begin = 0;;) {
        const std::size_t end = text.find(separator, begin);
        parts.push_back(text.substr(begin, end - begin));
        if (end == std::string::npos) return parts;
        begin = end + 1;
    }
}

[[noreturn]] void refuse(const std::string& parameter, const std::string& text, const std::string& expected) {
    throw Error(ErrorCode::usage, parameter, fmt::format("'{}' is not {}", text, expected));
}

// @param text  the full text, for messages
Vec3 parse_vector(const std::string& numbers, const std::string& text, const std::string& parameter,
                  const std::string& expected) {
    const std::vector<std::string> parts = split(numbers, ',');
    std::array<double, 3> values{};
    if (parts.size() != 3) refuse(parameter, text, expected);
    for (std::size_t i = 0; i < 3; ++i) {
        const auto number = parse_number(parts[i]);
        if (!number) refuse(parameter, text, expected);
        values[i] = *number;
    }
    return {values[0], values[1], values[2]};
}

Rgb parse_color(const std::string& text, const std::string& parameter) {
    constexpr const char* expected =
        "a colour; write #rrggbb, linear R,G,B, or black, white, grey, red, green, blue or yellow";
    if (text.find(',') != std::string::npos) {
        const Vec3 parts = parse_vector(text, text, parameter, expected);
        if (!(std::min({parts.x, parts.y, parts.z}) >= 0)) refuse(parameter, text, expected);
        return {static_cast<float>(parts.x), static_cast<float>(parts.y), static_cast<float>(parts.z)};
    }
    constexpr std::array<std::pair<std::string_view, std::uint32_t>, 7> names{{{"black", 0x000000},
                                                                               {"white", 0xffffff},
                                                                               {"grey", 0x808080},
                                                                               {"red", 0xff0000},
                                                                               {"green", 0x00ff00},
                                                                               {"blue", 0x0000ff},
                                                                               {"yellow", 0xffff00}}};
    std::uint32_t code = 0;
    const auto named = std::ranges::find(names, text, &std::pair<std::string_view, std::uint32_t>::first);
    if (named != names.end()) {
        code = named->second;
    } else if (text.size() == 7 && text[0] == '#' &&
               text.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos) {
        code = static_cast<std::uint32_t>(std::stoul(text.substr(1), nullptr, 16));
    } else {
        refuse(parameter, text, expected);
    }
    const auto part = [&](unsigned shift) { return srgb_decode(static_cast<float>(code >> shift & 0xff) / 255); };
    return {part(16), part(8), part(0)};
}

}  // namespace

Light parse_light(const std::string& text) {
    constexpr const char* expected =
        "a light; write the direction that it comes from, X,Y,Z, then optionally :COLOUR and :STRENGTH";
    const std::vector<std::string> parts = split(text, ':');
    if (parts.size() > 3) refuse("light", text, expected);
    const Vec3 from = parse_vector(parts[0], text, "light", expected);
    const double size = length(from);
    if (!(size > 0 && std::isfinite(size))) refuse("light", text, "a direction");
    double strength = usual_strength;
    if (parts.size() == 3) {
        const auto number = parse_number(parts[2]);
        if (!number || !(*number >= 0)) refuse("light", text, expected);
        strength = *number;
    }
    Light light;
    light.direction = -1 / size * from;
    light.intensity = static_cast<float>(strength) * (parts.size() > 1 ? parse_color(parts[1], "light") : Rgb{1, 1, 1});
    return light;
}

std::string light_text(const Light& light) {
    if (light.kind != Light::Kind::directional || !light.casts_shadows || light.outer_cone < std::numbers::pi)
        return "";
    const Vec3 from = Vec3{} - light.direction;
    return fmt::format("{},{},{}:{},{},{}:1", from.x, from.y, from.z, light.intensity.r, light.intensity.g,
                       light.intensity.b);
}

namespace {

Vec3 parse_up(const std::string& text) {
    constexpr const char* expected = "an axis; write x, y, z, -x, -y or -z";
    if (text.find(',') != std::string::npos) return parse_vector(text, text, "up", expected);
    const bool opposite = text.starts_with('-');
    const std::string axis = opposite ? text.substr(1) : text;
    const double sign = opposite ? -1 : 1;
    if (axis == "x") return {sign, 0, 0};
    if (axis == "y") return {0, sign, 0};
    if (axis == "z") return {0, 0, sign};
    refuse("up", text, expected);
}

}  // namespace

ScenePose SceneParameters::complete_pose() const {
    ScenePose complete = pose;
    for (const std::string& light : lights) complete.lights.push_back(parse_light(light));
    if (!texture.empty()) complete.texture = std::make_shared<const Image>(read_image(texture));
    return complete;
}

ImportOptions SceneParameters::import_options() const {
    ImportOptions options;
    options.point_size = point_size;
    options.depth_map = depth_map;
    options.depths.values = depth_values == "nearness"    ? DepthValues::nearness
                            : depth_values == "distance"  ? DepthValues::distance
                            : depth_values == "disparity" ? DepthValues::disparity
                                                          : DepthValues::automatic;
    options.depths.near = near;
    options.depths.far = far;
    return options;
}

void SceneParameters::resolve(const Scene& loaded, bool is_from_file) {
    is_loaded = true;
    is_file = is_from_file && loaded.units != SceneUnits::depths;
    has_depth_map = !depth_map.empty() || near || loaded.units == SceneUnits::picture_widths;
    is_lit = std::ranges::any_of(loaded.meshes, [](const Mesh& mesh) { return mesh.radiance.empty(); });
    has_points = std::ranges::any_of(loaded.meshes, [](const Mesh& mesh) { return mesh.name == points_name; });
}

void SceneParameters::declare(Parameters& parameters) {
    parameters.group("Scene", [this] { return is_loaded; });
    parameters.parsed(
        "--up", "AXIS",
        "Direction of the scene that points upwards: y (default; for STL, 3MF and AMF files z), x, -x, -y, -z, or "
        "X,Y,Z along one of these axes",
        [this](const std::string& text) { pose.up = parse_up(text); });
    parameters
        .rotation("--rotate", pose.rotation,
                  "Rotate the scene about x (to the right), then y (up), then z (to the viewer)")
        .no_default();
    parameters
        .text("--scene-camera", pose.camera, "NAME",
              "Use the view of a camera in the scene's file, by its name or number (default: front)")
        .no_default();
    parameters.number("--scale", pose.scale, "F", "Scale factor, after the scene was fitted to the hologram")
        .positive()
        .no_default();
    parameters.point("--move", pose.shift, "Move the scene, after --scale: right, up and towards the viewer")
        .no_default();
    parameters.parsed("--colour", "COLOUR",
                      "Colour of all surfaces instead of their own: #rrggbb, linear R,G,B, or a name such as red",
                      [this](const std::string& text) { pose.color = parse_color(text, "colour"); });
    parameters.text("--texture", texture, "FILE", "Picture on all surfaces that have texture coordinates").no_default();
    parameters
        .texts("--light", lights, "X,Y,Z[:COLOUR[:F]]",
               fmt::format("Light that replaces the scene's own: the direction that it comes from, its colour "
                           "(default: white) and its strength (default: {}); may be given several times",
                           usual_strength))
        .acts_if([this] { return is_lit; });
    parameters
        .parsed("--background", "COLOUR", "Colour of rays that hit nothing (default: the scene's; for a file black)",
                [this](const std::string& text) { pose.background = parse_color(text, "background"); })
        .acts_if([this] { return has_background; });
    parameters.parsed("--ground", "COLOUR", "Add a level ground of this colour under the scene (default: none)",
                      [this](const std::string& text) { pose.ground = parse_color(text, "ground"); });
    parameters
        .number("--point-size", point_size, "F",
                "Relative size of a point cloud's discs; 1 (default) just closes its surface")
        .positive()
        .no_default()
        .acts_if([this] { return has_points; });
    parameters
        .text("--depth-map", depth_map, "FILE",
              "Depth map of a picture: grey values, one for each pixel or block (default: the channel Z or depth of an "
              "EXR picture)")
        .no_default();
    const auto has_map = [this] { return has_depth_map; };
    parameters
        .choice("--depth-values", depth_values, {"auto", "nearness", "distance", "disparity"}, "KIND",
                "Meaning of the depth map's values:\n"
                "auto: distance for a depth channel of the picture's own file, otherwise nearness\n"
                "nearness: the largest are the nearest, depth is linear in the value\n"
                "distance: the largest are the farthest, depth is linear in the value\n"
                "disparity: the largest are the nearest, the reciprocal distance from the eye at 300 mm is linear")
        .acts_if(has_map);
    parameters
        .length(
            "--near", near,
            "Depth of the depth map's nearest value: negative in front of the hologram, positive behind it (default: "
            "the map's range is a quarter of the picture's width, moved by --front)")
        .acts_if(has_map);
    parameters.length("--far", far, "Depth of the depth map's farthest value; given together with --near")
        .acts_if(has_map);
}

}  // namespace hogel
