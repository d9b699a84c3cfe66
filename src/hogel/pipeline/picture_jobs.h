// SPDX-License-Identifier: Apache-2.0
// Photographs of several colours by several cameras, as jobs shared by the ranks.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "hogel/camera.h"
#include "hogel/image.h"
#include "hogel/pipeline.h"

namespace hogel::pipeline {

/// Pictures of some colours by some cameras, computed by one rank.
struct PictureJob {
    std::size_t model_index = 0;  ///< index of the camera model
    std::vector<std::size_t> colours, cameras;

    friend bool operator==(const PictureJob&, const PictureJob&) = default;
};

/// Returns whether each picture belongs to one job: holograms with known hogel spectra, photographed by the
/// hogel-spectra camera or speckle-free. All ranks compute each other picture together.
bool is_made_in_jobs(const Fields& holograms, const CameraModel& model);

/// Returns the jobs of all pictures for which is_made_in_jobs() holds. If pictures are shared among ranks or
/// checkpointed, a job is one colour by all cameras, or by the cameras of four viewpoints if that does not change any
/// picture; otherwise all colours by all cameras, which may share rays.
/// @param order  indices of the colours in the order of their photographs, slowest first
std::vector<PictureJob> picture_jobs(const Fields& holograms, std::span<const std::size_t> order,
                                     std::span<const Camera> cameras, std::span<const CameraModel> models);

/// Computes the pictures of a job one after the other. Returns them as [colour][camera] of the job, row-major.
std::vector<Image> photograph(const PictureJob& job, const Fields& holograms, std::span<const Camera> cameras,
                              std::span<const CameraModel> models, const Progress& progress);

/// Copies the pictures of a job to the channels of the pictures of all colours.
void put(const PictureJob& job, std::span<const Image> job_pictures, std::span<Image> pictures);

}  // namespace hogel::pipeline
