// SPDX-License-Identifier: Apache-2.0
#include "hogel/pipeline/picture_shares.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <ranges>

#include "hogel/core/pieces.h"
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

// What pictures of a colour take, in any unit.
double cost(const PictureShare& share, const Fields& holograms, std::span<const Camera> cameras,
            const PhotographOptions& options) {
    const FieldSource& hologram = *holograms[share.colour];
    const auto count = static_cast<double>(share.cameras.size());
    // An eye takes in more of short waves: their spectrum is as much wider, and the pupil has as much finer light. Some
    // of the work is the same for all. As measured.
    if (!options.expected) return count * std::pow(hologram.grid().wavelength, -1.5);
    const optics::WavePowers* waves = dynamic_cast<const optics::EyeLight&>(hologram).wave_powers();
    if (waves == nullptr) return count;
    std::vector<Camera> some;
    for (const std::size_t camera : share.cameras) some.push_back(cameras[camera]);
    const optics::expected::Work work = optics::expected::work(hologram.grid(), waves->counts(), some, options);
    return work.products + optics::expected::products_of_a_sample * static_cast<double>(work.eyes) *
                               static_cast<double>(hologram.grid().plane.samples());
}

}  // namespace

double cost(const PictureShares& pictures, const Fields& holograms, std::span<const Camera> cameras,
            const PhotographOptions& options) {
    double sum = 0;
    for (const PictureShare& share : pictures) sum += cost(share, holograms, cameras, options);
    return sum;
}

PictureShare by_all_cameras(std::size_t colour, std::size_t cameras) {
    PictureShare all{colour, std::vector<std::size_t>(cameras)};
    std::iota(all.cameras.begin(), all.cameras.end(), std::size_t{0});
    return all;
}

std::vector<PictureShares> divided(const PictureShares& pictures, std::span<const double> parts,
                                   const Fields& holograms, std::span<const Camera> cameras,
                                   const PhotographOptions& options) {
    const double all = cost(pictures, holograms, cameras, options);
    std::vector<PictureShares> shares(parts.size());
    double before = 0, end = parts.front();  // of the process's share
    std::size_t process = 0;
    for (const PictureShare& share : pictures) {
        const double each =
            cost(share, holograms, cameras, options) / (all * static_cast<double>(share.cameras.size()));
        for (const std::size_t camera : share.cameras) {
            while (process + 1 < parts.size() && before + 0.5 * each > end) end += parts[++process];
            PictureShares& own = shares[process];
            if (own.empty() || own.back().colour != share.colour) own.push_back({share.colour, {}});
            own.back().cameras.push_back(camera);
            before += each;
        }
    }
    return shares;
}

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
    if (options->expected && order.size() * cameras.size() >= enough_pictures * processes && are_independent(cameras)) {
        PictureShares all;
        for (const std::size_t colour : order) all.push_back(by_all_cameras(colour, cameras.size()));
        return divided(all, speeds, holograms, cameras, *options);
    }
    std::vector<PictureShares> shares(processes);
    std::vector<std::size_t> by_speed(processes);
    std::iota(by_speed.begin(), by_speed.end(), std::size_t{0});
    std::ranges::stable_sort(by_speed, std::greater<>(), [&](std::size_t process) { return speeds[process]; });
    for (std::size_t k = 0; k < order.size() / processes * processes; ++k)
        shares[by_speed[k % processes]].push_back(by_all_cameras(order[k], cameras.size()));
    return shares;
}

PictureShares take_divided(std::vector<PictureShares>& shares, std::size_t cameras) {
    PictureShares taken;
    const auto is_whole = [&](const PictureShare& share) { return share.cameras.size() == cameras; };
    if (!std::ranges::all_of(shares, [&](const PictureShares& own) { return std::ranges::any_of(own, is_whole); }))
        return taken;
    for (PictureShares& own : shares) {
        for (const PictureShare& share : own) {
            if (is_whole(share)) continue;
            if (taken.empty() || taken.back().colour != share.colour) taken.push_back({share.colour, {}});
            taken.back().cameras.insert(taken.back().cameras.end(), share.cameras.begin(), share.cameras.end());
        }
        std::erase_if(own, [&](const PictureShare& share) { return !is_whole(share); });
    }
    return taken;
}

std::vector<double> costs_of(std::span<const PictureShares> shares, const Fields& holograms,
                             std::span<const Camera> cameras, const PhotographOptions& options) {
    std::vector<double> costs;
    for (const PictureShares& own : shares) costs.push_back(cost(own, holograms, cameras, options));
    return costs;
}

double cost_of_rows(const PictureShares& rest, const Fields& holograms, std::span<const Camera> cameras,
                    const PhotographOptions& options) {
    return (options.expected ? 1 : drawn_part) * cost(rest, holograms, cameras, options);
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
        for (const std::vector<Image>& seen : own)
            for (const Image& picture : seen) core::send_in_pieces<float>(*team, 0, picture.pixels.elements());
        return;
    }
    for (std::size_t i = 0; i < own.size(); ++i) put(shares[0][i], own[i], pictures);
    for (std::size_t process = 1; process < team->size(); ++process)
        for (const PictureShare& share : shares[process])
            for (const std::size_t camera : share.cameras) {
                std::vector<Image> seen(1);
                seen.front().pixels = Array<float, 3>({pictures[camera].height(), pictures[camera].width(), 1});
                core::receive_in_pieces(*team, process, seen.front().pixels.elements());
                put({share.colour, {camera}}, seen, pictures);
            }
}

void share(std::span<Image> pictures) {
    Team* const team = core::team_of_several();
    if (team == nullptr) return;
    for (Image& picture : pictures) core::share_in_pieces<float>(*team, picture.pixels.elements());
}

}  // namespace hogel::pipeline
