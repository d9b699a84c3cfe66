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

/// Returns whether picture_jobs() divides the pictures of this camera model into jobs. It does so if all holograms are
/// stereograms and the model is the speckle-free camera, or the band camera unless it reads samples or has a vertical
/// diffuser. All ranks together compute any picture of other models.
bool is_made_in_jobs(const Fields& holograms, const CameraModel& model);

/// Divides the pictures of all models with is_made_in_jobs() into jobs. With several ranks or a checkpoint, a job has
/// one colour and all cameras; for the speckle-free camera it has the cameras of four viewpoints, which does not change
/// any picture. Otherwise a model is one job with all colours and cameras, which may share rays.
/// @param order  indices of the colours, slowest first
std::vector<PictureJob> picture_jobs(const Fields& holograms, std::span<const std::size_t> order,
                                     std::span<const Camera> cameras, std::span<const CameraModel> models);

/// Computes the pictures of a job: all its cameras at once; all colours at once if they can share rays, otherwise one
/// colour after the other. Returns them as [colour][camera] of the job, row-major.
std::vector<Image> photograph(const PictureJob& job, const Fields& holograms, std::span<const Camera> cameras,
                              std::span<const CameraModel> models, const Progress& progress);

/// Copies the single-channel pictures of a job into the channels of its colours in `pictures`, [camera].
void put(const PictureJob& job, std::span<const Image> job_pictures, std::span<Image> pictures);

}  // namespace hogel::pipeline
