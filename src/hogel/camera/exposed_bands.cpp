// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/exposed_bands.h"

#include <algorithm>

#include "hogel/camera/film/film.h"
#include "hogel/communicator.h"

namespace hogel::camera {
namespace {

// Exposes the films of one colour and eye to looks, whose bands are freed.
// @param intensities  [camera], summed over looks
void expose_viewpoint(const film::Film& film, const SharedViewpoint& eye, std::vector<PackedBand>& drawn,
                      std::span<const Camera> cameras, std::span<Array<float, 2>> intensities) {
    // Waves of a pupil take less memory than the bands from which they come.
    std::vector<film::PupilWave> waves;
    for (PackedBand& band : drawn) {
        waves.push_back(film.pupil_wave(band));
        band = {};
    }
    for (const std::size_t camera : eye.members) {
        if (intensities[camera].size() == 0) intensities[camera] = film.unexposed();
        film.expose(waves, cameras[camera], intensities[camera]);
    }
}

}  // namespace

std::vector<Viewpoint> viewpoints_of(std::span<const SharedViewpoint> eyes, std::span<const Camera> cameras,
                                     bool preview) {
    std::vector<Viewpoint> looking;
    for (const SharedViewpoint& eye : eyes) looking.push_back({cameras[eye.members.front()].eye, eye.pupil, preview});
    return looking;
}

void expose(const ColourBands& bands, std::span<const Camera> cameras, std::span<const std::span<Image>> pictures,
            const Progress& progress) {
    const std::size_t eyes = bands.eyes.size(), count = bands.colours.size() * eyes;
    std::vector<std::vector<Array<float, 2>>> intensities(bands.colours.size(),
                                                          std::vector<Array<float, 2>>(cameras.size()));
    const auto looks = static_cast<double>(bands.looks);
    for (std::size_t first = 0; first < bands.looks; first += bands.looks_at_once) {
        const std::size_t some = std::min(bands.looks_at_once, bands.looks - first);
        const Progress part =
            progress.part(static_cast<double>(first) / looks, static_cast<double>(first + some) / looks);
        PackedBands drawn = bands.drawing->draw(first, some, part.part(0.0, 0.9));
        if (!is_root_rank()) continue;  // the first one has the light of all
        // One film at a time, whose memory the next one uses.
        for (std::size_t b = 0; b < count; ++b) {
            const std::size_t colour = b / eyes;
            const SharedViewpoint& eye = bands.eyes[b % eyes];
            const FieldGrid& hologram = bands.colours[colour];
            const film::Film film(bands.drawing->band(b), hologram,
                                  film_area(hologram.plane, eye.pictures, bands.shown), eye.pupil, eye.blur,
                                  film::film_samples(bands.preview));
            expose_viewpoint(film, eye, drawn[b], cameras, intensities[colour]);
            for (const std::size_t camera : eye.members)
                if (first + some == bands.looks)
                    film.develop(intensities[colour][camera], cameras[camera], bands.shown, 1 / looks,
                                 pictures[colour][camera]);
            part.report(0.9 + 0.1 * static_cast<double>(b + 1) / static_cast<double>(count));
        }
    }
}

}  // namespace hogel::camera
