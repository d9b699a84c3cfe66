// SPDX-License-Identifier: Apache-2.0
// Photographs of several colours by several cameras, as jobs that processes share.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "hogel/camera.h"
#include "hogel/image.h"
#include "hogel/pipeline.h"

namespace hogel::pipeline {

/// The pictures of some colours by some cameras, which one process makes.
struct PictureJob {
    std::size_t way = 0;  ///< index into the wave cameras
    std::vector<std::size_t> colours, cameras;

    friend bool operator==(const PictureJob&, const PictureJob&) = default;
};

/// Whether each picture is one job: of holograms whose hogels' waves are known, by the eye camera or without speckle.
/// The processes of a team make the others together.
bool is_made_in_jobs(const Fields& holograms, const CameraModel& model);

/// All pictures that are made in jobs. Where pictures are shared or kept, a job is a colour by all cameras, or by those
/// of four eyes where that changes no picture; otherwise all colours by all cameras, which may share rays.
/// @param order  in which colours are photographed, those that take longest first
std::vector<PictureJob> picture_jobs(const Fields& holograms, std::span<const std::size_t> order,
                                     std::span<const Camera> cameras, std::span<const CameraModel> ways);

/// Makes the pictures of a job, [colour][camera] of the job, one after the other.
std::vector<Image> photograph(const PictureJob& job, const Fields& holograms, std::span<const Camera> cameras,
                              std::span<const CameraModel> ways, const Progress& progress);

/// Puts pictures of a job into those of all colours.
void put(const PictureJob& job, std::span<const Image> made, std::span<Image> pictures);

}  // namespace hogel::pipeline
