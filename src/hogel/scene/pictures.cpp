// SPDX-License-Identifier: Apache-2.0
#include "hogel/scene/pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fstream>
#include <limits>
#include <string_view>

#include "hogel/core/lower_case.h"
#include "hogel/core/stop_scope.h"
#include "hogel/error.h"
#include "hogel/image/channels.h"
#include "hogel/image/picture_formats.h"
#include "hogel/image/texture_picture.h"

namespace hogel {

using namespace scene;

namespace {

constexpr std::size_t max_points = std::size_t{1} << 20;  // of a depth map: 2 million triangles
constexpr double depth_share = 0.25;                      // default depth range, in widths of the picture
constexpr float background_value = 1e9f;                  // Blender stores 1e10 where a ray hits nothing

/// Sets radiances that are no light to black. Alphas that are all 1 are removed.
Image checked_picture(Image picture) {
    const std::size_t channels = picture.channels(), pixels = picture.width() * picture.height();
    if (pixels == 0 || (channels != 1 && channels != 3 && channels != 4))
        throw Error(ErrorCode::bad_input,
                    fmt::format("a picture of {}x{} pixels with {} channels; expected pixels with 1, 3 or 4 channels",
                                picture.width(), picture.height(), channels));
    for (float& value : picture.pixels.elements())
        if (!(value >= 0 && value < std::numeric_limits<float>::infinity())) value = 0;
    if (channels != 4) return picture;
    bool is_opaque = true;
    for (std::size_t i = 0; i < pixels && is_opaque; ++i) is_opaque = picture.pixels.data()[4 * i + 3] >= 1;
    if (!is_opaque) return picture;
    Image opaque(picture.width(), picture.height(), 3);
    for (std::size_t i = 0; i < pixels; ++i)
        std::copy_n(&picture.pixels.data()[4 * i], 3, &opaque.pixels.data()[3 * i]);
    return opaque;
}

void show(Mesh& mesh, const std::shared_ptr<const Image>& picture) {
    mesh.material.base_color = {1, 1, 1};
    mesh.material.base_color_texture = picture;
    mesh.material.base_color_sampling = {TextureSampling::Wrap::clamp, TextureSampling::Wrap::clamp};
    if (picture->channels() == 4) mesh.material.alpha_mode = AlphaMode::blend;
}

double height_of(const Image& picture) {
    return static_cast<double>(picture.height()) / static_cast<double>(picture.width());
}

void validate(const DepthMapOptions& options) {
    if (options.near.has_value() != options.far.has_value())
        throw Error(ErrorCode::usage, "near, far", "one of them is given; expected both or none");
    if (!options.near && options.values == DepthValues::disparity)
        throw Error(ErrorCode::usage, "near, far", "disparities need the depths of the nearest and the farthest");
    if (options.near && !(std::isfinite(*options.near) && std::isfinite(*options.far) && *options.near < *options.far))
        throw Error(ErrorCode::usage, "near, far",
                    fmt::format("{} m and {} m; expected near to be in front of far", *options.near, *options.far));
    if (options.near && options.values == DepthValues::disparity && !(*options.near > -options.viewpoint))
        throw Error(ErrorCode::usage, "near",
                    fmt::format("{} m; expected a depth behind the viewpoint, {} m in front of the hologram",
                                *options.near, options.viewpoint));
}

/// Smallest and largest value of a map, without those of the background.
struct Range {
    float low = std::numeric_limits<float>::infinity(), high = -low;
};

bool is_background(float value) { return !(std::abs(value) < background_value); }

Range range_of(View<const float, 2> map) {
    Range range;
    for (const float value : map.elements())
        if (!is_background(value)) range = {std::min(range.low, value), std::max(range.high, value)};
    return range;
}

float nearness_of(float value, const Range& range, DepthValues values) {
    if (is_background(value)) return 0;
    if (!(range.high > range.low)) return 1;
    const float distance = values == DepthValues::distance ? value - range.low : range.high - value;
    return 1 - distance / (range.high - range.low);
}

/// Samples a map at no more than `max_points` of its points: averages would lie between surfaces.
Relief relief_of(View<const float, 2> map, DepthValues values) {
    const std::size_t width = map.extent(1), height = map.extent(0);
    const double points = static_cast<double>(width) * static_cast<double>(height),
                 coarser = std::max(1.0, std::sqrt(points / static_cast<double>(max_points)));
    const auto coarse = [&](std::size_t count) {
        return std::max<std::size_t>(1, static_cast<std::size_t>(static_cast<double>(count) / coarser));
    };
    Relief relief{coarse(width), coarse(height), {}, {}, {}};
    const Range range = range_of(map);
    relief.nearness.reserve(relief.width * relief.height);
    for (std::size_t y = 0; y < relief.height; ++y) {
        core::throw_if_stopped();
        const std::size_t row = (2 * y + 1) * height / (2 * relief.height);
        for (std::size_t x = 0; x < relief.width; ++x)
            relief.nearness.push_back(nearness_of(map(row, (2 * x + 1) * width / (2 * relief.width)), range, values));
    }
    return relief;
}

/// Replaces the nearness of vertices by z: in widths of the picture, or in metres for given depths.
void place_in_depth(Mesh& mesh, const DepthMapOptions& options) {
    for (Vec3& position : mesh.positions) {
        const double nearness = position.z;
        if (!options.near) {
            position.z = depth_share * nearness;
        } else if (options.values == DepthValues::disparity) {
            const double nearest = 1 / (options.viewpoint + *options.near),
                         farthest = 1 / (options.viewpoint + *options.far);
            position.z = options.viewpoint - 1 / (farthest + nearness * (nearest - farthest));
        } else {
            position.z = -(*options.far + nearness * (*options.near - *options.far));
        }
    }
}

void require_same_aspect_ratio(const Image& picture, View<const float, 2> map) {
    constexpr double tolerance = 0.05;
    const double ratio = height_of(picture) * static_cast<double>(map.extent(1)) / static_cast<double>(map.extent(0));
    if (map.size() > 0 && std::abs(std::log(ratio)) < tolerance) return;
    throw Error(ErrorCode::bad_input,
                fmt::format("a depth map of {}x{} values for a picture of {}x{} pixels; expected the same aspect ratio",
                            map.extent(1), map.extent(0), picture.width(), picture.height()));
}

/// Reads a map of one number per pixel. Colour channels may differ as much as lossy compression makes them.
Array<float, 2> read_depth_map(const std::filesystem::path& path) {
    constexpr float tolerance = 1.0f / 16;
    const RawChannels raw = read_raw_channels(path);
    const std::size_t channels = raw.values.extent(2);
    Array<float, 2> map({raw.values.extent(0), raw.values.extent(1)});
    float largest = 0, difference = 0;
    for (std::size_t i = 0; i < map.size(); ++i) {
        const float* const values = raw.values.data() + i * channels;
        for (std::size_t c = 0; c < channels; ++c) {
            map.data()[i] += values[c] / static_cast<float>(channels);
            difference = std::max(difference, std::abs(values[c] - values[0]));
        }
        if (!is_background(values[0])) largest = std::max(largest, std::abs(values[0]));
    }
    if (difference > tolerance * largest)
        throw Error(ErrorCode::bad_input, fmt::format("{}: is coloured; expected a grey depth map", path.string()));
    return map;
}

/// Reads the channel Z or depth of an EXR file. Z is no depth beside the channels X and Y of its layer.
std::optional<Array<float, 2>> read_depth_channel(const std::filesystem::path& path) {
    std::array<char, 4> start{};
    std::ifstream(path, std::ios::binary).read(start.data(), start.size());
    if (std::string_view(start.data(), start.size()) != "\x76\x2f\x31\x01") return std::nullopt;
    const auto find_depth = [&](const image::NamedChannels& file) {
        return std::ranges::find_if(file.channels, [&](const auto& channel) {
            const std::string name = core::lower_case(channel.first);
            const std::size_t first = name.rfind('.') + 1;  // 0 without a layer
            const std::string x = name.substr(0, first) + "x";
            if (name.substr(first) == "depth") return true;
            return name.substr(first) == "z" && std::ranges::none_of(file.channels, [&](const auto& other) {
                       return core::lower_case(other.first) == x;
                   });
        });
    };
    const image::NamedChannels names = image::read_named_channels(path, true);
    if (find_depth(names) == names.channels.end()) return std::nullopt;
    image::NamedChannels all = image::read_named_channels(path);
    return std::move(all.channels[static_cast<std::size_t>(find_depth(all) - all.channels.begin())].second);
}

}  // namespace

Scene scene_of_picture(Image picture) {
    const auto shown = std::make_shared<const Image>(checked_picture(std::move(picture)));
    Scene scene;
    scene.name = "picture";
    scene.units = SceneUnits::depths;
    Relief flat{1, 1, {0}, {}, {}};
    scene.meshes.push_back(relief_mesh(flat, height_of(*shown)));
    show(scene.meshes.front(), shown);
    return scene;
}

Scene scene_of_picture(Image picture, View<const float, 2> depth_map, const DepthMapOptions& options) {
    validate(options);
    const auto shown = std::make_shared<const Image>(checked_picture(std::move(picture)));
    require_same_aspect_ratio(*shown, depth_map);
    const Relief front = relief_of(depth_map, options.values);
    Scene scene;
    scene.name = "picture";
    scene.units = options.near ? SceneUnits::depths : SceneUnits::picture_widths;
    scene.meshes.push_back(relief_mesh(front, height_of(*shown)));
    show(scene.meshes.front(), shown);
    Mesh behind = relief_mesh(continuation_behind_edges(front, *shown), height_of(*shown));
    behind.name = "behind edges";
    if (!behind.triangles.empty()) scene.meshes.push_back(std::move(behind));
    for (Mesh& mesh : scene.meshes) place_in_depth(mesh, options);
    scene.notes.push_back(
        fmt::format("the {} values of its depth map are {}{}",
                    options.values == DepthValues::distance ? "smallest" : "largest", "the nearest",
                    front.nearness.size() < depth_map.size()
                        ? fmt::format("; the map is read at {}x{} of its points", front.width, front.height)
                        : ""));
    return scene;
}

bool scene::is_picture(const std::filesystem::path& path) { return image::format_by_extension(path) != nullptr; }

Scene scene::import_picture(const std::filesystem::path& path, const ImportOptions& options) {
    Image picture = image::read_texture(path, image::TexturePixels::color_and_alpha);
    DepthMapOptions depths = options.depths;
    std::optional<Array<float, 2>> map;
    if (!options.depth_map.empty()) {
        map = read_depth_map(options.depth_map);
    } else {
        map = read_depth_channel(path);
        if (map && depths.values == DepthValues::automatic) depths.values = DepthValues::distance;
    }
    Scene scene;
    if (map) {
        try {
            scene = scene_of_picture(std::move(picture), *map, depths);
        } catch (const Error& error) {
            if (error.code() != ErrorCode::bad_input) throw;
            const std::filesystem::path& file = options.depth_map.empty() ? path : options.depth_map;
            throw Error(error.code(), fmt::format("{}: {}", file.string(), error.what()));
        }
    } else if (depths.near || depths.far) {
        throw Error(ErrorCode::usage, "near, far", fmt::format("{} has no depth map", path.string()));
    } else {
        scene = scene_of_picture(std::move(picture));
    }
    scene.name = path.stem().string();
    return scene;
}

}  // namespace hogel
