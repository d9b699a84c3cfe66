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
    const auto along = [](double value, const char* negative, const char* positive) {
        return std::abs(value) < 1e-9
                   ? std::string{}
                   : fmt::format("{:.1f} mm {}", std::abs(value) * 1e3, value < 0 ? negative : positive);
    };
    const std::string x = along(eye.x, "to the left", "to the right"), y = along(eye.y, "below", "above");
    if (x.empty() && y.empty()) return "From the middle";
    return "From " + x + (x.empty() || y.empty() ? "" : ", ") + y;
}

// A picture and the name of its file in the folder, without extension.
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

// A heading for each focus, with the views from all eyes below it.
std::string pictures_html(const Report& report, const std::filesystem::path& folder) {
    std::string html, open_focus;
    for (const PhotographPair& pair : report.pairs) {
        if (pair.focus_name != open_focus) {
            if (!open_focus.empty()) html += "</div>\n";
            html += fmt::format("<h2>{}</h2>\n<div class=\"pairs\">\n", focus_title(pair.camera));
            open_focus = pair.focus_name;
        }
        const std::string eye = eye_title(pair.camera.eye);
        std::string pictures, numbers;
        const auto add = [&](const Image& image, const std::string& file, const std::string& label,
                             const std::string& by) {
            pictures += html_of({image, folder, file}, label, fmt::format("{}, photographed by {}", eye, by));
        };
        const auto compare = [&](const std::string& name, const ImageComparison& comparison) {
            numbers += fmt::format("<span class=\"soft num\">{}: PSNR {} · SSIM {:.3f}</span>", name,
                                   decibel_text(comparison.psnr), comparison.ssim);
        };
        if (report.looks > 0) {
            const std::string looks = fmt::format("{} look{}", report.looks, report.looks == 1 ? "" : "s");
            add(pair.wave, pair.wave_file, "waves, " + looks, "waves");
            compare(looks, pair.comparison);
        }
        if (report.expected) {
            add(pair.expected, pair.expected_file, "waves, infinitely many looks",
                "waves, the mean of infinitely many looks");
            compare("infinitely many looks", pair.expected_comparison);
        }
        add(pair.geometric, pair.geometric_file, "rays", "rays");
        html += fmt::format(
            "<figure class=\"pair\"><div class=\"row\">{}</div>\n<figcaption><span>{}</span>{}</figcaption></figure>\n",
            pictures, eye, numbers);
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

std::string wavelengths_text(const Report& report) {
    std::string text;
    for (const FieldGrid& hologram : report.holograms)
        text += (text.empty() ? "" : ", ") + format_length(hologram.wavelength);
    return text;
}

std::string samples_text(const Report& report) {
    const Grid& plane = report.holograms.front().plane;
    return fmt::format("{} × {}", plane.width, plane.height);
}

std::string tables_html(const Report& report) {
    const LightFieldGrid& grid = report.light_field;
    const Grid& plane = report.holograms.front().plane;
    const double field_bytes =
        8.0 * static_cast<double>(plane.samples()) * static_cast<double>(report.holograms.size());
    const Camera& camera = report.pairs.front().camera;
    Rows object{{"Scene", fmt::format("{}, {} triangles", report.scene, report.triangles)},
                {"Renderer", report.algorithm},
                {"Hogels", fmt::format("{} × {}, {} apart", grid.hogels_s, grid.hogels_t, format_length(grid.pitch))},
                {"Directions", fmt::format("{} × {} in each hogel", grid.directions_u, grid.directions_v)},
                {"Field of view", fmt::format("{:.4g}° × {:.4g}°", 2 * std::atan(grid.half_u()) / degree,
                                              2 * std::atan(grid.half_v()) / degree)},
                {"Rays", fmt::format("{:.4g} million", 1e-6 * grid.samples() / static_cast<double>(grid.channels))},
                {"Light field file", report.light_field_bytes > 0
                                         ? format_bytes(static_cast<double>(report.light_field_bytes))
                                         : "not kept; scene and options are, from which it can be rendered again: " +
                                               report.render_command}};
    Rows hologram{{"Samples", samples_text(report)},
                  {"Pitch", fmt::format("{:.4g} µm", plane.pitch_x * 1e6)},
                  {"Wavelengths", wavelengths_text(report)},
                  {"Size if it were stored", format_bytes(field_bytes)},
                  {"Lens", fmt::format("{} wide, {} away", format_length(camera.pupil), format_length(camera.eye.z))},
                  {"Looks averaged", report.looks == 0 ? "infinitely many"
                                     : report.expected ? fmt::format("{}; and infinitely many", report.looks)
                                                       : fmt::format("{}", report.looks)},
                  {"Exposure", fmt::format("{:.4g}", report.exposure)}};
    Rows times;
    for (const auto& [name, seconds] : report.stages) {
        std::string title = name;
        title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(title[0])));
        times.emplace_back(title, seconds_text(seconds));
    }
    times.emplace_back("In all", fmt::format("{}, {} thread{}", seconds_text(seconds_in_all(report)), report.threads,
                                             report.threads == 1 ? "" : "s"));
    return table(object) + table(hologram) + table(times);
}

std::string run_value(const Report& report, const std::string& name) {
    for (const auto& [key, value] : report.run)
        if (key == name) return value;
    return {};
}

}  // namespace

std::string report_html(const Report& report, const std::filesystem::path& folder) {
    const LightFieldGrid& grid = report.light_field;
    const Camera& camera = report.pairs.front().camera;
    return fill(report_page, {{"scene", escape(report.scene)},
                              {"samples", samples_text(report)},
                              {"colours", report.holograms.size() == 3 ? "three colours" : "one colour"},
                              {"hologram_width", format_length(report.holograms.front().plane.size_x())},
                              {"hogels", fmt::format("{} × {}", grid.hogels_s, grid.hogels_t)},
                              {"pupil", format_length(camera.pupil)},
                              {"eye_distance", format_length(camera.eye.z)},
                              {"pictures", pictures_html(report, folder)},
                              {"tables", tables_html(report)},
                              {"software", escape(run_value(report, "software"))},
                              {"command", escape(run_value(report, "command") + " " + report.scene)}});
}

std::string report_json(const Report& report) {
    using Json = nlohmann::ordered_json;
    const auto number = [](double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); };
    const LightFieldGrid& grid = report.light_field;
    Json json;
    for (const auto& [name, value] : report.run) json["run"][name] = value;
    json["work"] = report.work;
    json["scene"] = {{"name", report.scene}, {"input", report.scene_input}, {"triangles", report.triangles}};
    json["light_field"] = {{"algorithm", report.algorithm},
                           {"hogels", {grid.hogels_s, grid.hogels_t}},
                           {"directions", {grid.directions_u, grid.directions_v}},
                           {"pitch", grid.pitch},
                           {"tan_half", {grid.half_u(), grid.half_v()}},
                           {"render", report.render_command}};
    if (report.light_field_bytes > 0)
        json["light_field"].update({{"file", "lightfield.h5"}, {"bytes", report.light_field_bytes}});
    for (const FieldGrid& hologram : report.holograms)
        json["holograms"].push_back({{"wavelength", hologram.wavelength},
                                     {"samples", {hologram.plane.width, hologram.plane.height}},
                                     {"pitch", hologram.plane.pitch_x}});
    json["looks"] = report.looks;
    json["pupil_samples"] = report.pupil_samples;
    json["exposure"] = number(report.exposure);
    for (const PhotographPair& pair : report.pairs) {
        const Camera& camera = pair.camera;
        json["photographs"].push_back({{"eye_name", pair.eye_name},
                                       {"focus_name", pair.focus_name},
                                       {"eye", {camera.eye.x, camera.eye.y, camera.eye.z}},
                                       {"focus_depth", camera.focus_depth},
                                       {"pupil", camera.pupil},
                                       {"pixels", {camera.picture.width, camera.picture.height}},
                                       {"geometric", pair.geometric_file + ".png"}});
        if (report.expected)
            json["photographs"].back().update({{"expected", pair.expected_file + ".png"},
                                               {"expected_psnr", number(pair.expected_comparison.psnr)},
                                               {"expected_ssim", number(pair.expected_comparison.ssim)}});
        if (report.looks == 0) continue;
        json["photographs"].back().update({{"wave", pair.wave_file + ".png"},
                                           {"psnr", number(pair.comparison.psnr)},
                                           {"ssim", number(pair.comparison.ssim)},
                                           {"max_error", number(pair.comparison.max_error)},
                                           {"linear_psnr", number(pair.comparison.linear_psnr)}});
    }
    for (const auto& [name, seconds] : report.stages) json["stages"].push_back({{"name", name}, {"seconds", seconds}});
    json["seconds"] = seconds_in_all(report);
    json["threads"] = report.threads;
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

bool has_report_of(const std::filesystem::path& folder, const std::vector<std::string>& work) {
    if (!std::filesystem::exists(folder / "report.html")) return false;
    std::ifstream file(folder / "report.json");
    const auto json = nlohmann::json::parse(file, nullptr, false);
    return json.is_object() && json.contains("work") && json["work"] == nlohmann::json(work);
}

}  // namespace hogel::cli
