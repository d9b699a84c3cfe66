// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/exposed_bands.h"

#include <algorithm>

#include "hogel/camera/film/film.h"
#include "hogel/communicator.h"

namespace hogel::camera {
namespace {

// Exposes the films of one colour and viewpoint to several looks and frees their bands.
// @param intensities  [camera], summed over looks
void expose_viewpoint(const film::Film& film, const SharedViewpoint& viewpoint, std::vector<PackedBand>& packed,
                      std::span<const Camera> cameras, std::span<Array<float, 2>> intensities) {
    // Pupil waves take less memory than their bands.
    std::vector<film::PupilWave> pupil_waves;
    for (PackedBand& band : packed) {
        pupil_waves.push_back(film.pupil_wave(band));
        band = {};
    }
    for (const std::size_t camera : viewpoint.members) {
        if (intensities[camera].size() == 0) intensities[camera] = film.unexposed();
        film.expose(pupil_waves, cameras[camera], intensities[camera]);
    }
}

}  // namespace

std::vector<Viewpoint> viewpoints_of(std::span<const SharedViewpoint> viewpoints, std::span<const Camera> cameras,
                                     bool preview) {
    std::vector<Viewpoint> result;
    for (const SharedViewpoint& viewpoint : viewpoints)
        result.push_back({cameras[viewpoint.members.front()].eye, viewpoint.pupil, preview});
    return result;
}

void expose(const ColourBands& bands, std::span<const Camera> cameras, std::span<const std::span<Image>> pictures,
            const Progress& progress) {
    const std::size_t viewpoints = bands.viewpoints.size(), count = bands.colours.size() * viewpoints;
    std::vector<std::vector<Array<float, 2>>> intensities(bands.colours.size(),
                                                          std::vector<Array<float, 2>>(cameras.size()));
    const auto looks = static_cast<double>(bands.looks);
    for (std::size_t first = 0; first < bands.looks; first += bands.looks_at_once) {
        const std::size_t batch = std::min(bands.looks_at_once, bands.looks - first);
        const Progress batch_progress =
            progress.part(static_cast<double>(first) / looks, static_cast<double>(first + batch) / looks);
        PackedBands packed = bands.source->synthesize(first, batch, batch_progress.part(0.0, 0.9));
        if (!is_root_rank()) continue;  // the root has the bands of all
        // One film at a time reuses the same memory.
        for (std::size_t b = 0; b < count; ++b) {
            const std::size_t colour = b / viewpoints;
            const SharedViewpoint& viewpoint = bands.viewpoints[b % viewpoints];
            const FieldGrid& hologram = bands.colours[colour];
            const film::Film film(bands.source->band(b), hologram,
                                  film_area(hologram.plane, viewpoint.pictures, bands.shown), viewpoint.pupil,
                                  viewpoint.blur, film::film_samples(bands.preview));
            expose_viewpoint(film, viewpoint, packed[b], cameras, intensities[colour]);
            for (const std::size_t camera : viewpoint.members)
                if (first + batch == bands.looks)
                    film.develop(intensities[colour][camera], cameras[camera], bands.shown, 1 / looks,
                                 pictures[colour][camera]);
            batch_progress.report(0.9 + 0.1 * static_cast<double>(b + 1) / static_cast<double>(count));
        }
    }
}

}  // namespace hogel::camera
