// SPDX-License-Identifier: Apache-2.0
#include "view/facts.h"

#include <cmath>
#include <numbers>

namespace hogel::view {

nlohmann::ordered_json facts_of_scene(const Settings& settings, const std::vector<Advice>& advice, bool is_file) {
    const LightFieldParameters& render = settings.options().render;
    const HologramRequest hologram = settings.options().hologram.request(render.request().grids(), settings.seed(), 1);
    // Removes the rounding error of the conversion to radians and back.
    const auto degrees = [](double radians) { return std::round(radians * 180 / std::numbers::pi * 1e9) / 1e9; };
    const Vec3 turn = render.scene.pose.rotation, move = render.scene.pose.shift;
    nlohmann::ordered_json advice_json = nlohmann::ordered_json::array();
    for (const Advice& each : advice)
        advice_json.push_back(
            {{"option", each.parameter}, {"text", each.text}, {"enough", each.enough}, {"refused", each.refused}});
    return {{"hogels", {render.hogels.columns, render.hogels.rows}},
            {"directions", {render.directions.columns, render.directions.rows}},
            {"size_m", render.size},
            {"fov_deg", {degrees(render.field_of_view.across), degrees(render.field_of_view.down)}},
            {"front", render.front},
            {"move_m", {move.x, move.y, move.z}},
            {"rotate_deg", {degrees(turn.x), degrees(turn.y), degrees(turn.z)}},
            {"lights", render.scene.lights},
            {"pitch_m", hologram.pitch},
            {"is_file", is_file},
            {"make", settings.make_command()},
            {"advice", advice_json}};
}

nlohmann::ordered_json facts_of_stream(const StreamFacts& stream) {
    nlohmann::ordered_json facts{{"layers", stream.layers},
                                 {"of_layers", stream.of_layers},
                                 {"bytes", stream.bytes},
                                 {"original", stream.original}};
    if (stream.sqnr) {
        facts["exact"] = !std::isfinite(*stream.sqnr);
        if (std::isfinite(*stream.sqnr)) facts["sqnr_db"] = *stream.sqnr;
        if (std::isfinite(*stream.psnr)) facts["psnr_db"] = *stream.psnr;
    }
    return facts;
}

}  // namespace hogel::view
