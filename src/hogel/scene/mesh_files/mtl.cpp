// SPDX-License-Identifier: Apache-2.0
#include "hogel/scene/mesh_files/mtl.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include "hogel/core/stop_scope.h"
#include "hogel/scene/edges.h"
#include "hogel/scene/mesh_files/checks.h"
#include "hogel/scene/mesh_files/files.h"

namespace hogel::scene::mesh_files {
namespace {

constexpr std::string_view spaces = " \t\r";

class Line {
  public:
    explicit Line(std::string_view text) : rest_(text) { trim(); }

    std::string_view word() {
        const std::string_view word = rest_.substr(0, rest_.find_first_of(spaces));
        rest_.remove_prefix(word.size());
        trim();
        return word;
    }
    std::optional<double> number() {
        std::string_view text = rest_.substr(0, rest_.find_first_of(spaces));
        if (text.starts_with('+')) text.remove_prefix(1);
        double value = 0;
        const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (text.empty() || status != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
            return std::nullopt;
        word();
        return value;
    }
    /// Returns the rest without leading and trailing spaces.
    std::string_view rest() const { return rest_; }

  private:
    void trim() {
        rest_.remove_prefix(std::min(rest_.find_first_not_of(spaces), rest_.size()));
        rest_ = rest_.substr(0, rest_.find_last_not_of(spaces) + 1);
    }
    std::string_view rest_;
};

template <class Each>
void for_lines(std::string_view text, const Each& each) {
    for (std::size_t lines = 0; !text.empty(); ++lines) {
        if (lines % between_checks == 0) core::throw_if_stopped();
        const std::size_t end = std::min(text.find('\n'), text.size());
        each(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
}

MtlTexture parse_texture(Line line, std::set<std::string>& left_out) {
    MtlTexture texture;
    while (line.rest().starts_with('-')) {
        const Line before = line;
        const std::string option(line.word());
        if (option == "-s" || option == "-o" || option == "-t") {
            std::array<double, 2>& values = option == "-s" ? texture.scale : texture.offset;
            for (std::size_t i = 0; i < 3; ++i) {
                const auto number = line.number();
                if (number && i < 2 && option != "-t") values[i] = std::clamp(*number, -1e6, 1e6);
            }
            if (option == "-t") left_out.insert("turbulence of textures (-t)");
        } else if (option == "-mm") {
            const auto base = line.number(), gain = line.number();
            if (base.value_or(0) != 0 || gain.value_or(1) != 1) left_out.insert("ranges of textures (-mm)");
        } else if (option == "-clamp") {
            texture.clamp = line.word() == "on";
        } else if (option == "-blendu" || option == "-blendv" || option == "-cc" || option == "-imfchan" ||
                   option == "-type" || option == "-bm" || option == "-boost" || option == "-texres") {
            const std::string value(line.word());
            if (option == "-imfchan" && value != "l" && value != "m")
                left_out.insert("channels of textures (-imfchan)");
        } else {
            line = before;  // a name that begins with a dash
            break;
        }
    }
    std::string_view name = line.rest();
    if (name.size() > 2 && name.front() == '"' && name.back() == '"') name = name.substr(1, name.size() - 2);
    texture.name = name;
    return texture;
}

class Parser {
  public:
    std::vector<MtlMaterial> parse(std::string_view text) {
        for_lines(text, [&](std::string_view line) { statement(Line(line)); });
        return std::move(materials_);
    }

  private:
    void statement(Line line) {
        const std::string key(line.word());
        if (key == "newmtl") materials_.emplace_back().name = line.rest();
        if (materials_.empty()) return;
        MtlMaterial& material = materials_.back();
        if (key == "d") {
            material.dissolve = line.number();
        } else if (key == "Tr") {
            material.transparency = line.number();
        } else if (key == "Ke") {
            material.emission = color(line);
        } else if (key == "map_Kd") {
            material.color = parse_texture(line, material.left_out);
        } else if (key == "map_d" || key == "map_Tr") {
            material.opacity = parse_texture(line, material.left_out);
        } else if (key == "map_Ke" || key == "map_emissive") {
            material.emission_map = parse_texture(line, material.left_out);
        } else if (key == "Ks") {
            const auto highlight = color(line);
            if (highlight && *highlight != Rgb{0, 0, 0}) material.left_out.insert("highlights (Ks, Ns)");
        } else if (key == "illum") {
            const auto model = line.number();
            if (model && *model <= 1) material.left_out.erase("highlights (Ks, Ns)");
            if (model && *model >= 3) material.left_out.insert("mirrors and glass (illum 3 and above)");
        } else {
            note_unsupported(key, line, material);
        }
    }

    static void note_unsupported(const std::string& key, Line line, MtlMaterial& material) {
        static const std::map<std::string, std::string> words{{"map_bump", "bump maps"},
                                                              {"map_Bump", "bump maps"},
                                                              {"bump", "bump maps"},
                                                              {"norm", "normal maps"},
                                                              {"disp", "displacement maps"},
                                                              {"decal", "decals"},
                                                              {"refl", "reflection maps"},
                                                              {"map_Ka", "maps of ambient colour (map_Ka)"},
                                                              {"map_Ks", "maps of highlights (map_Ks, map_Ns)"},
                                                              {"map_Ns", "maps of highlights (map_Ks, map_Ns)"},
                                                              {"map_Pr", "roughness and metal (Pr, Pm)"},
                                                              {"map_Pm", "roughness and metal (Pr, Pm)"}};
        if (const auto found = words.find(key); found != words.end()) {
            material.left_out.insert(found->second);
        } else if (key == "Pr" || key == "Pm") {
            material.left_out.insert("roughness and metal (Pr, Pm)");
        } else if (key == "Ps" || key == "Pc") {
            if (line.number().value_or(0) != 0) material.left_out.insert("sheen and clear coats (Ps, Pc)");
        } else if (key == "Tf") {
            const auto filter = color(line);
            if (filter && *filter != Rgb{1, 1, 1} && *filter != Rgb{0, 0, 0})
                material.left_out.insert("colours of light that passes (Tf)");
        }
    }

    // A single number applies to all three channels.
    static std::optional<Rgb> color(Line line) {
        const auto r = line.number();
        if (!r) return std::nullopt;
        const double g = line.number().value_or(*r), b = line.number().value_or(*r);
        const auto part = [](double value) { return static_cast<float>(std::clamp(value, 0.0, 1e6)); };
        return Rgb{part(*r), part(g), part(b)};
    }

    std::vector<MtlMaterial> materials_;
};

}  // namespace

double MtlMaterial::alpha() const { return std::clamp(dissolve.value_or(1 - transparency.value_or(0)), 0.0, 1.0); }

std::vector<MtlMaterial> parse_mtl(std::string_view text) { return Parser().parse(text); }

std::vector<std::string> notes_of(const std::vector<MtlMaterial>& materials) {
    std::map<std::string, std::size_t> counts;
    std::vector<const std::string*> invisible;
    for (const MtlMaterial& material : materials) {
        for (const std::string& what : material.left_out) ++counts[what];
        if (material.alpha() == 0) invisible.push_back(&material.name);
        const auto elsewhere = [&](const MtlTexture& map) {
            return !map.name.empty() && (map.scale != material.color.scale || map.offset != material.color.offset);
        };
        if (elsewhere(material.opacity) || elsewhere(material.emission_map))
            ++counts["places of map_d and map_Ke (-s, -o) other than those of map_Kd"];
    }
    std::vector<std::string> notes;
    if (!invisible.empty())
        notes.push_back(
            fmt::format("material '{}'{} invisible: its opacity is 0 (d, Tr)", one_line(*invisible[0]),
                        invisible.size() == 1 ? " is" : fmt::format(" (and {} more) is", invisible.size() - 1)));
    for (const auto& [what, count] : counts)
        notes.push_back(fmt::format("{} of {} material{} are left out", what, count, count == 1 ? "" : "s"));
    return notes;
}

std::vector<std::string> notes_of_obj(std::string_view text, const std::filesystem::path& folder) {
    std::set<std::string> missing;
    bool has_curves = false;
    for_lines(text, [&](std::string_view text_line) {
        // Fast path: skip vertices and faces.
        if (text_line.empty() || (text_line[0] != 'm' && text_line[0] != 'c' && text_line[0] != 's')) return;
        Line line(text_line);
        const std::string_view key = line.word();
        if (key == "curv" || key == "curv2" || key == "surf") has_curves = true;
        if (key == "mtllib" && !line.rest().empty() && !find_in_folder(folder, std::string(line.rest())))
            missing.insert(one_line(std::string(line.rest())));
    });
    std::vector<std::string> notes;
    if (has_curves) notes.push_back("free-form curves and surfaces are left out");
    for (const std::string& name : missing)
        notes.push_back(fmt::format("its material library '{}' is not found: surfaces have no colours of it", name));
    return notes;
}

}  // namespace hogel::scene::mesh_files
