// SPDX-License-Identifier: Apache-2.0
#include "report.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "hogel/error.h"
#include "hogel/resources.h"
#include "hogel/units.h"
#include "report_page.h"

namespace hogel::cli {
namespace {

constexpr double degree = std::numbers::pi / 180;

std::string escape(const std::string& text) {
    std::string escaped;
    for (const char c : text) {
        switch (c) {
            case '&':
                escaped += "&amp;";
                break;
            case '<':
                escaped += "&lt;";
                break;
            case '>':
                escaped += "&gt;";
                break;
            case '"':
                escaped += "&quot;";
                break;
            default:
                escaped += c;
        }
    }
    return escaped;
}

std::string base64(const std::vector<unsigned char>& bytes) {
    constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
        unsigned bits = 0;
        for (std::size_t j = 0; j < 3; ++j) bits = bits << 8 | (j < n ? bytes[i + j] : 0);
        for (std::size_t j = 0; j < 4; ++j) text += j <= n ? digits[bits >> (18 - 6 * j) & 63] : '=';
    }
    return text;
}

// Replaces each {{name}} of a page by its value.
std::string fill(std::string_view page, const std::map<std::string, std::string, std::less<>>& values) {
    std::string filled;
    for (;;) {
        const std::size_t open = page.find("{{");
        filled += page.substr(0, open);
        if (open == std::string_view::npos) return filled;
        const std::size_t close = page.find("}}", open);
        filled += values.at(std::string(page.substr(open + 2, close - open - 2)));
        page.remove_prefix(close + 2);
    }
}

std::string seconds_text(double seconds) {
    return seconds < 120 ? fmt::format("{:.1f} s", seconds) : fmt::format("{:.1f} min", seconds / 60);
}

std::string decibel_text(double decibels) { return std::isfinite(decibels) ? fmt::format("{:.1f} dB", decibels) : "∞"; }

double seconds_in_all(const Report& report) {
    double sum = 0;
    for (const auto& [name, seconds] : report.stages) sum += seconds;
    return sum;
}

std::string focus_title(const Camera& camera) {
    if (camera.focus_depth == 0) return "Focus on the hologram";
    return fmt::format("Focus {:.3g} mm {}", std::abs(camera.focus_depth) * 1e3,
                       camera.focus_depth > 0 ? "behind the hologram" : "in front of the hologram");
}

std::string eye_title(const Vec3& eye) {
    const auto offset_text = [](double value, const char* negative, const char* positive) {
        return std::abs(value) < 1e-9
                   ? std::string{}
                   : fmt::format("{:.1f} mm {}", std::abs(value) * 1e3, value < 0 ? negative : positive);
    };
    const std::string x = offset_text(eye.x, "to the left", "to the right"), y = offset_text(eye.y, "below", "above");
    if (x.empty() && y.empty()) return "From the middle";
    return "From " + x + (x.empty() || y.empty() ? "" : ", ") + y;
}

// Picture, its folder and the name of its file without extension.
struct Picture {
    const Image& image;
    std::filesystem::path folder;
    std::string file;
};

std::string html_of(const Picture& picture, const std::string& label, const std::string& alt) {
    const std::string file = picture.file + ".png";
    std::ifstream png(picture.folder / file, std::ios::binary);
    const std::vector<unsigned char> bytes{std::istreambuf_iterator<char>(png), {}};
    if (bytes.empty())
        throw Error(ErrorCode::bad_input, fmt::format("{}: cannot be read", (picture.folder / file).string()));
    return fmt::format(
        "<a href=\"{}\"><img src=\"data:image/png;base64,{}\" width=\"{}\" height=\"{}\" alt=\"{}\">"
        "<span>{}</span></a>",
        escape(file), base64(bytes), picture.image.width(), picture.image.height(), escape(alt), label);
}

// Returns the pictures of one camera side by side, and the PSNR and SSIM of those by waves compared with rays.
std::string figure_html(const MadePhotographs& photographs, std::size_t looks, const std::filesystem::path& folder) {
    const std::string eye = eye_title(photographs.camera.camera.eye);
    std::string pictures, numbers;
    const auto add = [&](const Image& image, const std::string& file, const std::string& label,
                         const std::string& method) {
        pictures += html_of({image, folder, file}, label, fmt::format("{}, photographed by {}", eye, method));
    };
    const auto compare = [&](const std::string& name, const ImageComparison& comparison) {
        numbers += fmt::format("<span class=\"soft num\">{}: PSNR {} · SSIM {:.3f}</span>", name,
                               decibel_text(comparison.psnr), comparison.ssim);
    };
    if (photographs.waves) {
        const std::string count = fmt::format("{} look{}", looks, looks == 1 ? "" : "s");
        add(photographs.waves->image, photographs.camera.wave_file(), "waves, " + count, "waves");
        compare(count, photographs.waves->comparison);
    }
    if (photographs.speckle_free) {
        add(photographs.speckle_free->image, photographs.camera.speckle_free_file(), "waves, speckle-free",
            "waves, speckle-free: the mean over infinitely many looks");
        compare("speckle-free", photographs.speckle_free->comparison);
    }
    add(photographs.rays, photographs.camera.ray_file(), "rays", "rays");
    return fmt::format(
        "<figure class=\"pair\"><div class=\"row\">{}</div>\n<figcaption><span>{}</span>{}</figcaption></figure>\n",
        pictures, eye, numbers);
}

// Returns a heading for each focus, followed by the pictures from all viewpoints.
std::string pictures_html(const Made& made, const std::filesystem::path& folder) {
    std::string html, open_focus;
    for (const MadePhotographs& photographs : made.photographs) {
        if (photographs.camera.focus_name != open_focus) {
            if (!open_focus.empty()) html += "</div>\n";
            html += fmt::format("<h2>{}</h2>\n<div class=\"pairs\">\n", focus_title(photographs.camera.camera));
            open_focus = photographs.camera.focus_name;
        }
        html += figure_html(photographs, looks_of(made), folder);
    }
    return html + "</div>";
}

using Rows = std::vector<std::pair<std::string, std::string>>;

std::string table(const Rows& rows) {
    std::string html = "<table>\n";
    for (const auto& [name, value] : rows)
        html += fmt::format("<tr><td>{}</td><td>{}</td></tr>\n", escape(name), escape(value));
    return html + "</table>\n";
}

std::string wavelengths_text(const Made& made) {
    std::string text;
    for (const FieldGrid& hologram : grids_of(made))
        text += (text.empty() ? "" : ", ") + format_length(hologram.wavelength);
    return text;
}

const Grid& plane_of(const Made& made) { return made.holograms.front()->grid().plane; }

std::string samples_text(const Made& made) {
    const Grid& plane = plane_of(made);
    return fmt::format("{} × {}", plane.width, plane.height);
}

std::string looks_text(const Made& made) {
    const std::size_t looks = looks_of(made);
    if (looks == 0) return "speckle-free";
    return std::to_string(looks) + (made.photographs.front().speckle_free ? "; and speckle-free" : "");
}

std::string tables_html(const Report& report, const Made& made) {
    const LightFieldGrid& grid = made.request.light_field.grid;
    const Grid& plane = plane_of(made);
    const double field_bytes = 8.0 * static_cast<double>(plane.samples()) * static_cast<double>(made.holograms.size());
    const Camera& camera = made.photographs.front().camera.camera;
    Rows object{{"Scene", fmt::format("{}, {} triangles", report.scene, report.triangles)},
                {"Renderer", made.request.light_field.renderer},
                {"Hogels", fmt::format("{} × {}, {} apart", grid.hogels_s, grid.hogels_t, format_length(grid.pitch))},
                {"Directions", fmt::format("{} × {} in each hogel", grid.directions_u, grid.directions_v)},
                {"Field of view", fmt::format("{:.4g}° × {:.4g}°", 2 * std::atan(grid.half_u()) / degree,
                                              2 * std::atan(grid.half_v()) / degree)},
                {"Rays", fmt::format("{:.4g} million", 1e-6 * grid.samples() / static_cast<double>(grid.channels))},
                {"Light field file", report.light_field_bytes > 0
                                         ? format_bytes(static_cast<double>(report.light_field_bytes))
                                         : "not kept; render it again with: " + report.render_command}};
    Rows hologram{{"Samples", samples_text(made)},
                  {"Pitch", fmt::format("{:.4g} µm", plane.pitch_x * 1e6)},
                  {"Wavelengths", wavelengths_text(made)},
                  {"Size if it were stored", format_bytes(field_bytes)},
                  {"Lens", fmt::format("{} wide, {} away", format_length(camera.pupil), format_length(camera.eye.z))},
                  {"Looks averaged", looks_text(made)},
                  {"Exposure", fmt::format("{:.4g}", made.exposure)}};
    Rows times;
    for (const auto& [name, seconds] : report.stages) {
        std::string title = name;
        title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(title[0])));
        times.emplace_back(title, seconds_text(seconds));
    }
    const std::size_t threads = thread_count();
    times.emplace_back("In all", fmt::format("{}, {} thread{}", seconds_text(seconds_in_all(report)), threads,
                                             threads == 1 ? "" : "s"));
    return table(object) + table(hologram) + table(times);
}

using Json = nlohmann::ordered_json;

Json number_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json json_of(const MadePhotographs& photographs) {
    const Camera& camera = photographs.camera.camera;
    Json json{{"eye_name", photographs.camera.eye_name},
              {"focus_name", photographs.camera.focus_name},
              {"eye", {camera.eye.x, camera.eye.y, camera.eye.z}},
              {"focus_depth", camera.focus_depth},
              {"pupil", camera.pupil},
              {"pixels", {camera.picture.width, camera.picture.height}},
              {"geometric", photographs.camera.ray_file() + ".png"}};
    if (photographs.speckle_free)
        json.update({{"expected", photographs.camera.speckle_free_file() + ".png"},
                     {"expected_psnr", number_or_null(photographs.speckle_free->comparison.psnr)},
                     {"expected_ssim", number_or_null(photographs.speckle_free->comparison.ssim)}});
    if (photographs.waves)
        json.update({{"wave", photographs.camera.wave_file() + ".png"},
                     {"psnr", number_or_null(photographs.waves->comparison.psnr)},
                     {"ssim", number_or_null(photographs.waves->comparison.ssim)},
                     {"max_error", number_or_null(photographs.waves->comparison.max_error)},
                     {"linear_psnr", number_or_null(photographs.waves->comparison.linear_psnr)}});
    return json;
}

std::string run_value(const Report& report, const std::string& name) {
    for (const auto& [key, value] : report.run)
        if (key == name) return value;
    return {};
}

}  // namespace

std::size_t looks_of(const Made& made) { return made.photographs.front().waves ? made.request.hologram.looks : 0; }

std::vector<FieldGrid> grids_of(const Made& made) {
    std::vector<FieldGrid> grids;
    for (const auto& hologram : made.holograms) grids.push_back(hologram->grid());
    return grids;
}

std::string report_html(const Report& report, const Made& made, const std::filesystem::path& folder) {
    const LightFieldGrid& grid = made.request.light_field.grid;
    const Camera& camera = made.photographs.front().camera.camera;
    return fill(report_page, {{"scene", escape(report.scene)},
                              {"samples", samples_text(made)},
                              {"colours", made.holograms.size() == 3 ? "three colours" : "one colour"},
                              {"hologram_width", format_length(plane_of(made).size_x())},
                              {"hogels", fmt::format("{} × {}", grid.hogels_s, grid.hogels_t)},
                              {"pupil", format_length(camera.pupil)},
                              {"eye_distance", format_length(camera.eye.z)},
                              {"pictures", pictures_html(made, folder)},
                              {"tables", tables_html(report, made)},
                              {"software", escape(run_value(report, "software"))},
                              {"command", escape(run_value(report, "command") + " " + report.scene)}});
}

std::string report_json(const Report& report, const Made& made) {
    const LightFieldGrid& grid = made.request.light_field.grid;
    Json json;
    for (const auto& [name, value] : report.run) json["run"][name] = value;
    json["work"] = report.work;
    json["scene"] = {{"name", report.scene}, {"input", report.scene_input}, {"triangles", report.triangles}};
    json["light_field"] = {
        {"algorithm", made.request.light_field.renderer},       {"hogels", {grid.hogels_s, grid.hogels_t}},
        {"directions", {grid.directions_u, grid.directions_v}}, {"pitch", grid.pitch},
        {"tan_half", {grid.half_u(), grid.half_v()}},           {"render", report.render_command}};
    if (report.light_field_bytes > 0)
        json["light_field"].update({{"file", "lightfield.h5"}, {"bytes", report.light_field_bytes}});
    for (const FieldGrid& hologram : grids_of(made))
        json["holograms"].push_back({{"wavelength", hologram.wavelength},
                                     {"samples", {hologram.plane.width, hologram.plane.height}},
                                     {"pitch", hologram.plane.pitch_x}});
    json["looks"] = looks_of(made);
    json["pupil_samples"] = made.request.rays.pupil_samples;
    json["exposure"] = number_or_null(made.exposure);
    for (const MadePhotographs& photographs : made.photographs) json["photographs"].push_back(json_of(photographs));
    for (const auto& [name, seconds] : report.stages) json["stages"].push_back({{"name", name}, {"seconds", seconds}});
    json["seconds"] = seconds_in_all(report);
    json["threads"] = thread_count();
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

bool has_report_of(const std::filesystem::path& folder, const std::vector<std::string>& work) {
    if (!std::filesystem::exists(folder / "report.html")) return false;
    std::ifstream file(folder / "report.json");
    const auto json = nlohmann::json::parse(file, nullptr, false);
    return json.is_object() && json.contains("work") && json["work"] == nlohmann::json(work);
}

}  // namespace hogel::cli
