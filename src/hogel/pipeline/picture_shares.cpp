// SPDX-License-Identifier: Apache-2.0
#include "hogel/pipeline/picture_shares.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <numeric>
#include <ranges>

#include "hogel/core/pieces.h"
#include "hogel/core/result_log.h"
#include "hogel/core/speeds.h"
#include "hogel/optics/eye_light.h"
#include "hogel/optics/photograph_plan.h"
#include "hogel/pipeline/plan_rates.h"
#include "hogel/team.h"

namespace hogel::pipeline {
namespace {

// By how much longer than on the average a process may take for its jobs: more is lost where all share a colour.
constexpr double max_excess = 1.1;

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

// What pictures of a colour take, in any unit: processor seconds where waves are known.
double cost(const PictureShare& share, const Fields& holograms, std::span<const Camera> cameras,
            const PhotographOptions& options) {
    const FieldSource& hologram = *holograms[share.colour];
    std::vector<Camera> some;
    for (const std::size_t camera : share.cameras) some.push_back(cameras[camera]);
    const auto* const light = dynamic_cast<const optics::EyeLight*>(&hologram);
    if (const auto* const waves = light != nullptr ? light->wave_powers() : nullptr)
        return photograph_seconds(hologram, waves->counts(), some, options);
    // An eye takes in more of short waves: their spectrum is as much wider, and the pupil has as much finer light. Some
    // of the work is the same for all. As measured.
    return static_cast<double>(some.size()) * std::pow(hologram.grid().wavelength, -1.5);
}

double cost(const PictureShares& pictures, const Fields& holograms, std::span<const Camera> cameras,
            const PhotographOptions& options) {
    double sum = 0;
    for (const PictureShare& share : pictures) sum += cost(share, holograms, cameras, options);
    return sum;
}

}  // namespace

PictureShare by_all_cameras(std::size_t colour, std::size_t cameras) {
    PictureShare all{colour, std::vector<std::size_t>(cameras)};
    std::iota(all.cameras.begin(), all.cameras.end(), std::size_t{0});
    return all;
}

bool are_of_hogels_or_planes(const Fields& holograms, const WaveCamera& with) {
    const auto* const options = std::get_if<PhotographOptions>(&with);
    if (options == nullptr) return true;
    return options->from != LightFrom::samples && !options->vertical_diffuser &&
           std::ranges::all_of(holograms, [](const std::shared_ptr<const FieldSource>& hologram) {
               return dynamic_cast<const optics::EyeLight*>(hologram.get()) != nullptr;
           });
}

namespace {

// Cameras of one eye after each other, which share the numbers of its hogels.
std::vector<std::size_t> by_eyes(std::span<const Camera> cameras) {
    std::vector<std::size_t> all(cameras.size()), order;
    std::iota(all.begin(), all.end(), std::size_t{0});
    for (const optics::SharedEye& eye : optics::group_by_eye(cameras, all))
        order.insert(order.end(), eye.members.begin(), eye.members.end());
    return order;
}

// A job that can be divided, because it is of pictures of infinitely many looks. Part of its cost is that of reading
// hogels, which each of its parts does.
struct LargeJob {
    PictureJob job;
    double reading = 0, each = 0;  // cost for all pictures, and for each of them
};

LargeJob large_job(const PictureJob& job, const Fields& holograms, std::span<const Camera> cameras,
                   const PhotographOptions& options) {
    const auto count = static_cast<double>(cameras.size());
    const double one = cost(PictureShare{job.pictures.colour, {0}}, holograms, cameras, options);
    const double each = count > 1 ? (job.cost - one) / (count - 1) : one;
    return {job, std::max(0.0, one - each), each};
}

// Divides jobs so that a process that is free takes about its part of all that is left.
// @param camera_order  in which pictures are taken
// @param enough        pictures for a job
// @param part          of what is left, times the number of processes
std::vector<PictureJob> divide(std::span<const LargeJob> large, std::span<const std::size_t> camera_order,
                               std::size_t processes, std::size_t enough, double part) {
    std::vector<PictureJob> jobs;
    double left = 0;
    for (const LargeJob& one : large) left += one.job.cost;
    for (const auto& [job, reading, each] : large) {
        const double mean = job.cost / static_cast<double>(camera_order.size());
        for (std::size_t first = 0; first < camera_order.size();) {
            const std::size_t rest = camera_order.size() - first;
            const double own = std::min(part * left / (mean * static_cast<double>(processes)), 1e9);
            std::size_t count = std::max(static_cast<std::size_t>(std::lround(own)), enough);
            if (count + enough > rest) count = rest;
            const auto begin = camera_order.begin() + static_cast<std::ptrdiff_t>(first);
            jobs.push_back({job.way,
                            {job.pictures.colour, {begin, begin + static_cast<std::ptrdiff_t>(count)}},
                            reading + each * static_cast<double>(count)});
            left -= mean * static_cast<double>(count);
            first += count;
        }
    }
    return jobs;
}

}  // namespace

double end_of(std::span<const PictureJob> jobs, std::size_t processes) {
    std::vector<double> ends(processes);
    for (const PictureJob& job : jobs) *std::ranges::min_element(ends) += job.cost;
    return std::ranges::max(ends);
}

std::vector<PictureJob> jobs_of(std::size_t processes, const Fields& holograms, std::span<const std::size_t> order,
                                std::span<const Camera> cameras, std::span<const WaveCamera> ways) {
    if (processes < 2 || core::result_log() != nullptr) return {};
    const auto is_possible = [&](const WaveCamera& with) {
        return std::holds_alternative<PhotographOptions>(with) && are_of_hogels_or_planes(holograms, with);
    };
    if (!std::ranges::all_of(ways, is_possible)) return {};
    std::vector<PictureJob> whole, best;
    std::vector<LargeJob> large;
    double sum = 0;
    for (std::size_t way = 0; way < ways.size(); ++way) {
        const auto& options = std::get<PhotographOptions>(ways[way]);
        for (const std::size_t colour : order) {
            const PictureShare all = by_all_cameras(colour, cameras.size());
            const PictureJob job{way, all, cost(all, holograms, cameras, options)};
            sum += job.cost;
            if (options.expected && are_independent(cameras))
                large.push_back(large_job(job, holograms, cameras, options));
            else
                whole.push_back(job);
        }
    }
    // Few pictures to a job end more evenly, but hogels are read more often: the best of some divisions.
    const std::vector<std::size_t> camera_order = by_eyes(cameras);
    double end = max_excess * sum / static_cast<double>(processes);
    for (std::size_t enough = 1; enough <= std::min<std::size_t>(cameras.size(), 8); ++enough)
        for (const double part : {1.0, 1.25, 1.5}) {
            std::vector<PictureJob> jobs = whole;
            std::ranges::move(divide(large, camera_order, processes, enough, part), std::back_inserter(jobs));
            const double own_end = end_of(jobs, processes);
            if (own_end > end || (own_end == end && !best.empty())) continue;
            end = own_end;
            best = std::move(jobs);
        }
    return best;
}

core::Sent<std::vector<PictureJob>> sent_jobs() {
    const auto write = [](core::MessageWriter& message, const std::vector<PictureJob>& jobs) {
        message.put(jobs.size());
        for (const PictureJob& job : jobs) {
            message.put(job.way);
            message.put(job.pictures.colour);
            message.put(job.pictures.cameras);
            message.put(job.cost);
        }
    };
    const auto read = [](core::MessageReader& message) {
        std::vector<PictureJob> jobs(message.get<std::size_t>());
        for (PictureJob& job : jobs) {
            job.way = message.get<std::size_t>();
            job.pictures.colour = message.get<std::size_t>();
            job.pictures.cameras = message.get_vector<std::size_t>();
            job.cost = message.get<double>();
        }
        return jobs;
    };
    return {write, read};
}

std::vector<PictureShares> shares_of_processes(const Fields& holograms, std::span<const std::size_t> order,
                                               const WaveCamera& with, std::size_t cameras,
                                               std::span<const double> speeds) {
    const std::size_t processes = speeds.size();
    if (processes == 0 || !std::holds_alternative<PhotographOptions>(with) || core::result_log() != nullptr ||
        !are_of_hogels_or_planes(holograms, with))
        return {};
    std::vector<PictureShares> shares(processes);
    std::vector<std::size_t> by_speed(processes);
    std::iota(by_speed.begin(), by_speed.end(), std::size_t{0});
    std::ranges::stable_sort(by_speed, std::greater<>(), [&](std::size_t process) { return speeds[process]; });
    for (std::size_t k = 0; k < order.size() / processes * processes; ++k)
        shares[by_speed[k % processes]].push_back(by_all_cameras(order[k], cameras));
    return shares;
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
