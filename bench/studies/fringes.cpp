// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "bench/measure.h"
#include "bench/scene.h"
#include "bench/session.h"
#include "bench/studies/studies.h"
#include "hogel/hologram.h"
#include "hogel/renderer.h"
#include "hogel/resources.h"
#include "thesis/wavelets/transform.h"

namespace hogel::bench {
namespace {

constexpr double wavelength = 633e-9;

// A kind of hologram: its faces, and its lines a hogel, 0 for both parallaxes.
struct Kind {
    std::string name;
    std::vector<LightFieldGrid> faces;
    double pitch;
    std::size_t lines;
};

// Hogels have as many lobes as directions, about, and sides that suit the Fourier transform.
std::vector<Kind> kinds() {
    const auto front = [](std::size_t hogels, std::size_t samples, double pitch, std::size_t across, std::size_t down) {
        const double tangent = 0.98 * std::tan(std::asin(wavelength / (2 * pitch)));
        return LightFieldGrid{hogels, hogels, double(samples) * pitch, across, down, Perspective{tangent, tangent}, 1};
    };
    const auto cube = [](std::size_t hogels, std::size_t samples, std::size_t across, std::size_t down) {
        return hemicube(
            {hogels, hogels, double(samples) * 0.3e-6, across, down, Perspective{1, down == 1 ? 0.1 : 1}, 1});
    };
    return {{"perspective, 32 × 32", {front(32, 32, 2e-6, 32, 32)}, 2e-6, 0},
            {"perspective, 64 × 64", {front(16, 64, 2e-6, 64, 64)}, 2e-6, 0},
            {"hemicube, 32 × 32", cube(24, 32, 16, 16), 0.3e-6, 0},
            {"hemicube, 64 × 64", cube(10, 64, 32, 32), 0.3e-6, 0},
            {"lines of 256, 8 a hogel", {front(32, 256, 2e-6, 256, 1)}, 2e-6, 8},
            {"lines of 256, one a hogel", {front(96, 256, 2e-6, 256, 1)}, 2e-6, 1},
            {"lines of 1024, one a hogel", {front(48, 1024, 2e-6, 1024, 1)}, 2e-6, 1},
            {"hemisquare, lines of 256, 8 a hogel", cube(32, 256, 128, 1), 0.3e-6, 8}};
}

std::size_t rays_of(const Kind& kind) {
    return std::accumulate(kind.faces.begin(), kind.faces.end(), std::size_t{0},
                           [](std::size_t sum, const LightFieldGrid& face) { return sum + face.directions(); });
}

wavelets::Pyramid pyramid(const LightFieldGrid& face) {
    return wavelets::Pyramid::separate({face.hogels(), face.directions_v, face.directions_u}, {{1, 2}});
}

using Faces = std::vector<std::shared_ptr<LightFieldBuffer>>;

LightField light_field_of(const Faces& faces) {
    return LightField(std::vector<LightField::Source>(faces.begin(), faces.end()));
}

Faces empty_faces(const Kind& kind) {
    Faces faces;
    for (const LightFieldGrid& grid : kind.faces) faces.push_back(std::make_shared<LightFieldBuffer>(grid));
    return faces;
}

// Each hogel keeps `kept` coefficients of its own.
Faces with_coefficients(const Kind& kind, std::size_t kept) {
    Faces faces = empty_faces(kind);
    std::vector<std::size_t> order(rays_of(kind));
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::mt19937 random(1);
    for (std::size_t hogel = 0; hogel < kind.faces.front().hogels(); ++hogel)
        for (std::size_t i = 0; i < kept; ++i) {
            std::swap(order[i], order[i + random() % (order.size() - i)]);
            std::size_t number = order[i], face = 0;
            for (; number >= kind.faces[face].directions(); ++face) number -= kind.faces[face].directions();
            faces[face]->radiance.data()[hogel * kind.faces[face].directions() + number] =
                0.1f + float(random() % 1024) / 1024;
        }
    return faces;
}

Faces noise(const Kind& kind) {
    Faces faces = empty_faces(kind);
    std::minstd_rand random(1);
    for (const auto& face : faces)
        for (float& ray : face->radiance.elements()) ray = float(random() % 1024) / 1024;
    return faces;
}

HologramOptions options_of(const Kind& kind, const HologramMethod& method) {
    HologramOptions options;
    options.channel.wavelength = wavelength;
    options.pitch = kind.pitch;
    options.method = method;
    return options;
}

HologramMethod by_transforms(const Kind& kind, Phases phases, LobeAverage average) {
    if (kind.lines == 0) return Fourier{phases, average};
    return Lines{kind.faces.front().pitch / double(kind.lines), phases, average};
}

HologramMethod by_fringes(const Kind& kind, const std::string& transform) {
    Basis basis{.transform = transform};
    if (kind.lines > 0) basis.line_pitch = kind.faces.front().pitch / double(kind.lines);
    return basis;
}

// One of the ways to a hologram, and its best time.
struct Way {
    std::function<void()> work;
    double seconds = std::numeric_limits<double>::infinity();
};

// The best of rounds in which all ways alternate, after one that is not measured.
void measure(std::vector<Way>& ways, std::size_t rounds) {
    for (Way& way : ways) way.work();
    for (std::size_t i = 0; i < rounds; ++i)
        for (Way& way : ways) {
            stop_if_interrupted();
            way.seconds = std::min(way.seconds, time_of(way.work).processor);
        }
}

// Makes a hologram over and over into the same field.
Way to_field(std::shared_ptr<const FieldSource> hologram, const std::shared_ptr<Field>& field) {
    return {[hologram = std::move(hologram), field] { copy(*hologram, *field); }};
}

// The number of coefficients up to which a line through the measured times stays below a time.
std::string up_to(const std::vector<std::size_t>& kept, const std::vector<double>& times, double limit) {
    if (times.front() > limit) return "none";
    for (std::size_t i = 1; i < kept.size(); ++i)
        if (times[i] > limit) {
            const double part = (limit - times[i - 1]) / (times[i] - times[i - 1]);
            return fmt::format("{:.0f}", double(kept[i - 1]) + part * double(kept[i] - kept[i - 1]));
        }
    return "all";
}

// The mean number of coefficients of a hogel that carry all but 10^(−dB/10) of the energy of √L.
std::vector<double> needed(const Kind& kind, const std::string& name, const std::string& transform,
                           const std::vector<double>& decibels) {
    LightFieldOptions scene_options;
    scene_options.size = kind.faces.front().width();
    scene_options.cache_spacing = 0;
    Session quiet;
    quiet.quiet = true;
    const auto scene = shade(quiet, load_scene(name, scene_options), scene_options);
    const std::size_t hogels = kind.faces.front().hogels();
    std::vector<std::vector<double>> energies(hogels);
    for (const LightFieldGrid& grid : kind.faces) {
        LightFieldBuffer face(grid);
        copy(*make_renderer(default_algorithm, scene, grid), face);
        for (float& value : face.radiance.elements()) value = std::sqrt(std::max(value, 0.0f));
        wavelets::transform(transform).forward(pyramid(grid), face.radiance.elements());
        for (std::size_t i = 0; i < face.radiance.size(); ++i)
            energies[i / grid.directions()].push_back(std::pow(double{face.radiance.data()[i]}, 2));
    }
    std::vector<double> sums(decibels.size());
    for (auto& of_hogel : energies) {
        std::ranges::sort(of_hogel, std::greater());
        const double all = std::accumulate(of_hogel.begin(), of_hogel.end(), 0.0);
        for (std::size_t i = 0; i < decibels.size(); ++i) {
            double left = all;
            std::size_t count = 0;
            for (; count < of_hogel.size() && left > all * std::pow(10, -decibels[i] / 10); ++count)
                left -= of_hogel[count];
            sums[i] += double(count) / double(hogels);
        }
    }
    return sums;
}

const std::vector<std::size_t> counts{1, 2, 4, 8, 16, 32, 64, 128, 256};
const std::vector<double> qualities{20, 30, 40};

void study_kind(const Kind& kind, const FringeStudy& study) {
    const Faces rays = noise(kind), all = with_coefficients(kind, rays_of(kind));
    const auto random = make_hologram(light_field_of(rays),
                                      options_of(kind, by_transforms(kind, Phases::random, LobeAverage::radiance)));
    const auto fixed = make_hologram(light_field_of(rays),
                                     options_of(kind, by_transforms(kind, Phases::fixed, LobeAverage::amplitude)));
    const auto field = std::make_shared<Field>(random->grid());
    std::vector<Way> ways{to_field(random, field), to_field(fixed, field)};
    // Inverting the transform of the directions, in a copy whose values stay small.
    auto scratch = std::make_shared<std::vector<Array<float, 1>>>();
    for (const auto& face : all) scratch->emplace_back(Shape<1>{face->radiance.size()});
    ways.push_back({[&kind, &study, &all, scratch] {
        for (std::size_t i = 0; i < all.size(); ++i) {
            std::ranges::copy(all[i]->radiance.elements(), (*scratch)[i].data());
            wavelets::transform(study.transform).inverse(pyramid(kind.faces[i]), (*scratch)[i].elements());
        }
    }});
    std::vector<std::size_t> kept;
    for (const std::size_t count : counts)
        if (count <= rays_of(kind)) kept.push_back(count);
    for (const std::size_t count : kept)
        ways.push_back(to_field(make_hologram_of_coefficients(light_field_of(with_coefficients(kind, count)),
                                                              options_of(kind, by_fringes(kind, study.transform))),
                                field));
    measure(ways, study.rounds);
    const double samples = 1e-9 * double(field->grid().plane.samples());
    std::vector<double> times;
    for (const Way& way : ways) times.push_back(way.seconds / samples);
    fmt::print("| {}, {} coefficients |", kind.name, rays_of(kind));
    for (const double time : times) fmt::print(" {:.3g} |", time);
    for (std::size_t i = kept.size(); i < counts.size(); ++i) fmt::print(" |");
    const std::vector<double> sums(times.begin() + 3, times.end());
    fmt::print(" {} | {} | {} |", up_to(kept, sums, times[1] + times[2]), up_to(kept, sums, times[1]),
               up_to(kept, sums, times[0]));
    for (const double count : needed(kind, study.scene, study.transform, qualities)) fmt::print(" {:.3g} |", count);
    fmt::print("\n");
    std::fflush(stdout);
}

}  // namespace

void study_fringes(const FringeStudy& study) {
    const ThreadLimit one(1);
    fmt::print("Nanoseconds of processor time a sample, transform {}; coefficients that {} needs.\n\n", study.transform,
               study.scene);
    std::string head = "| samples | random phases | fixed, mean of √L | inverse transform |",
                line = "|---|---|---|---|";
    for (const std::size_t count : counts) {
        head += fmt::format(" {} kept |", count);
        line += "---|";
    }
    head += " below transforms from coefficients | from rays | random |";
    line += "---|---|---|";
    for (const double quality : qualities) {
        head += fmt::format(" {:g} dB |", quality);
        line += "---|";
    }
    fmt::print("{}\n{}\n", head, line);
    for (const Kind& kind : kinds())
        if (kind.name.find(study.only) != std::string::npos) study_kind(kind, study);
}

}  // namespace hogel::bench
