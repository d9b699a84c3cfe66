// SPDX-License-Identifier: Apache-2.0
#include "hogel/exchange/disparity.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <tuple>
#include <type_traits>

#include "hogel/core/lower_case.h"
#include "hogel/core/raw_file.h"
#include "hogel/error.h"
#include "hogel/image/picture_bytes.h"
#include "hogel/io/arrays/npy.h"

namespace hogel::exchange {
namespace fs = std::filesystem;
namespace {

// Fills holes with the smaller (farther) disparity of the nearest known pixels on both sides along the motion.
void fill_holes(DisparityMap& map, bool along_y) {
    const std::size_t lines = map.extent(along_y ? 1 : 0), length = map.extent(along_y ? 0 : 1);
    for (std::size_t line = 0; line < lines; ++line) {
        const auto pixel = [&](std::size_t i) -> float& { return along_y ? map(i, line) : map(line, i); };
        for (std::size_t i = 0; i < length;) {
            if (!std::isnan(pixel(i))) {
                ++i;
                continue;
            }
            std::size_t end = i;
            while (end < length && std::isnan(pixel(end))) ++end;
            const float before = i > 0 ? pixel(i - 1) : NAN, after = end < length ? pixel(end) : NAN;
            const float fill = std::isnan(before) ? after : std::isnan(after) ? before : std::min(before, after);
            for (; i < end; ++i) pixel(i) = fill;
        }
    }
}

// Applies a 3x3 median, which closes the one-pixel cracks that moving leaves.
DisparityMap median(const DisparityMap& map) {
    DisparityMap out(map.shape());
    const std::size_t height = map.extent(0), width = map.extent(1);
    for (std::size_t y = 0; y < height; ++y)
        for (std::size_t x = 0; x < width; ++x) {
            std::array<float, 9> values;
            std::size_t n = 0;
            for (std::size_t j = y > 0 ? y - 1 : y; j <= std::min(y + 1, height - 1); ++j)
                for (std::size_t i = x > 0 ? x - 1 : x; i <= std::min(x + 1, width - 1); ++i) values[n++] = map(j, i);
            std::nth_element(values.begin(), values.begin() + static_cast<long>(n / 2),
                             values.begin() + static_cast<long>(n));
            out(y, x) = values[n / 2];
        }
    return out;
}

struct Candidate {
    fs::path path;
    bool depth = false;
    bool coded = false;  // stored as integers
};

// Returns the files that are maps by name: floating-point first, disparity before depth, then by name. Pictures of 8
// bits are previews, not maps, unless there is a scale.
std::vector<Candidate> candidates(const fs::path& folder) {
    std::vector<Candidate> found;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
        const std::string name = core::lower_case(entry.path().filename().string());
        const bool disparity = name.find("disp") != std::string::npos, depth = name.find("depth") != std::string::npos;
        const bool array = name.ends_with(".pfm") || name.ends_with(".exr") || name.ends_with(".npy");
        const bool codes =
            name.ends_with(".png") || name.ends_with(".pgm") || name.ends_with(".tif") || name.ends_with(".tiff");
        if (name.starts_with('.') || (!array && !codes) || (!disparity && !depth) || !entry.is_regular_file(error))
            continue;
        found.push_back({entry.path(), !disparity, codes});
    }
    std::ranges::sort(found, {}, [](const Candidate& c) { return std::tuple(c.coded, c.depth, c.path); });
    return found;
}

DisparityMap read_npy(const fs::path& path) {
    const core::RawFile file(path, core::RawFile::Mode::read, path);
    const io::arrays::NpyHeader header = io::arrays::read_npy_header(path, file);
    const bool wide = header.number == io::arrays::Number::real;
    if (header.shape.size() != 2 || header.by_columns || header.complex || header.big_endian ||
        (!wide && header.number != io::arrays::Number::single))
        fail_source(path, "a map is an array [y][x] of float32 or float64");
    DisparityMap map({header.shape[0], header.shape[1]});
    if (!wide) {
        file.read(header.begin, map.data(), map.size() * sizeof(float));
        return map;
    }
    std::vector<double> values(map.size());
    file.read(header.begin, values.data(), values.size() * sizeof(double));
    std::ranges::transform(values, map.data(), [](double value) { return static_cast<float>(value); });
    return map;
}

// Reads a map of integers. Returns nothing for a picture of 8 bits without a scale.
std::optional<DisparityMap> read_codes(const fs::path& path, double scale) {
    const image::Picture picture = image::read_picture(path, max_pixels);
    if (scale == 0 && !std::holds_alternative<Array<std::uint16_t, 3>>(picture.samples)) return {};
    if (scale == 0)
        throw Error(
            ErrorCode::usage, "depth_scale",
            fmt::format("{}: holds whole numbers; how many of them are a metre of depth or a pixel of disparity is "
                        "needed",
                        path.string()));
    return std::visit(
        [&](const auto& samples) {
            using T = std::remove_cvref_t<decltype(samples(0, 0, 0))>;
            if (samples.extent(2) != 1) fail_source(path, "a map has one channel, but this picture has colours");
            // Codes of less than 16 bits were scaled to 16 bits.
            const double full = std::is_same_v<T, std::uint8_t> ? 255 : 65535;
            const double code = std::is_same_v<T, float> ? 1 : max_code_of(picture) / full;
            DisparityMap map({samples.extent(0), samples.extent(1)});
            std::ranges::transform(samples.elements(), map.data(), [&](T value) {
                return value == 0 ? NAN : static_cast<float>(std::round(value * code) / scale);
            });
            if (std::ranges::all_of(map.elements(), [](float value) { return std::isnan(value); }))
                fail_source(path, "is a map without known pixels: all are 0");
            return map;
        },
        picture.samples);
}

DisparityMap read_map(const fs::path& path) {
    if (core::lower_case_extension(path) == ".npy") return read_npy(path);
    const image::Picture picture = image::read_picture(path, max_pixels);
    const auto* samples = std::get_if<Array<float, 3>>(&picture.samples);
    if (samples == nullptr) fail_source(path, "a map holds floating-point numbers");
    DisparityMap map({samples->extent(0), samples->extent(1)});
    for (std::size_t i = 0; i < map.size(); ++i) map.data()[i] = samples->data()[i * samples->extent(2)];
    return map;
}

// Converts depth Z to the disparity (1/Z - 1/D) b/a.
void to_disparity(const fs::path& path, const ViewGeometry& g, DisparityMap& map) {
    if (!(g.spacing > 0 && g.pixel_tangent > 0 && g.distance > 0))
        fail_source(path,
                    "depth cannot be converted to disparity: this set does not state the camera spacing and distance");
    for (float& value : map.elements()) {
        if (std::isnan(value)) continue;  // unknown
        if (!(value > 0)) fail_source(path, "holds a depth that is not positive");
        value = static_cast<float>((1 / static_cast<double>(value) - 1 / g.distance) * g.spacing / g.pixel_tangent);
    }
}

using KnownMaps = std::vector<std::pair<std::pair<std::size_t, std::size_t>, DisparityMap>>;

// If there are too many maps, keeps those of a name pattern with one map per view.
void keep_those_of_all_views(std::size_t views, std::size_t columns, KnownMaps& known, std::vector<fs::path>& used) {
    if (known.size() <= views) return;
    const auto shape_of = [](const fs::path& path) {
        std::string shape;
        for (const char c : path.filename().string())
            if (c < '0' || c > '9')
                shape += c;
            else if (shape.empty() || shape.back() != '#')
                shape += '#';
        return shape;
    };
    for (const fs::path& like : std::vector(used)) {
        const std::string shape = shape_of(like);
        const auto is_like = [&](const fs::path& path) { return shape_of(path) == shape; };
        if (static_cast<std::size_t>(std::ranges::count_if(used, is_like)) != views) continue;
        KnownMaps kept;
        for (std::size_t i = 0; i < used.size(); ++i)
            if (is_like(used[i])) kept.push_back({{kept.size() / columns, kept.size() % columns}, known[i].second});
        known = std::move(kept);
        std::erase_if(used, [&](const fs::path& path) { return !is_like(path); });
        return;
    }
}

}  // namespace

DisparityMap moved(const DisparityMap& map, double across, double down, double spacing_ratio) {
    if (across == 0 && down == 0) return map;
    DisparityMap out(map.shape(), NAN);
    const auto height = static_cast<long>(map.extent(0)), width = static_cast<long>(map.extent(1));
    for (long y = 0; y < height; ++y)
        for (long x = 0; x < width; ++x) {
            const float d = map(static_cast<std::size_t>(y), static_cast<std::size_t>(x));
            const long to_x = x - std::lround(d * across), to_y = y - std::lround(d * down * spacing_ratio);
            if (to_x < 0 || to_y < 0 || to_x >= width || to_y >= height) continue;
            float& target = out(static_cast<std::size_t>(to_y), static_cast<std::size_t>(to_x));
            if (std::isnan(target) || d > target) target = d;
        }
    const bool along_y = std::abs(down * spacing_ratio) > std::abs(across);
    fill_holes(out, along_y);
    fill_holes(out, !along_y);  // lines without any pixel
    for (float& value : out.elements())
        if (std::isnan(value)) value = 0;
    return median(out);
}

Disparities::Disparities(std::vector<std::pair<std::pair<std::size_t, std::size_t>, DisparityMap>> known,
                         double spacing_ratio, std::string origin, std::size_t kept)
    : known_(std::move(known)), spacing_ratio_(spacing_ratio), origin_(std::move(origin)), moved_(kept) {}

std::shared_ptr<const DisparityMap> Disparities::at(double row, double column) const {
    return moved_.get({row, column}, [&] {
        const auto distance = [&](const auto& each) {
            return std::hypot(static_cast<double>(each.first.first) - row,
                              static_cast<double>(each.first.second) - column);
        };
        const auto nearest = std::ranges::min_element(known_, {}, distance);
        return std::make_shared<const DisparityMap>(
            moved(nearest->second, column - static_cast<double>(nearest->first.second),
                  row - static_cast<double>(nearest->first.first), spacing_ratio_));
    });
}

std::shared_ptr<const Disparities> find_disparities(const fs::path& source, const ViewSet& set, std::size_t kept,
                                                    double scale) {
    std::error_code none;
    const fs::path folder = fs::is_directory(source, none) ? source : source.parent_path();
    std::vector<std::pair<std::pair<std::size_t, std::size_t>, DisparityMap>> known;
    std::vector<fs::path> used;
    bool of_depth = false, of_codes = false;
    const std::size_t views = set.rows * set.columns;
    for (const Candidate& candidate : candidates(folder)) {
        // Do not mix disparity with depth, or integers with floating-point numbers.
        if (!used.empty() && (candidate.depth != of_depth || candidate.coded != of_codes)) break;
        std::optional<DisparityMap> read =
            candidate.coded ? read_codes(candidate.path, scale) : read_map(candidate.path);
        if (!read) continue;
        DisparityMap& map = *read;
        if (map.extent(0) != set.height || map.extent(1) != set.width) continue;  // of a higher resolution
        if (candidate.depth) to_disparity(candidate.path, set.geometry, map);
        if (candidate.coded) {
            fill_holes(map, false);
            fill_holes(map, true);  // rows without any pixel
        }
        const auto largest = static_cast<float>(std::max(set.width, set.height));
        for (const float value : map.elements())
            if (!(std::abs(value) <= largest)) fail_source(candidate.path, "holds a disparity that cannot be");
        of_depth = candidate.depth;
        of_codes = candidate.coded;
        used.push_back(candidate.path);
        known.push_back({{(known.size() / set.columns), known.size() % set.columns}, map});
        if (known.size() > 2 * views) break;
    }
    if (known.empty()) return nullptr;
    keep_those_of_all_views(views, set.columns, known, used);
    if (known.size() == 1)
        known.front().first = {set.rows / 2, set.columns / 2};
    else if (known.size() != views)
        fail_source(folder,
                    fmt::format("has {} maps of disparity or depth; expected one, of the view in the middle, or "
                                "{}, of all views",
                                known.size(), views));
    const std::string origin =
        known.size() == 1 ? used.front().filename().string()
                          : fmt::format("{} to {}", used.front().filename().string(), used.back().filename().string());
    return std::make_shared<const Disparities>(std::move(known), set.geometry.spacing_ratio, origin, kept);
}

}  // namespace hogel::exchange
