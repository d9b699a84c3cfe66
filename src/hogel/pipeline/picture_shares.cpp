// SPDX-License-Identifier: Apache-2.0
#include "hogel/pipeline/picture_shares.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <ranges>

#include "hogel/core/message.h"
#include "hogel/core/result_log.h"
#include "hogel/core/shared_order.h"
#include "hogel/core/speeds.h"
#include "hogel/optics/expected/expected.h"
#include "hogel/optics/eye_light.h"
#include "hogel/team.h"

namespace hogel::pipeline {
namespace {

// Pictures of infinitely many looks for each process, so that all have about as much work.
constexpr std::size_t enough_pictures = 4;

// Whether pictures by one camera do not depend on those by others: an eye's band is that of its widest pupil.
bool are_independent(std::span<const Camera> cameras) {
    return std::ranges::all_of(cameras, [&](const Camera& one) {
        return std::ranges::all_of(
            cameras, [&](const Camera& other) { return one.eye != other.eye || one.pupil == other.pupil; });
    });
}

// The part of a photograph from hogels that is drawn by rows of hogels; looks are exposed after it, equally many by
// each process.
constexpr double drawn_part = 0.75;

// Products of a number of a hogel with a spot that take as long as reading a sample for one camera.
constexpr double products_of_a_sample = 5;

// What pictures of a colour by a camera take, in any unit.
double cost(const FieldSource& hologram, const Camera& camera, const PhotographOptions& options) {
    // An eye takes in more of short waves: their spectrum is as much wider, and the pupil has as much finer light. Some
    // of the work is the same for all. As measured.
    if (!options.expected) return std::pow(hologram.grid().wavelength, -1.5);
    const optics::WavePowers* waves = dynamic_cast<const optics::EyeLight&>(hologram).wave_powers();
    if (waves == nullptr) return 1;
    return optics::expected::work(hologram.grid(), waves->counts(), {&camera, 1}, options).products +
           products_of_a_sample * static_cast<double>(hologram.grid().plane.samples());
}

// Divides all pictures of infinitely many looks into shares that take all processes equally long, those of one colour
// after the other.
std::vector<PictureShares> equal_shares(std::span<const double> speeds, const Fields& holograms,
                                        std::span<const std::size_t> order, std::span<const Camera> cameras,
                                        const PhotographOptions& options) {
    std::vector<double> costs;  // [colour of the order][camera]
    double all = 0;
    for (const std::size_t colour : order) {
        for (const Camera& camera : cameras) {
            costs.push_back(cost(*holograms[colour], camera, options));
            all += costs.back();
        }
    }
    std::vector<PictureShares> shares(speeds.size());
    double before = 0, end = speeds.front();  // of the process's share
    std::size_t process = 0;
    for (std::size_t i = 0; i < costs.size(); before += costs[i++]) {
        while (process + 1 < speeds.size() && (before + 0.5 * costs[i]) / all > end) end += speeds[++process];
        PictureShares& own = shares[process];
        const std::size_t colour = order[i / cameras.size()];
        if (own.empty() || own.back().colour != colour) own.push_back({colour, {}});
        own.back().cameras.push_back(i % cameras.size());
    }
    return shares;
}

}  // namespace

bool are_of_hogels_or_planes(const Fields& holograms, const WaveCamera& with) {
    const auto* const options = std::get_if<PhotographOptions>(&with);
    if (options == nullptr) return true;
    return options->from != LightFrom::samples && !options->vertical_diffuser &&
           std::ranges::all_of(holograms, [](const std::shared_ptr<const FieldSource>& hologram) {
               return dynamic_cast<const optics::EyeLight*>(hologram.get()) != nullptr;
           });
}

std::vector<PictureShares> shares_of_processes(const Fields& holograms, std::span<const std::size_t> order,
                                               std::span<const Camera> cameras, const WaveCamera& with,
                                               std::span<const double> speeds) {
    const std::size_t processes = speeds.size();
    const auto* const options = std::get_if<PhotographOptions>(&with);
    if (processes == 0 || options == nullptr || core::result_log() != nullptr ||
        !are_of_hogels_or_planes(holograms, with))
        return {};
    if (options->expected && order.size() * cameras.size() >= enough_pictures * processes && are_independent(cameras))
        return equal_shares(speeds, holograms, order, cameras, *options);
    std::vector<PictureShares> shares(processes);
    std::vector<std::size_t> all(cameras.size()), by_speed(processes);
    std::iota(all.begin(), all.end(), std::size_t{0});
    std::iota(by_speed.begin(), by_speed.end(), std::size_t{0});
    std::ranges::stable_sort(by_speed, std::greater<>(), [&](std::size_t process) { return speeds[process]; });
    for (std::size_t k = 0; k < order.size() / processes * processes; ++k)
        shares[by_speed[k % processes]].push_back({order[k], all});
    return shares;
}

std::vector<double> costs_of(std::span<const PictureShares> shares, const Fields& holograms,
                             std::span<const Camera> cameras, const PhotographOptions& options) {
    std::vector<double> costs(shares.size());
    for (std::size_t process = 0; process < shares.size(); ++process)
        for (const PictureShare& share : shares[process])
            for (const std::size_t camera : share.cameras)
                costs[process] += cost(*holograms[share.colour], cameras[camera], options);
    return costs;
}

double cost_of_rows(const PictureShares& rest, const Fields& holograms, std::span<const Camera> cameras,
                    const PhotographOptions& options) {
    return (options.expected ? 1 : drawn_part) * costs_of({&rest, 1}, holograms, cameras, options).front();
}

void put(const PictureShare& share, std::span<const Image> seen, std::span<Image> pictures) {
    for (std::size_t i = 0; i < seen.size(); ++i) {
        Image& picture = pictures[share.cameras[i]];
        const std::size_t colours = picture.pixels.extent(2);
        for (std::size_t pixel = 0; pixel < seen[i].pixels.size(); ++pixel)
            picture.pixels.data()[pixel * colours + share.colour] = seen[i].pixels.data()[pixel];
    }
}

void gather(std::span<const PictureShares> shares, std::span<const std::vector<Image>> own, std::span<Image> pictures) {
    Team* const team = core::team_of_several();
    if (team == nullptr || shares.empty()) return;
    if (!team->is_first()) {
        core::MessageWriter message;
        for (const std::vector<Image>& seen : own)
            for (const Image& picture : seen) message.put(picture.pixels);
        return team->send_to(0, message.take());
    }
    for (std::size_t i = 0; i < own.size(); ++i) put(shares[0][i], own[i], pictures);
    for (std::size_t process = 1; process < team->size(); ++process) {
        const std::string bytes = team->receive_from(process);
        core::MessageReader message(bytes);
        for (const PictureShare& share : shares[process]) {
            std::vector<Image> seen(share.cameras.size());
            for (Image& picture : seen) picture.pixels = message.get_array<float, 3>();
            put(share, seen, pictures);
        }
    }
}

}  // namespace hogel::pipeline
