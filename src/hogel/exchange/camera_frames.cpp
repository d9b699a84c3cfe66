// SPDX-License-Identifier: Apache-2.0
// transforms.json as written by nerfstudio, instant-ngp and the scripts of NeRF.
#include "hogel/exchange/camera_frames.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "hogel/core/json.h"
#include "hogel/core/stop_scope.h"
#include "hogel/error.h"
#include "hogel/image/picture_bytes.h"

namespace hogel::exchange {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::json;

constexpr std::uintmax_t max_bytes = 64 << 20;
constexpr std::size_t max_frames = 1 << 20;

Json parse(const fs::path& file) {
    Json json =
        core::parse_json(read_text(file, max_bytes), [&](const std::string& fault) { fail_source(file, fault); });
    if (!json.is_object() || !json.contains("frames") || !json["frames"].is_array())
        fail_source(file, "has no list of frames");
    return json;
}

// Numbers of a frame, with the file's global values as fallback.
class Numbers {
  public:
    Numbers(const fs::path& file, const Json& all, const Json& frame, std::string where)
        : file_(file), all_(all), frame_(frame), where_(std::move(where)) {}

    /// Returns NaN if neither has the number.
    double get(const char* name) const {
        for (const Json* from : {&frame_, &all_}) {
            const auto found = from->find(name);
            if (found == from->end()) continue;
            if (!found->is_number() || !std::isfinite(found->get<double>()))
                fail_source(file_, fmt::format("{}: {} is no number", where_, name));
            return found->get<double>();
        }
        return NAN;
    }
    double positive(const char* name) const {
        const double value = get(name);
        if (value <= 0) fail_source(file_, fmt::format("{}: {} is {}, but must be positive", where_, name, value));
        return value;
    }
    /// Returns the focal length in pixels, from its own entry or from the full angle of view; NaN if neither exists.
    double focal(const char* name, const char* angle_name, double pixels) const {
        if (const double focal = positive(name); !std::isnan(focal)) return focal;
        const double angle = positive(angle_name);
        if (angle >= std::numbers::pi) fail_source(file_, fmt::format("{}: {} is too large", where_, angle_name));
        return 0.5 * pixels / std::tan(0.5 * angle);
    }
    void require_pinhole() const {
        for (const char* name : {"k1", "k2", "k3", "k4", "p1", "p2"})
            if (const double value = get(name); value != 0 && !std::isnan(value))
                fail_source(file_, fmt::format("{}: {} is {}: its picture is distorted; undistort the pictures first",
                                               where_, name, value));
        const Json& from = frame_.contains("camera_model") ? frame_ : all_;
        const std::string model = from.contains("camera_model") && from["camera_model"].is_string()
                                      ? from["camera_model"].get<std::string>()
                                      : "OPENCV";
        if (model.find("FISHEYE") != std::string::npos || model.find("EQUIRECTANGULAR") != std::string::npos ||
            (all_.contains("is_fisheye") && all_["is_fisheye"] == true))
            fail_source(file_, fmt::format("{}: the camera model {} is no pinhole", where_, model));
    }

  private:
    const fs::path& file_;
    const Json &all_, &frame_;
    std::string where_;
};

// Reads the columns of a camera-to-world matrix of 3 or 4 rows.
void take_matrix(const fs::path& file, const Json& frame, const std::string& where, CameraFrame& camera) {
    const auto found = frame.find("transform_matrix");
    const auto fail = [&] { fail_source(file, fmt::format("{}: has no transform_matrix of 4x4 numbers", where)); };
    if (found == frame.end() || !found->is_array() || found->size() < 3 || found->size() > 4) fail();
    double m[3][4];
    for (std::size_t row = 0; row < 3; ++row) {
        const Json& line = (*found)[row];
        if (!line.is_array() || line.size() != 4) fail();
        for (std::size_t column = 0; column < 4; ++column) {
            if (!line[column].is_number()) fail();
            m[row][column] = line[column].get<double>();
            if (!std::isfinite(m[row][column]) || std::abs(m[row][column]) > 1e100) fail();
        }
    }
    for (std::size_t axis = 0; axis < 3; ++axis) camera.axes[axis] = {m[0][axis], m[1][axis], m[2][axis]};
    camera.position = {m[0][3], m[1][3], m[2][3]};
    constexpr double rounding = 1e-3;
    for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = a; b < 3; ++b)
            if (!(std::abs(dot(camera.axes[a], camera.axes[b]) - (a == b ? 1 : 0)) < rounding))
                fail_source(file, fmt::format("{}: its transform_matrix is not a rotation with a translation", where));
    if (dot(cross(camera.axes[0], camera.axes[1]), camera.axes[2]) < 0)
        fail_source(file, fmt::format("{}: its transform_matrix mirrors the scene", where));
}

// Returns the picture of a frame. The first NeRF data sets omit the extension.
fs::path picture_of(const fs::path& file, const Json& frame, const std::string& where) {
    const auto found = frame.find("file_path");
    if (found == frame.end() || !found->is_string() || found->get<std::string>().empty())
        fail_source(file, fmt::format("{}: has no file_path", where));
    const fs::path folder = file.has_parent_path() ? file.parent_path() : ".";
    const fs::path named = (folder / fs::path(found->get<std::string>())).lexically_normal();
    std::error_code none;
    for (const char* extension : {"", ".png", ".exr", ".jpg"}) {
        fs::path whole = named.string() + extension;
        if (!fs::is_regular_file(whole, none)) continue;
        // Do not let a file read pictures outside its folder: SECURITY.md.
        const fs::path inside = fs::canonical(whole, none).lexically_relative(fs::canonical(folder, none));
        if (inside.empty() || *inside.begin() == "..")
            fail_source(file,
                        fmt::format("{}: its picture {} is not in this file's folder or below", where, whole.string()));
        return whole;
    }
    fail_source(named, fmt::format("is not there, though {} has a camera for it", file.filename().string()));
}

}  // namespace

std::vector<CameraFrame> read_camera_frames(const fs::path& file) {
    const Json json = parse(file);
    const Json& list = json["frames"];
    if (list.size() < 2 || list.size() > max_frames)
        fail_source(file, fmt::format("has {} frames, but a set has two or more", list.size()));
    std::vector<CameraFrame> cameras;
    std::map<fs::path, ViewSet> sizes;  // of pictures whose frames do not state it
    for (std::size_t i = 0; i < list.size(); ++i) {
        core::throw_if_stopped();
        const Json& frame = list[i];
        const std::string where = fmt::format("frames[{}]", i);
        if (!frame.is_object()) fail_source(file, fmt::format("{} is no object", where));
        const Numbers numbers(file, json, frame, where);
        numbers.require_pinhole();
        CameraFrame camera;
        camera.picture = picture_of(file, frame, where);
        take_matrix(file, frame, where, camera);
        double width = numbers.positive("w"), height = numbers.positive("h");
        if (std::isnan(width) || std::isnan(height)) {
            // The first NeRF data sets omit the size.
            const auto [known, is_new] = sizes.try_emplace(camera.picture);
            if (is_new) take_size(image::read_picture(camera.picture, max_pixels), known->second);
            width = static_cast<double>(known->second.width);
            height = static_cast<double>(known->second.height);
        }
        camera.width = width;
        camera.height = height;
        camera.focal_x = numbers.focal("fl_x", "camera_angle_x", width);
        camera.focal_y = numbers.focal("fl_y", "camera_angle_y", height);
        if (std::isnan(camera.focal_x)) camera.focal_x = camera.focal_y;
        if (std::isnan(camera.focal_y)) camera.focal_y = camera.focal_x;
        if (std::isnan(camera.focal_x))
            fail_source(file, fmt::format("{}: has neither fl_x nor camera_angle_x", where));
        camera.center_x = numbers.get("cx");
        camera.center_y = numbers.get("cy");
        if (std::isnan(camera.center_x)) camera.center_x = 0.5 * width;
        if (std::isnan(camera.center_y)) camera.center_y = 0.5 * height;
        cameras.push_back(std::move(camera));
    }
    return cameras;
}

}  // namespace hogel::exchange
