// SPDX-License-Identifier: Apache-2.0
// The 4D Light Field Benchmark (Honauer et al. 2016) and the files of its Blender add-on
// (lightfield-analysis/blender-addon, import_export.py): input_Cam000.png, ... row by row from the top left, and
// parameters.cfg. The cameras are shifted, not rotated: the zero-parallax plane is at focus_distance_m.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <sstream>

#include "hogel/core/lower_case.h"
#include "hogel/core/output_file.h"
#include "hogel/error.h"
#include "hogel/exchange/file_names.h"
#include "hogel/exchange/view_set.h"

namespace hogel::exchange {
namespace fs = std::filesystem;
namespace {

constexpr const char* beginning = "input_cam#";  // in any case
constexpr std::uintmax_t max_bytes = 1 << 20;    // of parameters.cfg

const NumberedFiles* pictures_in(const std::vector<NumberedFiles>& groups) {
    for (const NumberedFiles& group : groups)
        if (core::lower_case(group.shape).starts_with(beginning)) return &group;
    return nullptr;
}

bool probe(const fs::path& source) { return pictures_in(numbered_pictures(source)) != nullptr; }

std::string trimmed(const std::string& text) {
    const std::size_t first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
    return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

// Reads the numbers of parameters.cfg by name. Sections are ignored: names are unique across sections.
std::map<std::string, double> read_parameters(const fs::path& file) {
    std::map<std::string, double> parameters;
    std::istringstream stream(read_text(file, max_bytes));
    for (std::string line; std::getline(stream, line);) {
        // As Python's configparser: a name, = or :, a value, an optional comment.
        const std::size_t equals = line.find_first_of("=:");
        if (equals == std::string::npos) continue;
        std::string text = line.substr(equals + 1);
        text = trimmed(text.substr(0, text.find_first_of("#;")));
        double value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error == std::errc() && end == text.data() + text.size())
            parameters[core::lower_case(trimmed(line.substr(0, equals)))] = value;
    }
    return parameters;
}

constexpr const char* needed[] = {"baseline_mm",     "focus_distance_m",      "sensor_size_mm",
                                  "focal_length_mm", "image_resolution_x_px", "image_resolution_y_px"};

// Returns the first missing name, or an empty string. Throws for a number that is not positive.
std::string missing_of(const fs::path& file, const std::map<std::string, double>& parameters) {
    std::string missing;
    for (const char* name : needed) {
        const auto found = parameters.find(name);
        if (found == parameters.end())
            missing = missing.empty() ? name : missing;
        else if (!(found->second > 0))
            fail_source(file, fmt::format("has no {} that is positive", name));
    }
    return missing;
}

void require_size(const fs::path& file, const std::map<std::string, double>& parameters, const ViewSet& set) {
    const auto x = parameters.find("image_resolution_x_px"), y = parameters.find("image_resolution_y_px");
    if (x == parameters.end() || y == parameters.end()) return;
    if (x->second != static_cast<double>(set.width) || y->second != static_cast<double>(set.height))
        fail_source(file, fmt::format("says pictures of {}x{} pixels, but they have {}x{}: correct "
                                      "image_resolution_x_px and image_resolution_y_px",
                                      x->second, y->second, set.width, set.height));
}

ViewGeometry geometry_of(const std::map<std::string, double>& parameters) {
    const auto length = [&](const char* name) { return parameters.at(name); };
    ViewGeometry geometry;
    geometry.spacing = length("baseline_mm") * 1e-3;
    geometry.distance = length("focus_distance_m");
    geometry.pixel_tangent = length("sensor_size_mm") / length("focal_length_mm") /
                             std::max(length("image_resolution_x_px"), length("image_resolution_y_px"));
    return geometry;
}

ViewSet open(const fs::path& source, const ViewImportOptions& options) {
    const std::vector<NumberedFiles> groups = numbered_pictures(source);
    const NumberedFiles* group = pictures_in(groups);
    if (group == nullptr) fail_source(source, "has no pictures input_Cam000.png and so on");
    counted(*group, 0, group->files.size(), 1);  // throws if a file is missing, naming it
    std::size_t columns = options.columns, rows = options.rows;
    ViewSet set;
    if (const fs::path file = source / "parameters.cfg"; fs::exists(file)) {
        const std::map<std::string, double> parameters = read_parameters(file);
        take_size(*FilePictures({group->files.front().path}, 1).look(0, 0), set);
        require_size(file, parameters, set);
        if (const std::string missing = missing_of(file, parameters); missing.empty())
            set.geometry = geometry_of(parameters);
        else
            set.notes.push_back(fmt::format("parameters.cfg has no {}, so it says nothing of the geometry", missing));
        const auto x = parameters.find("num_cams_x"), y = parameters.find("num_cams_y");
        if (columns == 0 && x != parameters.end() && y != parameters.end()) {
            const auto count = static_cast<double>(group->files.size());
            if (!(x->second >= 1 && y->second >= 1) || x->second * y->second != count)
                fail_source(
                    file, fmt::format("says {}x{} cameras, but there are {} pictures such as {}", x->second, y->second,
                                      group->files.size(), group->files.front().path.filename().string()));
            columns = static_cast<std::size_t>(x->second);
            rows = static_cast<std::size_t>(y->second);
        }
    }
    PictureGrid grid = counted(*group, 0, columns, rows);
    set.columns = grid.columns;
    set.rows = grid.rows;
    set.pictures = std::make_shared<FilePictures>(std::move(grid.files), set.columns);
    return set;
}

class Writer final : public ViewWriter {
  public:
    explicit Writer(const ViewTarget& target)
        : target_(target), files_(file_writer(target, [columns = target.columns](std::size_t row, std::size_t column) {
              return fmt::format("input_Cam{:03}", row * columns + column);
          })) {}

    fs::path write(std::size_t row, std::size_t column, const StoredView& view) override {
        return files_->write(row, column, view);
    }

    std::vector<fs::path> finish() override {
        const ViewGeometry& g = target_.geometry;
        constexpr double sensor_mm = 35;
        const auto widest = static_cast<double>(std::max(target_.width, target_.height));
        // offset: the disparity in pixels that the camera shift removed.
        const std::string text = fmt::format(
            "[intrinsics]\nfocal_length_mm = {}\nimage_resolution_x_px = {}\nimage_resolution_y_px = {}\n"
            "sensor_size_mm = {}\n\n[extrinsics]\nnum_cams_x = {}\nnum_cams_y = {}\nbaseline_mm = {}\n"
            "focus_distance_m = {}\noffset = {}\n",
            sensor_mm / (widest * g.pixel_tangent), target_.width, target_.height, sensor_mm, target_.columns,
            target_.rows, g.spacing * 1e3, g.distance, g.spacing / (g.distance * g.pixel_tangent));
        const fs::path file = target_.path / "parameters.cfg";
        core::write_file(file, {reinterpret_cast<const unsigned char*>(text.data()), text.size()});
        return {file};
    }

  private:
    ViewTarget target_;
    std::unique_ptr<ViewWriter> files_;
};

}  // namespace

ViewLayout hci_layout() {
    return {
        .name = "hci",
        .text = "input_Cam000.png, ... row by row from the top left, with parameters.cfg (4D Light Field Benchmark)",
        .probe = probe,
        .open = open,
        .create = [](const ViewTarget& target) -> std::unique_ptr<ViewWriter> {
            return std::make_unique<Writer>(target);
        }};
}

}  // namespace hogel::exchange
