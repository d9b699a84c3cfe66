// SPDX-License-Identifier: Apache-2.0
// transforms.json of radiance field tools (nerfstudio, instant-ngp): position, axes, focal length and centre of each
// camera. Cameras of a light field are parallel, with shifted centres (cx, cy) if the zero-parallax plane is finite.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hogel/core/output_file.h"
#include "hogel/error.h"
#include "hogel/exchange/camera_frames.h"
#include "hogel/image/picture_bytes.h"

namespace hogel {
namespace exchange {
namespace fs = std::filesystem;
namespace {

constexpr const char* file_name = "transforms.json";

// Returns the file itself, or transforms.json in a folder.
fs::path file_of(const fs::path& source) {
    std::error_code none;
    return fs::is_directory(source, none) ? source / file_name : source;
}

bool probe(const fs::path& source) {
    const fs::path file = file_of(source);
    std::error_code none;
    return file.extension() == ".json" && fs::is_regular_file(file, none);
}

ViewSet open(const fs::path& source, const ViewImportOptions&) {
    const fs::path file = file_of(source);
    std::error_code none;
    if (!fs::is_regular_file(file, none)) fail_source(file, "no such file");
    const std::vector<CameraFrame> frames = read_camera_frames(file);
    ViewSet set;
    take_size(image::read_picture(frames.front().picture, max_pixels), set);
    for (const CameraFrame& frame : frames)
        if (frame.width != static_cast<double>(set.width) || frame.height != static_cast<double>(set.height))
            fail_source(file,
                        fmt::format("says that {} has {}x{} pixels, but {} has {}x{}: correct w, h, fl_x, fl_y, cx "
                                    "and cy",
                                    frame.picture.filename().string(), frame.width, frame.height,
                                    frames.front().picture.filename().string(), set.width, set.height));
    CameraGrid grid = arrange(file, frames, set.width, set.height);
    set.columns = grid.columns;
    set.rows = grid.rows;
    set.geometry = grid.geometry;
    set.notes = std::move(grid.notes);
    std::vector<fs::path> files;
    for (const std::size_t frame : grid.frames) files.push_back(frames[frame].picture);
    set.pictures = std::make_shared<FilePictures>(std::move(files), set.columns);
    return set;
}

std::string picture_name(std::size_t row, std::size_t column) { return fmt::format("{:03}_{:03}", row, column); }

// Returns the text of the file. The origin of the frame is the centre of the hologram, its axes are the hologram's.
std::string cameras_text(const ViewTarget& target) {
    const ViewGeometry& g = target.geometry;
    const double focal = 1 / g.pixel_tangent;
    const double width = static_cast<double>(target.width), height = static_cast<double>(target.height);
    std::string text = fmt::format(
        "{{\n\"camera_model\": \"OPENCV\",\n\"w\": {}, \"h\": {},\n\"fl_x\": {}, \"fl_y\": {},\n\"camera_angle_x\": "
        "{}, "
        "\"camera_angle_y\": {},\n\"k1\": 0, \"k2\": 0, \"p1\": 0, \"p2\": 0,\n\"frames\": [",
        target.width, target.height, focal, focal, 2 * std::atan(0.5 * width / focal),
        2 * std::atan(0.5 * height / focal));
    for (std::size_t row = 0; row < target.rows; ++row)
        for (std::size_t column = 0; column < target.columns; ++column) {
            const auto from_middle = [](std::size_t i, std::size_t n) {
                return static_cast<double>(i) - 0.5 * static_cast<double>(n - 1);
            };
            const double x = from_middle(column, target.columns) * g.spacing - g.center_u * g.distance;
            const double y = -from_middle(row, target.rows) * g.spacing * g.spacing_ratio - g.center_v * g.distance;
            text += fmt::format(
                "{}\n{{\"file_path\": \"{}.{}\", \"cx\": {}, \"cy\": {},\n \"transform_matrix\": [[1, 0, 0, {}], "
                "[0, 1, 0, {}], [0, 0, 1, {}], [0, 0, 0, 1]]}}",
                row + column > 0 ? "," : "", picture_name(row, column), target.format,
                0.5 * width + focal * x / g.distance, 0.5 * height - focal * y / g.distance, x, y, g.distance);
        }
    return text + "\n]\n}\n";
}

// Returns the largest offsets of picture centres (cx, cy) from the middle: pixels across and down.
std::pair<double, double> off_centre(const ViewTarget& target) {
    const ViewGeometry& g = target.geometry;
    const double step = g.spacing / (g.distance * g.pixel_tangent);
    const auto most = [](std::size_t views, double step_pixels, double centre) {
        return 0.5 * static_cast<double>(views - 1) * step_pixels + std::abs(centre);
    };
    return {most(target.columns, step, g.center_u / g.pixel_tangent),
            most(target.rows, step * g.spacing_ratio, g.center_v / g.pixel_tangent)};
}

// Some programs assume the centre in the middle of each picture (graphdeco-inria/gaussian-splatting, issue 1010).
std::vector<std::string> off_centre_notes(const ViewTarget& target) {
    const auto [across, down] = off_centre(target);
    if (std::max(across, down) < 0.5) return {};
    return {
        fmt::format("pictures are off centre by up to {:.4g} pixels across and {:.4g} down (cx and cy of each frame); "
                    "programs that ignore these, such as the original Gaussian splatting, misplace the scene",
                    across, down)};
}

void write_text(const fs::path& file, const std::string& text) {
    core::write_file(file, {reinterpret_cast<const unsigned char*>(text.data()), text.size()});
}

class Writer final : public ViewWriter {
  public:
    explicit Writer(const ViewTarget& target) : target_(target), files_(file_writer(target, picture_name)) {}

    fs::path write(std::size_t row, std::size_t column, const StoredView& view) override {
        return files_->write(row, column, view);
    }
    std::vector<fs::path> finish() override {
        write_text(target_.path / file_name, cameras_text(target_));
        return {target_.path / file_name};
    }
    std::vector<std::string> notes() const override { return off_centre_notes(target_); }

  private:
    ViewTarget target_;
    std::unique_ptr<ViewWriter> files_;
};

}  // namespace

ViewLayout transforms_layout() {
    return {.name = "transforms",
            .text = "transforms.json and the pictures that it names, of parallel cameras (nerfstudio, instant-ngp)",
            .probe = probe,
            .open = open,
            .create = [](const ViewTarget& target) -> std::unique_ptr<ViewWriter> {
                return std::make_unique<Writer>(target);
            }};
}

}  // namespace exchange

std::vector<std::string> write_cameras(const LightFieldGrid& grid, const std::filesystem::path& file) {
    validate(grid, ErrorCode::usage, "cameras");
    exchange::ViewTarget target = exchange::target_of(grid, file);
    if (target.geometry.orthographic)
        throw Error(ErrorCode::usage, "cameras stand on a fixed focal plane in front of the hologram; there is none");
    target.format = "png";
    exchange::write_text(file, exchange::cameras_text(target));
    return exchange::off_centre_notes(target);
}

}  // namespace hogel
