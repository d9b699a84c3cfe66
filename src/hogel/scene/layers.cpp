// SPDX-License-Identifier: Apache-2.0
// Files of layers: pictures at depths, as JSON.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>

#include "hogel/core/json.h"
#include "hogel/core/lower_case.h"
#include "hogel/error.h"
#include "hogel/image/texture_picture.h"
#include "hogel/printable.h"
#include "hogel/scene/find_in_folder.h"
#include "hogel/scene/pictures.h"
#include "hogel/units.h"

namespace hogel::scene {
namespace {

using Json = nlohmann::json;

constexpr std::size_t max_bytes = std::size_t{1} << 20;
constexpr std::size_t max_layers = 256;
constexpr std::size_t max_pixels = std::size_t{1} << 28;  // of all layers

struct Layer {
    std::filesystem::path picture;
    double depth = 0;  ///< metres
};

/// Reads the text of a file of layers. `file_` is its name for messages.
class LayersReader {
  public:
    explicit LayersReader(const std::filesystem::path& path) : file_(path.string()) {
        std::error_code status;
        if (!std::filesystem::is_regular_file(path, status)) reject("no such file");
        if (std::filesystem::file_size(path, status) > max_bytes || status) reject("more than 1 MiB of text");
        folder_ = std::filesystem::canonical(path).parent_path();
        std::ifstream stream(path, std::ios::binary);
        text_.assign(std::istreambuf_iterator<char>(stream), {});
    }

    std::vector<Layer> read() const {
        const Json json = core::parse_json(text_, [&](const std::string& fault) { reject(fault); });
        if (!json.is_object() || json.size() != 1 || !json.contains("layers") || !json["layers"].is_array())
            reject("expected an object with one array, 'layers'");
        const Json& list = json["layers"];
        if (list.empty() || list.size() > max_layers)
            reject(fmt::format("{} layers; expected 1 to {}", list.size(), max_layers));
        std::vector<Layer> layers;
        for (const Json& each : list) layers.push_back(layer(each, layers.size() + 1));
        for (std::size_t i = 0; i < layers.size(); ++i)
            for (std::size_t k = 0; k < i; ++k)
                if (layers[i].depth == layers[k].depth)
                    reject(fmt::format("layers {} and {} have the same depth", k + 1, i + 1));
        return layers;
    }

    [[noreturn]] void reject(const std::string& what) const {
        throw Error(ErrorCode::bad_input, fmt::format("{}: {}", file_, printable(what)));
    }

  private:
    Layer layer(const Json& json, std::size_t number) const {
        const std::string name = fmt::format("layer {}", number);
        if (!json.is_object()) reject(name + " is no object; expected the members picture and depth");
        for (const auto& [key, value] : json.items())
            if (key != "picture" && key != "depth")
                reject(fmt::format("{} has the unknown member '{}'; expected picture and depth", name, key));
        if (!json.contains("picture") || !json["picture"].is_string())
            reject(name + " has no picture; expected the name of a file");
        if (!json.contains("depth")) reject(name + " has no depth; expected a length such as \"-5mm\"");
        const auto picture = json["picture"].get<std::string>();
        const std::optional<std::filesystem::path> path = find_in_folder(folder_, picture);
        if (!path)
            reject(
                fmt::format("{}: picture '{}' not found; expected a file in the folder of the layers", name, picture));
        return {*path, depth(json["depth"], name)};
    }

    /// Returns a depth in metres, from a number of metres or a text with a unit.
    double depth(const Json& json, const std::string& name) const {
        constexpr double max_depth = 1e6;
        double metres = max_depth;
        if (json.is_number()) {
            metres = json.get<double>();
        } else if (json.is_string()) {
            try {
                metres = parse_length(json.get<std::string>(), name + ": depth");
            } catch (const Error& error) {
                reject(error.what());
            }
        }
        if (!(std::abs(metres) < max_depth))
            reject(name + ": expected a depth as a number of metres or a length such as \"-5mm\"");
        return metres;
    }

    std::string file_, text_;
    std::filesystem::path folder_;  // canonical
};

}  // namespace

bool is_layers(const std::filesystem::path& path) { return core::lower_case_extension(path) == ".layers"; }

Scene import_layers(const std::filesystem::path& path) {
    const LayersReader reader(path);
    Scene scene;
    std::size_t pixels = 0;
    for (const Layer& layer : reader.read()) {
        Image picture = image::read_texture(layer.picture, image::TexturePixels::color_and_alpha);
        pixels += picture.width() * picture.height();
        if (pixels > max_pixels) reader.reject("the pictures have more than 2^28 pixels");
        Scene flat = scene_of_picture(std::move(picture));
        Mesh& mesh = flat.meshes.front();
        for (Vec3& position : mesh.positions) position.z = -layer.depth;
        mesh.name = layer.picture.filename().string();
        scene.meshes.push_back(std::move(mesh));
    }
    scene.name = path.stem().string();
    scene.units = SceneUnits::depths;
    return scene;
}

}  // namespace hogel::scene
