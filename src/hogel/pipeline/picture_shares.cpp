// SPDX-License-Identifier: Apache-2.0
#include "hogel/pipeline/picture_shares.h"

#include <algorithm>

#include "hogel/core/message.h"
#include "hogel/core/result_log.h"
#include "hogel/core/shared_order.h"
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

// Divides all pictures of infinitely many looks into shares of equal cost, those of one colour after the other.
std::vector<PictureShares> equal_shares(std::size_t processes, const Fields& holograms,
                                        std::span<const std::size_t> order, std::span<const Camera> cameras,
                                        const PhotographOptions& options) {
    std::vector<double> costs;  // [colour of the order][camera]
    double all = 0;
    for (const std::size_t colour : order) {
        const optics::WavePowers* waves = dynamic_cast<const optics::EyeLight&>(*holograms[colour]).wave_powers();
        for (const Camera& camera : cameras) {
            costs.push_back(
                waves != nullptr
                    ? optics::expected::work(holograms[colour]->grid(), waves->counts(), {&camera, 1}, options).products
                    : 1);
            all += costs.back();
        }
    }
    std::vector<PictureShares> shares(processes);
    double before = 0;
    for (std::size_t i = 0; i < costs.size(); before += costs[i++]) {
        const double middle = (before + 0.5 * costs[i]) / all;
        PictureShares& own =
            shares[std::min(processes - 1, static_cast<std::size_t>(middle * static_cast<double>(processes)))];
        const std::size_t colour = order[i / cameras.size()];
        if (own.empty() || own.back().colour != colour) own.push_back({colour, {}});
        own.back().cameras.push_back(i % cameras.size());
    }
    return shares;
}

}  // namespace

std::vector<PictureShares> shares_of_processes(const Fields& holograms, std::span<const std::size_t> order,
                                               std::span<const Camera> cameras, const WaveCamera& with) {
    const Team* const team = core::team_of_several();
    const auto* const options = std::get_if<PhotographOptions>(&with);
    if (team == nullptr || options == nullptr || options->from == LightFrom::samples || options->vertical_diffuser ||
        core::result_log() != nullptr)
        return {};
    const bool of_hogels = std::ranges::all_of(holograms, [](const std::shared_ptr<const FieldSource>& hologram) {
        return dynamic_cast<const optics::EyeLight*>(hologram.get()) != nullptr;
    });
    if (!of_hogels) return {};
    if (options->expected && order.size() * cameras.size() >= enough_pictures * team->size() &&
        are_independent(cameras))
        return equal_shares(team->size(), holograms, order, cameras, *options);
    std::vector<PictureShares> shares(team->size());
    std::vector<std::size_t> all(cameras.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    for (std::size_t k = 0; k < order.size() / team->size() * team->size(); ++k)
        shares[k % team->size()].push_back({order[k], all});
    return shares;
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
