// SPDX-License-Identifier: Apache-2.0
// The pictures of several colours and cameras that each process of a team makes by itself.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "hogel/camera.h"
#include "hogel/core/shared_order.h"
#include "hogel/image.h"
#include "hogel/pipeline.h"

namespace hogel::pipeline {

/// Pictures of one colour by some cameras.
struct PictureShare {
    std::size_t colour = 0;
    std::vector<std::size_t> cameras;
};
using PictureShares = std::vector<PictureShare>;

/// Those by all of so many cameras.
PictureShare by_all_cameras(std::size_t colour, std::size_t cameras);

/// Whether photographs are made colour by colour, with no tiles whose light would be kept for --resume: by the full
/// camera, or of hogels of which waves are known.
bool are_of_hogels_or_planes(const Fields& holograms, const WaveCamera& with);

/// Pictures of a colour that a process of a team makes by itself when it is free.
struct PictureJob {
    std::size_t way = 0;  ///< of those in which pictures are taken
    PictureShare pictures;
    double cost = 0;  ///< in any unit
};

/// All photographs from hogels in several ways, for processes that take one job after the other: whole colours, because
/// each process would prepare hogels for its share of any colour, and at the end few pictures of infinitely many looks,
/// whose tables are for one camera. None where processes that are equally fast would not end about together, or where
/// pictures are made or kept otherwise.
/// @param order  in which colours are photographed, those that take longest first
std::vector<PictureJob> jobs_of(std::size_t processes, const Fields& holograms, std::span<const std::size_t> order,
                                std::span<const Camera> cameras, std::span<const WaveCamera> ways);

core::Sent<std::vector<PictureJob>> sent_jobs();

/// When equally fast processes that take jobs in order have made all of them, in the unit of their cost.
double end_of(std::span<const PictureJob> jobs, std::size_t processes);

/// What each process of the team makes by itself of photographs from hogels, before all of them share the colours that
/// are left over: as many whole colours as any other. Nothing for processes of no team.
/// @param order   in which colours are photographed, those that take longest first
/// @param speeds  of the processes of the team; empty for those of no team
std::vector<PictureShares> shares_of_processes(const Fields& holograms, std::span<const std::size_t> order,
                                               const WaveCamera& with, std::size_t cameras,
                                               std::span<const double> speeds);

/// What the own pictures of each process take, in any unit.
std::vector<double> costs_of(std::span<const PictureShares> shares, const Fields& holograms,
                             std::span<const Camera> cameras, const PhotographOptions& options);

/// What pictures that all processes make together take, in the same unit, as far as they are divided by rows of hogels.
double cost_of_rows(const PictureShares& rest, const Fields& holograms, std::span<const Camera> cameras,
                    const PhotographOptions& options);

/// Puts pictures of one colour into those of all.
void put(const PictureShare& share, std::span<const Image> seen, std::span<Image> pictures);

/// Puts what the processes of the team have made by themselves into the first one's pictures of all colours.
/// @param own  pictures of one colour by this process, in the order of its shares
void gather(std::span<const PictureShares> shares, std::span<const std::vector<Image>> own, std::span<Image> pictures);

/// Gives all processes of the team the first one's pictures.
void share(std::span<Image> pictures);

}  // namespace hogel::pipeline
