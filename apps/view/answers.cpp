// SPDX-License-Identifier: Apache-2.0
#include "view/answers.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>

#include "hogel/image.h"
#include "hogel/parameters.h"

namespace hogel::view {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

// Returns the bytes of an EXR file. The library writes EXR only to disk, hence a temporary folder of mode 0700.
std::string exr_file(const Image& picture) {
    std::string name = (std::filesystem::temp_directory_path() / "hogel-view-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
        throw Error(ErrorCode::cannot_write, name + ": cannot be made; the folder of TMPDIR must be writable");
    const std::filesystem::path folder = name, file = folder / "picture.exr";
    std::string bytes;
    std::error_code none;
    try {
        write_image(file, picture);
        std::ifstream stream(file, std::ios::binary);
        bytes.assign(std::istreambuf_iterator<char>(stream), {});
    } catch (...) {
        std::filesystem::remove_all(folder, none);
        throw;
    }
    std::filesystem::remove_all(folder, none);
    return bytes;
}

}  // namespace

std::string dump(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n"; }

Response failure(unsigned status, const std::string& why, const std::vector<std::string>& parameter) {
    return {status, json_type, dump({{"type", "error"}, {"message", why}, {"parameter", parameter}})};
}

Response failure(const Error& error) {
    return failure(error.code() == ErrorCode::usage       ? 400
                   : error.code() == ErrorCode::cancelled ? 503
                                                          : 500,
                   error.what(), names_of_parameters(error.parameter()));
}

Response answer_with(const Json& json) { return {200, json_type, dump(json)}; }

std::string encode(const Photograph& photograph, const PictureQuery& query) {
    if (query.format == "exr") return exr_file(photograph.picture);
    const std::vector<unsigned char> file = query.format == "png"
                                                ? encode_png(photograph.picture, photograph.exposure)
                                                : encode_jpeg(photograph.picture, photograph.exposure, query.quality);
    return {file.begin(), file.end()};
}

std::string type_of(const PictureQuery& query) {
    return query.format == "exr" ? "image/x-exr" : query.format == "png" ? "image/png" : "image/jpeg";
}

Json to_json(const Photograph& photograph, const PictureQuery& query, const Viewable& viewable, double seconds) {
    Json json{{"type", "picture"},
              {"id", query.id},
              {"format", query.format},
              {"width", photograph.picture.width()},
              {"height", photograph.picture.height()},
              {"exposure", photograph.exposure},
              {"pupil_samples", query.pupil_samples},
              {"seconds", seconds}};
    if (photograph.looks > 0) {
        const std::size_t all = query.looks > 0 ? std::min(query.looks, viewable.looks()) : viewable.looks();
        json["looks"] = photograph.looks;
        json["of_looks"] = all;
    }
    if (photograph.psnr && std::isfinite(*photograph.psnr)) json["psnr"] = *photograph.psnr;
    return json;
}

Json to_json(const Reading& reading, const std::string& id) {
    Json json{{"type", "reading"},
              {"id", id},
              {"x_m", reading.x},
              {"y_m", reading.y},
              {"across_deg", reading.across * degrees},
              {"up_deg", reading.up * degrees},
              {"inside", reading.inside}};
    if (reading.inside) json["radiance"] = reading.radiance;
    if (reading.depth) json["depth_m"] = *reading.depth;
    if (reading.bytes) json["hogel_bytes"] = *reading.bytes;
    if (reading.phase) json["phase_deg"] = *reading.phase * degrees;
    return json;
}

// Reports two contrast curves: of edges, and of the cell size in which the first plane stands out.
Json to_json(const FocusSearch& search) {
    Json planes = Json::array(), edges = Json::array(), squares = Json::array();
    std::size_t kind = 0;
    for (std::size_t i = 0; !search.planes.empty() && i < FocusSearch::cells.size(); ++i)
        if (FocusSearch::cells[i] == search.planes.front().cell) kind = i;
    for (const FocusSearch::Contrasts& contrasts : search.contrasts) {
        edges.push_back(contrasts[FocusSearch::edges]);
        squares.push_back(contrasts[kind]);
    }
    for (const FocusPlane& plane : search.planes)
        planes.push_back({{"depth_m", plane.depth},
                          {"prominence", plane.prominence},
                          {"contrast", plane.brightest ? "highest" : "lowest"},
                          {"cell", plane.cell}});
    return {
        {"type", "sharpness"}, {"depths_m", search.depths},        {"edges", edges},
        {"squares", squares},  {"cell", FocusSearch::cells[kind]}, {"depth_of_focus_m", search.light_depth_of_focus},
        {"planes", planes}};
}

Json to_json(const LevelCounts& levels) {
    return {{"type", "levels"},        {"encoding", levels.encoding}, {"width", levels.width},
            {"height", levels.height}, {"counts", levels.counts},     {"efficiency", levels.efficiency}};
}

}  // namespace hogel::view
